// SPDX-License-Identifier: BSD-3-Clause
// From where pictures are seen, what of a specimen they show, and in which colours.
#include <sstream>

#include "breccia/output.hpp"
#include "made_scene.hpp"
#include "png_image.hpp"
#include "specimen.hpp"

namespace breccia::test {
namespace {

using Outline = SpecimenShape::Outline;
const std::array<unsigned char, 3> wall{243, 243, 243};

/// Rows and columns that have more than single pixels of the pale wall, and the share of their rectangle that is pale.
struct Wall {
  int wide = 0, high = 0;
  double filled = 0;
  explicit Wall(const Image& image) {
    std::vector<int> in_row(std::size_t(image.height), 0), in_column(std::size_t(image.width), 0);
    double all = 0;
    for (std::size_t k = 0; k < image.pixel.size(); ++k)
      if (image.pixel[k] == wall) {
        ++in_row[k / std::size_t(image.width)];
        ++in_column[k % std::size_t(image.width)];
        ++all;
      }
    for (const int n : in_row) high += n > 8;
    for (const int n : in_column) wide += n > 8;
    filled = high > 0 && wide > 0 ? all / (double(wide) * high) : 0;
  }
};

class Scenes : public ::testing::Test {
 protected:
  Image drawn(const Json& picture) {
    for (const auto& entry : fs::directory_iterator(to_.path())) fs::remove(entry.path());
    const auto made = render(from_.path(), to_.path(), {{"size", 400}, {"pictures", {picture}}}, host_);
    EXPECT_TRUE(host_.warnings.empty()) << host_.warnings[0];
    return read(made.at(0));
  }
  Names usual() { return names(render(from_.path(), to_.path(), {{"size", 200}}, host_)); }
  Folder from_, to_;
  QuietHost host_;
};

/// Lit from the upper left, a platen's side is a little darker than its own grey.
double platens(const Image& image) { return image.share_of(169, 176, 182); }
bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TEST_F(Scenes, ADiscBetweenPlatensIsSeenAlongItsAxis) {
  MadeScene scene(Outline::cylinder, {20e-3, 20e-3, 10e-3});
  scene.add_corners(4e-3);
  scene.add_wall("bottom", {0, -10e-3, 5e-3}, Vec3::UnitY());
  scene.add_wall("top", {0, 10e-3, 5e-3}, -Vec3::UnitY());
  scene.write(from_.path());
  EXPECT_TRUE(has(usual(), "displacement_across.png"));
  const Image face = drawn({{"show", "cracks"}});
  EXPECT_NEAR(Wall(face).filled, 0.7854, 0.02) << "a circle";
  EXPECT_GT(platens(face), 5 * platens(drawn({{"show", "cracks"}, {"platens", false}}))) << "but for the writing";
  // Between the same platens a cylinder that stands is seen obliquely, as ever.
  Folder standing;
  MadeScene upright(Outline::cylinder, {20e-3, 20e-3, 10e-3});
  upright.add_corners(4e-3);
  upright.add_wall("bottom", Vec3::Zero(), Vec3::UnitZ());
  upright.add_wall("top", {0, 0, 10e-3}, -Vec3::UnitZ());
  upright.write(standing.path());
  EXPECT_FALSE(has(names(render(standing.path(), to_.path(), {{"size", 200}}, host_)), "displacement_across.png"));
}

TEST_F(Scenes, OutlinesAreTrueFromEverySide) {
  const auto share = [&](Outline outline, const char* view) {
    Folder from;
    MadeScene scene(outline, {20e-3, 20e-3, 30e-3});
    scene.add_corners(4e-3);
    scene.write(from.path());
    render(from.path(), to_.path(), {{"size", 400}, {"pictures", {{{"show", "cracks"}, {"camera", {{"view", view}}}}}}},
           host_);
    return Wall(read(to_.path() / "cracks.png"));
  };
  for (const auto& [outline, front, top] :
       {std::tuple(Outline::cylinder, 1.0, 0.7854), std::tuple(Outline::box, 1.0, 1.0),
        std::tuple(Outline::ellipsoid, 0.7854, 0.7854)}) {
    const Wall from_front = share(outline, "front"), from_top = share(outline, "top");
    EXPECT_NEAR(from_front.filled, front, 0.03) << int(outline);
    EXPECT_NEAR(from_top.filled, top, 0.03) << int(outline);
    EXPECT_NEAR(double(from_front.high) / from_front.wide, 1.5, 0.03) << int(outline);
    EXPECT_NEAR(double(from_top.high) / from_top.wide, 1, 0.03) << int(outline);
  }
  // Of an irregular one the shadow of its grains: from the front eight at the corners are four discs apart, so that the
  // rows and columns which have some are a square of two by two.
  const Wall shadow = share(Outline::irregular, "front");
  EXPECT_NEAR(double(shadow.high) / shadow.wide, 1, 0.03);
  EXPECT_NEAR(shadow.filled, 0.7854, 0.03);
  EXPECT_TRUE(host_.warnings.empty());
}

TEST_F(Scenes, WhatFlewOffSetsNeitherRangeNorFrame) {
  Folder plain;
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(3e-3);
  for (std::size_t p = 0; p < scene.size(); ++p) scene.displacement[p] = Vec3(1e-4 * double(p), 0, 0);
  scene.write(plain.path());
  for (int k = 0; k < 3; ++k) {
    scene.add({5.0 * (k + 1), 1, 1}, 3e-3);
    scene.displacement.back() = Vec3(4, 1, 1);
  }
  scene.write(from_.path());
  const Image with = drawn({{"show", "displacement"}});
  render(plain.path(), to_.path(), {{"size", 400}, {"pictures", {{{"show", "displacement"}}}}}, host_);
  EXPECT_EQ(with.pixel, read(to_.path() / "displacement.png").pixel);
}

/// Reds at the upper end, blues at the lower one: only where there are values of both signs.
TEST_F(Scenes, RangesAreSymmetricWhereTheFieldHasASign) {
  const auto look = [&](double lowest) {
    MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
    scene.add_corners(4e-3);
    for (std::size_t p = 0; p < scene.size(); ++p) scene.displacement[p].z() = p % 2 ? 3e-4 : lowest;
    scene.write(from_.path());
    const Image image = drawn({{"show", "specimen"}, {"field", "displacement_z"}});
    const auto count = [&](auto&& is) {
      return double(std::count_if(image.pixel.begin(), image.pixel.end(), is)) / double(image.pixel.size());
    };
    return std::pair(count([](auto& p) { return p[0] > p[1] + 60 && p[0] > p[2] + 60; }),
                     count([](auto& p) { return p[2] > p[0] + 25 && p[1] > p[0] + 10; }));
  };
  const auto [red, blue] = look(-1e-4);
  EXPECT_GT(red, 0.1);
  EXPECT_GT(blue, 0.1);
  EXPECT_LT(look(-1e-6).first, 0.02) << "noise about zero";
  EXPECT_LT(look(1e-4).first, 0.02) << "one sign";
}

/// A plane at the distance d cuts a circle of the area pi (R² - d²) out of a sphere.
TEST_F(Scenes, SectionsAreTheCirclesOfGeometry) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add({0, 0, 10e-3}, 5e-3);
  scene.write(from_.path());
  const auto area = [&](double offset) {
    return drawn({{"show", "specimen"}, {"field", "radius"}, {"slice", {{"normal", {0, 0, 1}}, {"offset", offset}}}})
        .share_of(68, 1, 84);
  };
  const double none = area(6e-3), middle = area(0) - none;
  EXPECT_GT(middle, 0.05);
  EXPECT_NEAR((area(3e-3) - none) / middle, 1 - 0.36, 0.01);
  EXPECT_NEAR((area(-4e-3) - none) / middle, 1 - 0.64, 0.01);
}

TEST_F(Scenes, AClipTakesAwayTheSideOfItsNormal) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add({-5e-3, 0, 10e-3}, 3e-3);
  scene.add({5e-3, 0, 10e-3}, 4e-3);
  scene.write(from_.path());
  const auto area = [&](const Json& normal) {
    Json picture = {{"show", "cracks"}, {"opacity", 1}, {"camera", {{"view", "front"}}}};
    if (!normal.is_null()) picture["clip"] = {{"normal", normal}};
    const Image image = drawn(picture);
    return double(
        std::count_if(image.pixel.begin(), image.pixel.end(), [](auto& p) { return p[0] != p[2] && p[0] < 240; }));
  };
  const double both = area(nullptr), small = area({1, 0, 0}), large = area({-1, 0, 0});
  EXPECT_GT(small, 0.2 * both);
  EXPECT_NEAR(large / small, 16.0 / 9, 0.15);
  EXPECT_NEAR((large + small) / both, 1, 0.05);
}

