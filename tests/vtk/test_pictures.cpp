// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <sstream>

#include "breccia/output.hpp"
#include "breccia/renderer.hpp"
#include "made_scene.hpp"
#include "png_image.hpp"

namespace breccia::test {
namespace {

/// A result folder with two frames and curves.
void write_results(const Specimen& specimen, const fs::path& folder) {
  write_frames(specimen, folder);
  std::ofstream(folder / "curves.csv") << made_up_curves();
}

class PicturesOfARun : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder;
    write_results(Specimen(2000, 3), folder_->path());
  }
  static void TearDownTestSuite() { delete folder_; }
  static inline Folder* folder_ = nullptr;
  Folder to_;
  QuietHost host_;
};

const Json all_kinds = [] {
  Json pictures = Json::array();
  for (const char* show : {"specimen", "cutaway", "cracks", "cracks_time", "displacement", "stress_strain", "strains"})
    pictures.push_back({{"show", show}});
  return pictures;
}();

TEST_F(PicturesOfARun, AllKindsAreDrawn) {
  const auto made = render(folder_->path(), to_.path(), {{"size", 400}, {"pictures", all_kinds}}, host_);
  EXPECT_TRUE(host_.warnings.empty()) << host_.warnings[0];
  ASSERT_EQ(made.size(), 11u);
  for (const fs::path& file : made) {
    if (file.extension() != ".png") continue;
    const Image image = read(file);
    EXPECT_GT(image.drawn(), 0.03) << file;
    EXPECT_LT(image.drawn(), 0.95) << file;
    EXPECT_GT(image.colours(), 100u) << file;
  }
  for (const auto& entry : fs::directory_iterator(to_.path())) EXPECT_NE(entry.path().extension(), ".partial");
}

TEST_F(PicturesOfARun, TheUsualOnesAreFew) {
  const auto made = render(folder_->path(), to_.path(), {{"size", 300}}, host_);
  EXPECT_EQ(names(made), (Names{"specimen.png", "cutaway.png", "cracks.png", "stress_strain.png", "stress_strain.svg",
                                "stress_strain.pdf"}));
  EXPECT_TRUE(host_.warnings.empty());
}

TEST_F(PicturesOfARun, SameFilesGiveTheSameBytesOnAnyNumberOfThreads) {
  Folder again;
  QuietHost three;
  three.thread_count = 3;
  const Json config = {{"size", 300}, {"pictures", all_kinds}};
  const auto first = render(folder_->path(), to_.path(), config, host_);
  const auto second = render(folder_->path(), again.path(), config, three);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k) EXPECT_EQ(bytes(first[k]), bytes(second[k])) << first[k];
}

TEST_F(PicturesOfARun, ProgressIsToldAndAStopIsHeardBetweenPictures) {
  const Json two = {{"size", 300}, {"pictures", {{{"show", "cracks"}}, {{"show", "stress_strain"}}}}};
  render(folder_->path(), to_.path(), two, host_);
  EXPECT_EQ(host_.done, (std::vector<double>{0, 0.5, 1}));
  Folder again;
  QuietHost stopping;
  stopping.stop = true;
  EXPECT_THROW(render(folder_->path(), again.path(), two, stopping), Cancelled);
  EXPECT_TRUE(fs::exists(again.path() / "cracks.png")) << "what was drawn stays";
  EXPECT_FALSE(fs::exists(again.path() / "stress_strain.png"));
}

TEST_F(PicturesOfARun, CutawayShowsLessThanTheWhole) {
  const Json config = {{"size", 400}, {"pictures", {{{"show", "specimen"}}, {{"show", "cutaway"}, {"cut", "half"}}}}};
  render(folder_->path(), to_.path(), config, host_);
  const Image whole = read(to_.path() / "specimen.png"), half = read(to_.path() / "cutaway.png");
  ASSERT_EQ(whole.width, half.width);
  EXPECT_NE(whole.pixel, half.pixel);
  EXPECT_LT(half.drawn(), whole.drawn());
}

