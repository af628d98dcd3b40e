// SPDX-License-Identifier: BSD-3-Clause
// Comparisons of runs and charts of tables.
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "breccia/renderer.hpp"
#include "plugin_under_test.hpp"

namespace breccia::test {
namespace {
namespace fs = std::filesystem;

/// Share of the pixels that are not white.
double drawn(const fs::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  const vtkIdType bytes = 3 * reader->GetOutput()->GetNumberOfPoints();
  const auto* p = static_cast<const unsigned char*>(reader->GetOutput()->GetScalarPointer());
  return 1 - double(std::count(p, p + bytes, 255)) / double(bytes);
}

std::string bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The points of each element that begins with `tag`, y upwards from the lower edge.
std::vector<std::vector<Eigen::Vector2d>> shapes(const std::string& svg, const std::string& tag) {
  std::vector<std::vector<Eigen::Vector2d>> all;
  for (auto at = svg.find(tag); at != svg.npos; at = svg.find(tag, at + 1)) {
    const auto begin = svg.find("points=\"", at) + 8;
    std::istringstream in(svg.substr(begin, svg.find('"', begin) - begin));
    all.emplace_back();
    for (double x = 0, y = 0; in >> x && in.ignore() && in >> y;) all.back().emplace_back(x, -y);
  }
  return all;
}

class Charts : public ::testing::Test {
 protected:
  /// A straight rise to `peak` [Pa] and a fall to nothing.
  void run(const std::string& name, double peak,
           const std::string& columns = "axial_strain,axial_stress_Pa,global_damage") {
    fs::create_directories(from_.path() / name);
    std::string text = columns + "\n";
    const auto cells = std::count(columns.begin(), columns.end(), ',') + 1;
    for (int k = 0; k <= 60; ++k) {
      text += std::to_string(k * 3e-4) + "," + std::to_string(peak * (k <= 50 ? k / 50.0 : (60 - k) / 10.0));
      text += (cells > 2 ? "," + std::to_string(k * 1e-3) : "") + "\n";
    }
    from_.file(name + "/curves.csv", text);
    runs_.push_back({from_.path() / name, name});
  }
  std::vector<fs::path> compare(Json settings = Json::object()) {
    settings["size"] = 400;
    return make<Renderer>(BRECCIA_PICTURES_PLUGIN, settings)->compare({runs_, to_.path()}, host_);
  }
  std::vector<fs::path> render(const Json& settings = {{"size", 400}}) {
    return make<Renderer>(BRECCIA_PICTURES_PLUGIN, settings)->render({from_.path(), to_.path()}, host_);
  }
  std::string study(StudyChart chart) {
    chart.file = to_.path() / "study";
    const auto made = make<Renderer>(BRECCIA_PICTURES_PLUGIN, Json{{"size", 400}})->chart(chart, host_);
    EXPECT_EQ(made,
              (std::vector<fs::path>{to_.path() / "study.png", to_.path() / "study.svg", to_.path() / "study.pdf"}));
    EXPECT_GT(drawn(made.at(0)), 0.01);
    return bytes(made.at(1));
  }
  void table(const std::string& name, const std::string& text) {
    fs::create_directories(from_.path() / "tables");
    from_.file("tables/" + name + ".csv", text);
  }
  Folder from_, to_;
  QuietHost host_;
  std::vector<ComparisonRequest::Run> runs_;
};

TEST_F(Charts, RunsAreDrawnOverEachOther) {
  run("model 1", 300e6);
  run("a < b & c", 150e6);
  const auto made = compare();
  ASSERT_EQ(made.size(), 6u);  // two charts: the runs have no columns of bonds broken by mode
  EXPECT_EQ(host_.notes.size(), 2u);
  for (const char* file : {"stress_strain.png", "global_damage.png"}) EXPECT_GT(drawn(to_.path() / file), 0.02) << file;
  const std::string svg = bytes(to_.path() / "stress_strain.svg");
  for (const char* part : {">model 1<", ">a &lt; b &amp; c<", "axial strain ε (%)", "axial stress σ (MPa)"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  const auto curves = shapes(svg, "<polyline");
  ASSERT_EQ(curves.size(), 2u);
  const auto height = [](const auto& curve) {
    double most = 0;
    for (const auto& p : curve) most = std::max(most, p.y() - curve.front().y());
    return most;
  };
  EXPECT_EQ(curves[0].size(), 61u);
  EXPECT_NEAR(height(curves[0]) / height(curves[1]), 2, 1e-3);
  EXPECT_NE(svg.find("stroke-dasharray"), std::string::npos) << "black-and-white print";
}

TEST_F(Charts, OfAStudyMarkEveryPoint) {
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
    return n;
  };
  StudyChart chart{{"ks/kn", "1"},
                   {"peak stress", "Pa"},
                   {{"b = 0.1", {0.1, 0.2, 0.5}, {1e8, 2e8, 4e8}, true},
                    {"b = 0.2", {0.1, 0.2, 0.5, 0.8}, {2e8, 3e8, 3e8, NAN}, true}},
                   {}};
  std::string svg = study(chart);
  for (const char* part : {">ks/kn<", ">peak stress (MPa)<", ">b = 0.1<", ">b = 0.2<"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  const auto lines = shapes(svg, "<polyline");
  ASSERT_EQ(lines.size(), 2u);
  ASSERT_EQ(lines[0].size(), 3u);
  EXPECT_EQ(lines[1].size(), 3u) << "what is not finite is not drawn";
  EXPECT_NEAR((lines[0][2].y() - lines[0][0].y()) / (lines[0][1].y() - lines[0][0].y()), 3, 1e-2);
  EXPECT_EQ(count(svg, "<circle"), 3u + 1) << "its points and the legend's";
  chart.series = {{"", {1, 2, 2}, {1e8, 2e8, 4e8}, false}};
  svg = study(chart);
  EXPECT_EQ(count(svg, "<polyline"), 0u);
  EXPECT_EQ(count(svg, "<circle"), 3u) << "a single series needs no legend";
  chart.series = {{"", {1}, {1e8}, true}};
  EXPECT_NE(user_error([&] { study(chart); }).find("fewer than two points"), std::string::npos);
}

TEST_F(Charts, TenRunsAreToldApart) {
  for (int k = 0; k < 10; ++k) run("run number " + std::to_string(k), (20 - k) * 1e7);
  compare();
  const std::string svg = bytes(to_.path() / "stress_strain.svg");
  std::vector<std::string> pens;
  for (auto at = svg.find("<polyline"); at != svg.npos; at = svg.find("<polyline", at + 1))
    pens.push_back(svg.substr(at, svg.find("points=", at) - at));
  ASSERT_EQ(pens.size(), 10u);
  std::sort(pens.begin(), pens.end());
  EXPECT_EQ(std::unique(pens.begin(), pens.end()), pens.end());
  for (int k = 0; k < 10; ++k) EXPECT_NE(svg.find(">run number " + std::to_string(k) + "<"), std::string::npos);
}

TEST_F(Charts, ALegendWithoutAFreeCornerStandsBelowTheAxes) {
  run("short", 1e8);
  compare();
  EXPECT_NE(bytes(to_.path() / "stress_strain.svg").find("height=\"300\""), std::string::npos)
      << "the plain sheet, 4:3";
  runs_[0].label = std::string(50, 'w');
  compare();
  const std::string svg = bytes(to_.path() / "stress_strain.svg");
  EXPECT_EQ(svg.find("height=\"300\""), std::string::npos);
  const auto curve = shapes(svg, "<polyline").at(0);
  const auto words = svg.rfind("translate(", svg.find(runs_[0].label));
  double x = 0, y = 0;  // of the label, downwards
  std::istringstream(svg.substr(words + 10)) >> x >> y;
  EXPECT_GT(y, -curve.front().y() + 20) << "the curve begins on the horizontal axis";
}

TEST_F(Charts, ARunWithoutTheColumnIsLeftOutAndNamed) {
  run("whole", 1e8);
  run("half", 1e8, "axial_strain,axial_stress_Pa");
  EXPECT_EQ(compare().size(), 6u);
  ASSERT_EQ(host_.warnings.size(), 1u);
  EXPECT_NE(host_.warnings[0].find("`global_damage` is without `half`"), std::string::npos) << host_.warnings[0];
  EXPECT_EQ(bytes(to_.path() / "global_damage.svg").find(">half<"), std::string::npos);
}

TEST_F(Charts, AskedForColumnsMustBeThere) {
  run("a", 1e8);
  const Json asked = {
      {"comparisons", {{{"x", "axial_strain"}, {"y", "axial_stress"}}, {{"x", "axial_strain"}, {"y", "axial_stres"}}}}};
  EXPECT_NE(user_error([&] { compare(asked); }).find("no column `axial_stres`; did you mean `axial_stress_Pa`?"),
            std::string::npos);
  EXPECT_TRUE(fs::is_empty(to_.path())) << "nothing half-made";
  const Json twice = {{"comparisons", {{{"x", "a"}, {"y", "b"}}, {{"x", "c"}, {"y", "b"}}}}};
  ASSERT_EQ(issues_of(BRECCIA_PICTURES_PLUGIN, twice).size(), 1u);
  EXPECT_EQ(issues_of(BRECCIA_PICTURES_PLUGIN, twice)[0].path, "comparisons[1]");
}

TEST_F(Charts, AHistogramHasABarForEachInterval) {
  table("histogram_pair_minimum_radius_squared",
        "from_m2,to_m2,count,fraction\n1e-7,3e-7,200,0.2\n3e-7,5e-7,500,0.5\n5e-7,7e-7,0,0\n7e-7,9e-7,1300,0.3\n");
  ASSERT_EQ(render().size(), 3u);
  EXPECT_GT(drawn(to_.path() / "histogram_pair_minimum_radius_squared.png"), 0.05);
  const std::string svg = bytes(to_.path() / "histogram_pair_minimum_radius_squared.svg");
  for (const char* part : {"pair minimum radius squared rₘ² (mm²)", "fraction (%)", "n = 2\u202f000"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  const auto bars = shapes(svg, "<polygon fill=\"#99c7e0\"");
  ASSERT_GE(bars.size(), 3u);  // the empty interval has none; the last one is the legend's
  const auto height = [&](std::size_t k) { return bars[k][2].y() - bars[k][1].y(); };
  EXPECT_NEAR(height(1) / height(0), 2.5, 0.01);
  EXPECT_NEAR(height(2) / height(0), 1.5, 0.01);
  EXPECT_NEAR(bars[1][0].x(), bars[0][1].x(), 0.011);
  EXPECT_NEAR((bars[2][0].x() - bars[0][0].x()) / (bars[0][1].x() - bars[0][0].x()), 3, 0.01);
}

TEST_F(Charts, ARoseHasASectorForEachInterval) {
  std::string text = "angle_from_rad,angle_to_rad,count,fraction\n";
  const double fractions[] = {0.4, 0.1, 0.2, 0.3};
  for (int k = 0; k < 4; ++k) {
    const double quarter = std::numbers::pi / 2;
    text += std::to_string(k * quarter) + "," + std::to_string((k + 1) * quarter) + ",5," +
            std::to_string(fractions[k]) + "\n";
  }
  table("rose_yz", text);
  ASSERT_EQ(render().size(), 3u);
  EXPECT_GT(drawn(to_.path() / "rose_yz.png"), 0.1);
  const std::string svg = bytes(to_.path() / "rose_yz.svg");
  for (const char* part : {"yz plane", ">0° y<", ">90° z<", ">330°<", "mean 25 %"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  const auto sectors = shapes(svg, "<polygon fill=\"#99c7e0\"");
  ASSERT_EQ(sectors.size(), 4u);
  const auto radius = [&](std::size_t k) { return (sectors[k][1] - sectors[k][0]).norm(); };
  for (std::size_t k = 1; k < 4; ++k) EXPECT_NEAR(radius(k) / radius(0), fractions[k] / 0.4, 1e-3) << k;
  EXPECT_NEAR(sectors[0][1].y(), sectors[0][0].y(), 0.011) << "the first sector begins to the right";
  EXPECT_GT(sectors[0].back().y(), sectors[0][0].y() + 50) << "and goes up";
}

TEST_F(Charts, OtherTablesAreLeftAloneAndDamagedOnesNamed) {
  table("notes", "depth_m,value\n1,2\n");
  table("histogram_good", "from,to,count,fraction\n0,1,1,0.5\n1,2,1,0.5\n");
  table("histogram_torn", "from,to,count,fraction\n0,1,1\n");
  const Json only = {{"size", 300}, {"pictures", {{{"show", "tables"}}}}};
  EXPECT_EQ(render(only).size(), 3u);
  ASSERT_EQ(host_.warnings.size(), 1u);
  EXPECT_NE(host_.warnings[0].find("histogram_torn.csv, line 2: 3 values for 4 columns"), std::string::npos)
      << host_.warnings[0];
}

/// Means by direction, one column empty where nothing was counted: a line each, of the family of the last column alone.
TEST_F(Charts, ProfilesAreLinesOverTheMiddlesOfTheIntervals) {
  table("by_angle",
        "angle_from_rad,angle_to_rad,contacts,ratio_all,ratio_tensile\n0,0.5235987756,5,0.2,0.1\n"
        "0.5235987756,1.0471975512,7,0.4,0.1\n1.0471975512,1.5707963268,9,0.6,\n");
  ASSERT_EQ(render().size(), 3u);
  const std::string svg = bytes(to_.path() / "by_angle.svg");
  for (const char* part : {">all<", ">tensile<", "angle (°)", ">ratio<"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  EXPECT_EQ(svg.find("contacts"), std::string::npos);
  const auto lines = shapes(svg, "<polyline");
  ASSERT_EQ(lines.size(), 1u) << "the other has two points: a <line>";
  ASSERT_EQ(lines[0].size(), 3u);
  EXPECT_NEAR(lines[0][2].x() - lines[0][1].x(), lines[0][1].x() - lines[0][0].x(), 0.02);
  EXPECT_NEAR(lines[0][2].y() - lines[0][1].y(), lines[0][1].y() - lines[0][0].y(), 0.02);
  EXPECT_GT(lines[0][2].y(), lines[0][0].y());
}

TEST_F(Charts, WhatCurvesJsonSaysAmissIsTakenFromTheHeader) {
  for (const char* name : {"a", "b"}) {
    run(name, 1e6);
    from_.file(std::string(name) + "/curves.json",
               R"([{"header": "axial_strain", "name": 3, "unit": ["m"]}, {"header": "axial_stress_Pa", "unit": {},
                   "name": "axial_stress"}, {"header": "global_damage", "name": null}])");
  }
  compare();
  EXPECT_FALSE(fs::is_empty(to_.path()));
}

/// A test that nobody knows: what its curves are is said by their roles.
TEST_F(Charts, CurvesOfOtherNamesAreFoundByTheirRoles) {
  run(".", 1e6, "squeeze,push_Pa,cracked");
  from_.file("curves.json", R"([{"header": "squeeze", "name": "squeeze", "unit": "1", "role": "machine_strain"},
      {"header": "push_Pa", "name": "push", "unit": "Pa", "role": "machine_stress"},
      {"header": "cracked", "name": "cracked", "unit": "1"}])");
  ASSERT_EQ(render().size(), 3u);
  const std::string svg = bytes(to_.path() / "stress_strain.svg");
  for (const char* part : {"squeeze", "push", "MPa"}) EXPECT_NE(svg.find(part), std::string::npos) << part;
  EXPECT_EQ(svg.find("cracked"), std::string::npos) << "is nothing in particular";
}

TEST_F(Charts, NothingIsSaidOfDamageWhereThereIsNone) {
  const auto svg = [&](double damage, const std::string& first) {
    std::string text = "axial_strain,axial_stress_Pa,global_damage\n" + first + ",0,0\n";
    for (int k = 1; k < 10; ++k)
      text += std::to_string(k * 1e-3) + "," + std::to_string(k * 1e6) + "," + std::to_string(damage) + "\n";
    Folder one;
    one.file("curves.csv", text);
    make<Renderer>(BRECCIA_PICTURES_PLUGIN, {{"size", 300}, {"pictures", {{{"show", "stress_strain"}}}}})
        ->render({one.path(), to_.path()}, host_);
    return bytes(to_.path() / "stress_strain.svg");
  };
  EXPECT_NE(svg(0.2, "0").find("broken bonds"), std::string::npos);
  EXPECT_EQ(svg(0, "0").find("broken bonds"), std::string::npos);
  // Less than a line's width below zero is no reason to begin the axis there.
  EXPECT_EQ(svg(0, "-1e-9"), svg(0, "0"));
}

TEST_F(Charts, MohrCirclesAreRoundAndTheLineTouchesThem) {
  // On one line: sigma_1 = 20 MPa + 4 sigma_3, hence c = 5 MPa and sin(phi) = 0.6.
  const auto test = [&](const std::string& name, double confining, double axial) {
    run(name, axial);
    const Json summary = {
        {"a_test", {{"peak_platen_stress_Pa", axial}, {"peak_deviatoric_platen_stress_Pa", axial - confining}}}};
    from_.file(name + "/summary.json", summary.dump());
  };
  test("at 0", 0, 20e6);
  test("at 10", 10e6, 60e6);
  compare();
  const std::string svg = bytes(to_.path() / "strength_envelope.svg");
  for (const char* part : {"c = 5 MPa, φ = 36.9°", ">at 0<", ">at 10<", "normal stress σ (MPa)"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  const auto circles = shapes(svg, "<polyline");
  ASSERT_EQ(circles.size(), 2u);
  for (const auto& c : circles) {
    ASSERT_EQ(c.size(), 91u);
    EXPECT_NEAR(c[45].y() - c[0].y(), 0.5 * (c[90].x() - c[0].x()), 0.03) << "as high as its radius";
  }
  EXPECT_NEAR((circles[1][90].x() - circles[1][0].x()) / (circles[0][90].x() - circles[0][0].x()), 2.5, 0.01);
  // The tangent at the angle 90° - phi from the left of each circle lies on the line: compare both tangent points'
  // slope.
  const double turn = std::numbers::pi / 2 - std::asin(0.6);
  const auto tangent = [&](const auto& c) {
    const double radius = 0.5 * (c[90].x() - c[0].x());
    return Eigen::Vector2d(c[0].x() + radius * (1 - std::cos(turn)), c[0].y() + radius * std::sin(turn));
  };
  const Eigen::Vector2d way = tangent(circles[1]) - tangent(circles[0]);
  EXPECT_NEAR(way.y() / way.x(), 0.75, 1e-3);
}

TEST_F(Charts, WithoutTwoConfiningPressuresThereIsNoEnvelope) {
  for (const char* name : {"a", "b"}) {
    run(name, 3e7);
    from_.file(std::string(name) + "/summary.json",
               R"({"a_test": {"peak_platen_stress_Pa": 3e7, "peak_deviatoric_platen_stress_Pa": 3e7}})");
  }
  compare();
  EXPECT_FALSE(fs::exists(to_.path() / "strength_envelope.svg"));
}

}  // namespace
}  // namespace breccia::test