TEST_F(Scenes, ABeamLiesAndItsLoadPointsDown) {
  MadeScene scene(Outline::box, {2e-3, 2e-3, 42e-3});
  for (int k = 0; k < 21; ++k) scene.add({0, 0, 1e-3 + 2e-3 * k}, 1e-3);
  scene.held.assign(21, 0);
  scene.held.front() = scene.held.back() = dof::translation;
  scene.applied.assign(21, Vec3::Zero());
  scene.applied[10] = Vec3(3, 0, 0);
  scene.displacement[10] = Vec3(1e-4, 0, 0);
  scene.write(from_.path());
  EXPECT_EQ(usual(), (Names{"specimen.png", "displacement_across.png"}));
  const Image beam = drawn({{"show", "displacement_across"}});
  EXPECT_GT(beam.width, beam.height);
  EXPECT_GT(beam.share_of(70, 70, 74), 0.003) << "what is held";
  // Above the beam, and left of the legend, the arrow is all that there is: over the middle.
  const Image plain = drawn({{"show", "displacement_across"}, {"axes", false}, {"time", false}});
  double ink = 0, x = 0;
  for (int k = 0; k < plain.width * plain.height; ++k) {
    const int column = k % plain.width, up = k / plain.width;  // rows from below
    if (column > 0.85 * plain.width || up < 0.65 * plain.height || plain.pixel[std::size_t(k)][0] > 100) continue;
    ++ink;
    x += column;
  }
  ASSERT_GT(ink, 20);
  const double margin_left = 12, margin_right = 80;  // 3 and 20 hundredths of the size
  EXPECT_NEAR(x / ink, 0.5 * (margin_left + plain.width - margin_right), 2);
}