TEST_F(PicturesOfARun, CracksHaveTheColoursOfTheirModes) {
  render(folder_->path(), to_.path(), {{"size", 400}, {"pictures", {{{"show", "cracks"}}}}}, host_);
  const Image image = read(to_.path() / "cracks.png");
  EXPECT_GT(image.share_of(0, 114, 178), 0.005);  // tension, blue
  EXPECT_GT(image.share_of(213, 94, 0), 0.002);   // shear, vermillion
}

TEST_F(PicturesOfARun, ColourRangeMapsValuesToTheEndsOfTheMap) {
  // Every radius lies above this range: all spheres take the map's last colour, shaded.
  const Json config = {
      {"size", 300},
      {"pictures",
       {{{"show", "specimen"}, {"field", "radius"}, {"colour_map", "blue_red"}, {"low", 1e-6}, {"high", 2e-6}}}}};
  render(folder_->path(), to_.path(), config, host_);
  const Image image = read(to_.path() / "specimen.png");
  std::size_t red = 0, bluish = 0;
  for (const auto& p : image.pixel) {
    red += p[0] > p[2] + 40;
    bluish += p[2] > p[0] + 40;
  }
  EXPECT_GT(double(red) / double(image.pixel.size()), 0.15);
  EXPECT_LT(double(bluish) / double(image.pixel.size()), 0.03);  // the colour bar only
}