/// It bends by more than its depth, and lies as before when its load is taken away.
TEST_F(Scenes, ABeamStaysInThePictureWhileItBendsAndAfterItsRelease) {
  MadeScene scene(Outline::box, {2e-3, 2e-3, 42e-3});
  for (int k = 0; k < 21; ++k) scene.add({0, 0, 1e-3 + 2e-3 * k}, 1e-3);
  scene.held.assign(21, 0);
  scene.held.front() = scene.held.back() = dof::translation;
  auto output = make<Output>(BRECCIA_VTK_PLUGIN, {});
  output->begin(from_.path(), host_);
  scene.applied.assign(21, Vec3::Zero());
  scene.applied[10] = Vec3(3, 0, 0);
  scene.displacement[10] = Vec3(3e-3, 0, 0);
  scene.position[10].x() = 3e-3;
  scene.write_frame(*output);
  scene.applied.assign(21, Vec3::Zero());
  scene.write_frame(*output);
  output->finish();
  const Json displacement = {{"show", "displacement"}, {"time", false}};
  Json before = displacement;
  before["frame"] = 0;
  const Image loaded = drawn(before), released = drawn(displacement);
  // The end of the colours is where the middle is, apart from the bar at the right.
  const auto middle = [](const Image& image) {
    double yellow = 0;
    for (std::size_t k = 0; k < image.pixel.size(); ++k) {
      const auto& p = image.pixel[k];
      yellow += double(k % std::size_t(image.width)) < 0.8 * image.width && p[0] > 150 && p[2] < 80;
    }
    return yellow;
  };
  EXPECT_GT(middle(loaded), 20);
  EXPECT_GT(middle(released), 20);
  EXPECT_GT(released.width, released.height) << "lying";
  EXPECT_GT(released.share_of(70, 70, 74), 0.003) << "what is held";
}

TEST_F(Scenes, HeldEndsThatMoveApartHavePlatesAndAreSeenFromTheFront) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 40e-3});
  scene.add_corners(4e-3);
  scene.held.assign(scene.size(), dof::all);
  for (std::size_t p = 0; p < scene.size(); ++p) scene.displacement[p].z() = scene.position[p].z() > 20e-3 ? 1e-4 : 0;
  scene.write(from_.path());
  EXPECT_TRUE(has(usual(), "displacement_across.png"));
  const Image image = drawn({{"show", "cracks"}});
  EXPECT_GT(platens(image), 0.01);
  EXPECT_NEAR(Wall(image).filled, 1, 0.02) << "a rectangle";
}

class ScenesOfCracks : public Scenes {
 protected:
  static const Specimen& specimen() {
    static const Specimen one(1200, 3);
    return one;
  }
  void SetUp() override { write_frames(specimen(), from_.path()); }
  double blue(const Json& more) {
    Json picture = {{"show", "cracks"}};
    picture.update(more);
    return drawn(picture).share_of(0, 100, 156);
  }
};

/// Face to face, evenly from front to back: 200 discs of 2 mm would cover the view of 20 by 20 mm six times.
TEST_F(Scenes, OfCracksThatHideEachOtherASlabIsShown) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(2e-3);
  for (int k = 0; k < 200; ++k)
    scene.add_crack({1e-3 * (k * 7 % 17 - 8), 1e-4 * (k - 99.5), 1e-3 * (4 + k * 11 % 13)}, Vec3::UnitY());
  scene.write(from_.path());
  const auto covered = [&](const Json& more) {
    Json picture = {{"show", "cracks"}};
    picture.update(more);
    const Image image = drawn(picture);
    const double blue = image.share_of(0, 108, 168),
                 pale = double(std::count(image.pixel.begin(), image.pixel.end(), wall)) / double(image.pixel.size());
    return blue / (blue + pale);
  };
  EXPECT_GT(covered({{"slice", {{"thickness", 1}}}}), 0.7);
  const double slab = covered(Json::object());
  EXPECT_GT(slab, 0.02);
  EXPECT_LT(slab, 0.35);
  EXPECT_LT(covered({{"since", 2e-3}}), 0.02) << "later than all: the legend's dot remains";
}

/// A disc has an edge: as long as the disc is wide.
TEST_F(Scenes, CracksAreSeenFromTheirEdge) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(4e-3);
  scene.write(from_.path());
  const double legend = drawn({{"show", "cracks"}, {"camera", {{"view", "front"}}}}).share_of(0, 114, 178);
  scene.add_crack({0, 0, 10e-3}, Vec3::UnitZ());
  Folder with;
  scene.write(with.path());
  render(with.path(), to_.path(),
         {{"size", 400}, {"pictures", {{{"show", "cracks"}, {"camera", {{"view", "front"}}}}}}}, host_);
  const Image image = read(to_.path() / "cracks.png");
  // 20 mm are 342 of 400 pixels: a line of 8 mm by some one and a half pixels.
  const double line = (image.share_of(0, 114, 178) - legend) * double(image.pixel.size());
  EXPECT_GT(line, 137);
  EXPECT_LT(line, 137 * 3);
}

TEST_F(Scenes, CracksAreAsLargeAsTheEnergyTheyReleased) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(3e-3);
  scene.add_crack({-5e-3, 0, 10e-3}, Vec3::UnitY(), 1e-6);
  scene.add_crack({5e-3, 0, 10e-3}, Vec3::UnitY(), 4e-6);
  scene.add_crack({0, 0, 16e-3}, Vec3::UnitY(), -9e-6);
  scene.write(from_.path());
  // Blue pixels in the left and right half of the box, and above both.
  const auto areas = [&](const Json& size_by) {
    Json picture = {{"show", "cracks"}, {"camera", {{"view", "front"}}}};
    if (!size_by.is_null()) picture["size_by"] = size_by;
    const Image image = drawn(picture);
    const double box = 342;  // pixels, of 400: from 12 to the right and from 46 upwards
    std::array<double, 3> n{};
    for (std::size_t k = 0; k < image.pixel.size(); ++k) {
      const auto& p = image.pixel[k];
      const double x = (double(k % std::size_t(image.width)) - 12) / box,
                   z = (double(k / std::size_t(image.width)) - 46) / box;
      if (x < 1 && p[2] > p[0] + 60) ++n[z > 0.66 ? 2 : x > 0.5];
    }
    return n;
  };
  const auto usual = areas(nullptr), by_energy = areas("energy");
  EXPECT_EQ(areas("area"), usual);
  EXPECT_NEAR(usual[0] / usual[1], 1, 0.02);
  EXPECT_GT(usual[2], 0.5 * usual[0]);
  EXPECT_NEAR(by_energy[1] / usual[1], 1, 0.02) << "the largest";
  EXPECT_NEAR(by_energy[0] / by_energy[1], 0.25, 0.03);
  EXPECT_EQ(by_energy[2], 0) << "it took energy";
}