TEST_F(PicturesOfARun, TheSvgHoldsTheWholeCurve) {
  const Json config = {{"size", 400}, {"pictures", {{{"show", "stress_strain"}}}}};
  render(folder_->path(), to_.path(), config, host_);
  const std::string svg = bytes(to_.path() / "stress_strain.svg");
  for (const char* part : {"axial strain ε (%)", "axial stress σ (MPa)", "broken bonds D (%)", "</svg>"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  // The first polyline is the stress: 201 samples that rise and fall again, from the left edge to the right one.
  const auto begin = svg.find("points=\"", svg.find("<polyline")) + 8;
  std::istringstream in(svg.substr(begin, svg.find('"', begin) - begin));
  std::vector<double> x, y;
  for (double a = 0, b = 0; in >> a && in.ignore() && in >> b;) {
    x.push_back(a);
    y.push_back(b);
  }
  ASSERT_EQ(x.size(), 201u);
  EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
  EXPECT_GT(x.back() - x.front(), 250);
  const auto peak = std::min_element(y.begin(), y.end());  // y points down
  EXPECT_GT(y.front() - *peak, 150);
  EXPECT_GT(y.back() - *peak, 150);
  EXPECT_NE(svg.find("<circle"), std::string::npos);
}

TEST_F(PicturesOfARun, AProblemOfOnePictureDoesNotStopTheOthers) {
  const Json config = {{"size", 300},
                       {"columns", {{"stress", "axial_stres"}}},
                       {"pictures",
                        {{{"show", "stress_strain"}},
                         {{"show", "specimen"}, {"field", "nothing"}, {"name", "a"}},
                         {{"show", "displacement"}, {"frame", 7}, {"name", "b"}},
                         {{"show", "strains"}}}}};
  EXPECT_EQ(render(folder_->path(), to_.path(), config, host_).size(), 3u);
  ASSERT_EQ(host_.warnings.size(), 3u);
  EXPECT_NE(host_.warnings[0].find("no column `axial_stres`; did you mean `axial_stress_Pa`?"), std::string::npos)
      << host_.warnings[0];
  EXPECT_NE(host_.warnings[1].find("no field `nothing`; there are: radius, id, mass"), std::string::npos)
      << host_.warnings[1];
  for (const std::string& warning : host_.warnings) EXPECT_LT(warning.size(), 140u) << warning;
  EXPECT_NE(host_.warnings[2].find("no frame 7: the last is 1"), std::string::npos) << host_.warnings[2];
}

TEST_F(PicturesOfARun, OneFileIsASourceToo) {
  const Json config = {{"size", 300}, {"pictures", {{{"show", "specimen"}, {"field", "velocity_z"}}}}};
  EXPECT_EQ(render(folder_->path() / "particles_000001.vtp", to_.path(), config, host_).size(), 1u);
  const Json cracks = {{"size", 300}, {"pictures", {{{"show", "cracks"}}}}};
  EXPECT_EQ(render(folder_->path() / "bonds.pvd", to_.path(), cracks, host_).size(), 1u);
}

TEST_F(PicturesOfARun, UnusableSourcesAndTargetsAreNamed) {
  Folder empty;
  EXPECT_NE(user_error([&] { render(empty.path(), to_.path(), {}, host_); }).find("holds no results"),
            std::string::npos);
  EXPECT_NE(user_error([&] { render(empty.path() / "no.pvd", to_.path(), {}, host_); }).find("does not exist"),
            std::string::npos);
  const fs::path broken = empty.file("broken.vtp", bytes(folder_->path() / "particles_000000.vtp").substr(0, 3000));
  EXPECT_NE(user_error([&] { render(broken, to_.path(), {}, host_); }).find("broken.vtp: it is missing, damaged"),
            std::string::npos);
  const fs::path file = empty.file("in_the_way", "");
  EXPECT_NE(user_error([&] { render(folder_->path(), file / "sub", {}, host_); }).find("cannot make the folder"),
            std::string::npos);
}

TEST(Pictures, TwoDimensions) {
  Folder from, to;
  QuietHost host;
  write_results(Specimen(800, 2), from.path());
  render(from.path(), to.path(), {{"size", 400}}, host);
  EXPECT_TRUE(host.warnings.empty()) << "a cutaway that nobody asked for is not missed";
  EXPECT_FALSE(fs::exists(to.path() / "cutaway.png"));
  EXPECT_GT(read(to.path() / "cracks.png").share_of(0, 114, 178), 0.002);
  const auto made = render(from.path(), to.path(), {{"size", 400}, {"pictures", all_kinds}}, host);
  EXPECT_EQ(made.size(), 10u);  // all but the cutaway
  ASSERT_EQ(host.warnings.size(), 1u);
  EXPECT_NE(host.warnings[0].find("no inside to show"), std::string::npos);
}

/// A disc on its edge, loaded across: its columns are its own, and a mean axial stress says nothing of it.
TEST(Pictures, ABrazilianTestHasItsLoadCurve) {
  Folder from, to;
  QuietHost host;
  std::ofstream out(from.path() / "curves.csv");
  out << "time_s,tensile_stress_Pa,load_N,platen_displacement_m,diametral_strain,axial_strain,axial_stress_Pa,"
         "moment_N_m,global_damage\n";
  for (int k = 0; k <= 20; ++k)
    out << k << ',' << 1e5 * k << ',' << 150 * k << ',' << 1e-6 * k << ',' << 1e-4 * k << ",0,0," << k << ",0\n";
  out.close();
  EXPECT_EQ(names(render(from.path(), to.path(), {{"size", 400}}, host)),
            (Names{"load_curve.png", "load_curve.svg", "load_curve.pdf"}));
  EXPECT_TRUE(host.warnings.empty());
  const std::string svg = bytes(to.path() / "load_curve.svg");
  for (const char* part : {">load (kN)<", ">platen displacement (µm)<", "highest 3 kN at 20 µm"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  // A unit of several letters is not the metre that it ends in.
  const Json moment = {{"size", 300}, {"pictures", {{{"show", "load_curve"}}}}, {"columns", {{"load", "moment"}}}};
  render(from.path(), to.path(), moment, host);
  EXPECT_NE(bytes(to.path() / "load_curve.svg").find(">moment (N m)<"), std::string::npos);
}

/// Without measured means, the platens' stress and strain.
TEST(Pictures, PlatensStandInForMeansThatNobodyMeasured) {
  Folder from, to;
  QuietHost host;
  std::ofstream(from.path() / "curves.csv") << "time_s,platen_stress_Pa,platen_strain\n0,0,0\n1,1e6,1e-4\n2,2e6,2e-4\n";
  EXPECT_EQ(names(render(from.path(), to.path(), {{"size", 300}}, host)),
            (Names{"stress_strain.png", "stress_strain.svg", "stress_strain.pdf"}));
  EXPECT_NE(bytes(to.path() / "stress_strain.svg").find(">platen stress σ (MPa)<"), std::string::npos);
}

/// The pale wall and the edges of the outline, by the specimen's own shape.
class Outlines : public ::testing::TestWithParam<std::pair<SpecimenShape::Outline, double>> {};
TEST_P(Outlines, AreThoseOfTheSpecimen) {
  const auto [outline, expected] = GetParam();
  Specimen specimen(300, 3);
  SimulationView view = specimen.view(0);
  view.bonds = {};
  view.specimen.outline = outline;
  view.specimen.base = Vec3(0, 0, -1e-2);
  view.specimen.axis = Vec3::UnitZ();
  view.specimen.height = 2e-2;
  view.specimen.extent = Vec3::Constant(2e-2);
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c) corners.emplace_back(c & 1 ? 9e-3 : -9e-3, c & 2 ? 9e-3 : -9e-3, c & 4 ? 9e-3 : -9e-3);
  const std::vector<double> radius(8, 1e-4);
  const std::vector<Vec3> none(8, Vec3::Zero());
  const std::vector<Index> id{0, 1, 2, 3, 4, 5, 6, 7};
  view.pairs = {};
  view.walls = {};
  view.particles = {corners, none, none, corners, none, none, {}, {}, radius, radius, {}, id, {}};
  Folder from, to;
  QuietHost host;
  auto output = make<Output>(BRECCIA_VTK_PLUGIN, {});
  output->begin(from.path(), host);
  output->frame(view, {});
  output->finish();
  render(from.path(), to.path(), {{"size", 600}, {"pictures", {{{"show", "cracks"}}}}}, host);
  const Image image = read(to.path() / "cracks.png");
  // Single pixels of the writing have the wall's colour by chance: a row or column of the wall has many.
  const int rows = image.height;
  std::vector<int> in_row(std::size_t(rows), 0), in_column(std::size_t(image.width), 0);
  for (std::size_t k = 0; k < image.pixel.size(); ++k)
    if (image.pixel[k] == std::array<unsigned char, 3>{243, 243, 243}) {
      ++in_row[k / std::size_t(image.width)];
      ++in_column[k % std::size_t(image.width)];
    }
  const double wall = std::accumulate(in_row.begin(), in_row.end(), 0.0);
  const auto ends = [](const std::vector<int>& count) {
    int first = int(count.size()), last = -1;
    for (int k = 0; k < int(count.size()); ++k)
      if (count[std::size_t(k)] > 12) {
        first = std::min(first, k);
        last = k;
      }
    return std::pair{first, last};
  };
  const auto [first, last] = ends(in_row);
  const auto [left, right] = ends(in_column);
  const double box = double(last - first + 1) * double(right - left + 1);
  EXPECT_NEAR(wall / box, expected, 0.02);
  EXPECT_GT(first, 0) << "not cut off";
  EXPECT_LT(last, rows - 1);
  EXPECT_GT(left, 0);
}
// The share of its bounding rectangle that each fills: a circle pi/4; what is seen of a cylinder of diameter and height
// h, 18 degrees from above, is h wide and h (cos + sin) high, and the corners beside its two ellipses are free.
INSTANTIATE_TEST_SUITE_P(Shapes, Outlines,
                         ::testing::Values(std::pair{SpecimenShape::Outline::ellipsoid, 0.7854},
                                           std::pair{SpecimenShape::Outline::cylinder,
                                                     (0.95106 + 0.7854 * 0.30902) / (0.95106 + 0.30902)}));

TEST(Pictures, NamesMustDiffer) {
  const Issues issues =
      issues_of(BRECCIA_PICTURES_PLUGIN, {{"pictures", {{{"show", "cracks"}}, {{"show", "cracks"}}}}});
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues[0].path, "pictures[1]");
}

/// Nothing is asked of OpenGL: in a process that finds no driver of it, all pictures are drawn.
TEST(PicturesDeathTest, NeedNoOpenGl) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/no/driver.json", 1);
        unsetenv("DISPLAY");
        std::size_t made = 0;
        {
          Folder from;
          Folder to;
          write_results(Specimen(50, 3), from.path());
          QuietHost host;
          made = render(from.path(), to.path(), {{"pictures", all_kinds}}, host).size();
        }
        std::_Exit(made == 11 ? 0 : 3);
      },
      ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace breccia::test