TEST_F(Scenes, WithoutReleasedEnergySizesByItAreRefused) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(3e-3);
  scene.add_crack({0, 0, 10e-3}, Vec3::UnitY(), 1e-6);
  scene.write(from_.path());
  const fs::path file = from_.path() / "bonds_000000.vtp";
  std::string text = bytes(file);
  const std::string name = "released_energy";
  ASSERT_NE(text.find(name), text.npos);
  text.replace(text.find(name), name.size(), "something_other");
  std::ofstream(file, std::ios::binary) << text;
  EXPECT_THROW(render(from_.path(), to_.path(),
                      {{"size", 300}, {"pictures", {{{"show", "cracks"}, {"size_by", "energy"}}}}}, host_),
               UserError);
  ASSERT_EQ(host_.warnings.size(), 1u);
  EXPECT_NE(host_.warnings[0].find("`size_by: energy` needs the bond field `released_energy`"), std::string::npos)
      << host_.warnings[0];
}

TEST_F(ScenesOfCracks, AreSizedByAField) {
  // With areas in proportion to the radius, small discs are larger than their particles.
  const Json all = {{"slice", {{"thickness", 1}}}};
  Json sized = all;
  sized["size_by"] = "crack_radius";
  EXPECT_GT(blue(sized), 1.02 * blue(all));
}

TEST_F(ScenesOfCracks, AreSeenThroughTransparentParticles) {
  const Json grey = {{"show", "specimen"}, {"field", "radius"}, {"colour_map", "grey"}};
  Json glass = grey;
  glass["opacity"] = 0.3;
  const auto bluish = [](const Image& image) {
    return double(std::count_if(image.pixel.begin(), image.pixel.end(), [](auto& p) { return p[2] > p[0] + 50; })) /
           double(image.pixel.size());
  };
  EXPECT_LT(bluish(drawn(grey)), 0.001);
  EXPECT_GT(bluish(drawn(glass)), 0.01);
}

TEST_F(ScenesOfCracks, AFieldHasAHistogram) {
  const Json four = {{"size", 300}, {"pictures", {{{"show", "histogram"}, {"field", "force_shear"}, {"bins", 4}}}}};
  EXPECT_EQ(names(render(from_.path(), to_.path(), four, host_)),
            (Names{"histogram_force_shear.png", "histogram_force_shear.svg", "histogram_force_shear.pdf"}));
  const std::string svg = bytes(to_.path() / "histogram_force_shear.svg");
  const std::size_t bonds = specimen().view(0).bonds.size();
  EXPECT_NE(svg.find("force shear (N)"), std::string::npos);
  EXPECT_NE(svg.find("n = " + std::to_string(bonds / 1000) + "\u202f"), std::string::npos);
}

TEST(SceneKeys, ThoseThatDoNotGoTogetherAreRefused) {
  const auto issue = [](const Json& picture) {
    const Issues all = issues_of(BRECCIA_PICTURES_PLUGIN, {{"pictures", {picture}}});
    return all.size() == 1 ? all[0].path + ": " + all[0].text : std::to_string(all.size()) + " issues";
  };
  EXPECT_EQ(
      issue({{"show", "load_curve"}, {"opacity", 0.5}}),
      "pictures[0].opacity: this goes with pictures of particles and cracks, not with `load_curve`: leave it out, or "
      "choose another `show`");
  for (const Json& wrong :
       {Json{{"show", "specimen"}, {"since", 1e-3}}, Json{{"show", "cracks"}, {"field", "mass"}},
        Json{{"show", "histogram"}}, Json{{"show", "specimen"}, {"movie", "mp4"}, {"frame", 1}},
        Json{{"show", "specimen"}, {"frames_per_second", 5}},
        Json{{"show", "specimen"}, {"slice", {{"normal", {0, 0, 0}}, {"offset", 0}}}},
        Json{{"show", "specimen"}, {"camera", {{"direction", {1, 0, 0}}, {"up", {-2, 0, 0}}, {"zoom", 1}}}}})
    EXPECT_EQ(issue(wrong).rfind("pictures[0]", 0), 0u) << wrong << issue(wrong);
  EXPECT_EQ(issue({{"show", "specimen"}, {"opacity", 0.5}, {"since", 1e-3}}), "0 issues");
}

}  // namespace
}  // namespace breccia::test
