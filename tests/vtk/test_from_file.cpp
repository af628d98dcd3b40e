// SPDX-License-Identifier: BSD-3-Clause
#include "../support/generate.hpp"
#include "breccia/output.hpp"
#include "breccia/packing.hpp"
#include "plugin_under_test.hpp"
#include "specimen.hpp"

namespace breccia::test {
namespace {

class FromFile : public ::testing::Test {
 protected:
  PackedParticles load(const std::filesystem::path& file, Json more = {{"length_unit", "mm"}}, int dimension = 3) {
    more["file"] = file.string();
    if (!more.contains("outline")) more["outline"] = "box";
    return generate(*make<Packing>(BRECCIA_FROM_FILE_PLUGIN, more), {{dimension, 1}, 1}, host_);
  }
  /// What the user is told about a table.
  std::string refusal(const std::string& content, int dimension = 3) {
    const Json axis = {{"length_unit", "mm"}, {"axis", "x"}};
    return user_error([&] { load(folder_.file("p.csv", content), axis, dimension); });
  }
  void expect(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }

  Folder folder_;
  QuietHost host_;
};

TEST_F(FromFile, ColumnsInAnyOrderWithUnitAndComments) {
  const auto p = load(folder_.file(
      "p.csv", "# made by hand\r\n radius; z;\"x\" ;colour;y\r\n0.5;3;1;red;2 # first\r\n\r\n1e-1;-3;+1.5;blue;2\r\n"));
  ASSERT_EQ(p.radius.size(), 2u);
  EXPECT_EQ(p.position[0], 1e-3 * Vec3(1, 2, 3));
  EXPECT_EQ(p.position[1], 1e-3 * Vec3(1.5, 2, -3));
  EXPECT_EQ(p.radius[0], 1e-3 * 0.5);
  EXPECT_EQ(p.axis, Vec3::UnitZ());
  EXPECT_EQ(p.container_volume, 0);
  ASSERT_EQ(host_.notes.size(), 1u);
  expect(host_.notes[0], "column `colour`");
  ASSERT_EQ(p.report.size(), 4u);
  EXPECT_DOUBLE_EQ(p.report[1].got, 1e-4);
  EXPECT_DOUBLE_EQ(p.report[2].got, 3e-4);
  EXPECT_DOUBLE_EQ(p.report[3].got, 5e-4);
}

TEST_F(FromFile, EveryUnit) {
  const auto file = folder_.file("p.csv", "x,y,z,radius\n0,0,0,1\n");
  for (const auto& [unit, metres] : {std::pair{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}})
    EXPECT_DOUBLE_EQ(load(file, {{"length_unit", unit}}).radius[0], metres) << unit;
}

TEST_F(FromFile, BadTablesAreRefusedWithTheirLine) {
  expect(refusal("x,y,radius\n1,2,3\n"), "p.csv, line 1: no column `z`");
  expect(refusal("1,2,3,4\n"), "line 1: no column `x`");
  expect(refusal("x,y,z,radius,x\n"), "line 1: there are two columns `x`");
  expect(refusal("x,y,z,radius\n0,0,0,1\n1,oops,3,1\n"), "line 3: y is `oops`, which is not a number");
  expect(refusal("x,y,z,radius\n0,0,,1\n"), "line 2: z is ``, which is not a number");
  expect(refusal("x,y,z,radius\n0,0,0,1mm\n"), "line 2: radius is `1mm`");
  expect(refusal("x,y,z,radius\n0,0,0\n"), "line 2: 3 values, where the first line names 4 columns");
  expect(refusal("x,y,z,radius\nnan,0,0,1\n"), "line 2: the centre is not finite");
  expect(refusal("x,y,z,radius\n0,0,0,inf\n"), "line 2: the radius is not finite");
  expect(refusal("x,y,z,radius\n0,0,0,-1\n"), "line 2: the radius must be above 0");
  expect(refusal("x,y,z,radius\n0,0,0,0\n"), "line 2: the radius must be above 0");
  expect(refusal("x,y,z,radius\n1,2,3,1\n5,5,5,1\n# between\n1,2,3.0000000001,2\n"),
         "line 5: the same centre as line 2");
  expect(refusal("x,y,z,radius\n1e34,0,0,1\n-1e308,0,0,1\n"), "line 2: the centre is farther than 1e30 m");
  expect(refusal("x,y,z,radius\n0,0,0,1\n5,0,0,5e-310\n"), "line 3: the radius is not between 1e-30 m and 1e30 m");
  expect(refusal("x,y,z,radius\n0,0,0,1e34\n"), "line 2: the radius is not between 1e-30 m and 1e30 m");
  expect(refusal(""), "p.csv is empty");
  expect(refusal("x,y,z,radius\n"), "p.csv holds no particle");
  expect(user_error([&] { load(folder_.path() / "no.csv"); }), "no.csv: no such file");
}

TEST_F(FromFile, TwoDimensions) {
  const auto p = load(folder_.file("p.csv", "x,y,radius\n1,2,0.5\n"), {{"length_unit", "mm"}}, 2);
  EXPECT_EQ(p.position[0], 1e-3 * Vec3(1, 2, 0));
  EXPECT_EQ(p.axis, Vec3::UnitY());
  expect(refusal("x,y,z,radius\n0,0,1,1\n", 2), "line 2: z must be 0 in two dimensions");
  const auto file = folder_.path() / "p.csv";
  expect(user_error([&] {
           load(file, {{"length_unit", "mm"}, {"outline", "cylinder"}}, 2);
         }),
         "there is no cylinder: write `outline: box` for a rectangle or `outline: disc`");
  expect(user_error([&] { load(file, {{"length_unit", "mm"}, {"axis", "z"}}, 2); }), "the axis must be x or y");
}

TEST_F(FromFile, ASpaceThatRepeatsItself) {
  const auto load = [&](const std::string& rows, const Json& period, std::array<bool, 3> periodic) {
    PackingRequest request{{3, 1}, 1};
    request.periodic = periodic;
    return generate(
        *make<Packing>(BRECCIA_FROM_FILE_PLUGIN, {{"file", folder_.file("p.csv", "x,y,z,radius\n" + rows).string()},
                                                  {"length_unit", "mm"},
                                                  {"outline", "box"},
                                                  {"period", period}}),
        request, host_);
  };
  const std::array<bool, 3> x_and_z = {true, false, true};
  const Json period = {20e-3, 0.0, 30e-3};
  EXPECT_EQ(load("0,0,0,1\n5,0,0,1\n", period, x_and_z).period, Vec3(20e-3, 0, 30e-3));
  expect(user_error([&] { load("0,0,0,1\n", period, {true, true, true}); }), "`period` must say after which length");
  expect(user_error([&] { load("0,0,0,1\n", period, {false, false, true}); }), "write 0 there in `period`");
  expect(user_error([&] { load("1,0,0,1\n21,0,-30,1\n", period, x_and_z); }), "the same centre as line 2");
  expect(user_error([&] { load("1,0,0,1e9\n", period, x_and_z); }),
         "line 2: the particle is larger than the period along x");
}

TEST_F(FromFile, WhatTheParticlesFill) {
  using Outline = SpecimenShape::Outline;
  const auto file = folder_.file("p.csv", "x,y,z,radius\n1,2,0,0.5\n");
  const auto outline = [&](const char* name, int dimension) {
    return load(file, {{"length_unit", "mm"}, {"outline", name}}, dimension).outline;
  };
  EXPECT_EQ(outline("disc", 2), Outline::ellipsoid);
  EXPECT_EQ(outline("sphere", 2), Outline::ellipsoid);
  EXPECT_EQ(outline("sphere", 3), Outline::ellipsoid);
  EXPECT_EQ(outline("box", 2), Outline::box);
  expect(user_error([&] { outline("disc", 3); }), "write `outline: cylinder` or `outline: sphere`");
  EXPECT_EQ(load(file, {{"length_unit", "mm"}, {"outline", "disc"}}, 2).axis, Vec3::UnitY());
}

TEST_F(FromFile, TextsOfOtherSystems) {
  const std::string text = "x,y,z,radius\n1,2,3,0.5\n-1,2,3,0.25\n";
  std::string cr = text, wide;
  for (char& c : cr) c = c == '\n' ? '\r' : c;
  for (const char c : text) wide.append(1, c).append(1, '\0');
  for (const std::string& same : {"\xEF\xBB\xBF" + text, cr}) {
    const auto p = load(folder_.file("P.CSV", same));
    ASSERT_EQ(p.radius.size(), 2u);
    EXPECT_EQ(p.position[1], 1e-3 * Vec3(-1, 2, 3));
  }
  expect(refusal("\xFF\xFE" + wide), "p.csv:1:1: the file is UTF-16; save it as UTF-8");
  expect(refusal(wide), "p.csv:1:1: the file is UTF-16; save it as UTF-8");
  expect(refusal(text + std::string("1,\0", 3)), "p.csv:4:3: a zero byte");
  expect(refusal(cr + "1,2,3,\xFC\n"), "p.csv:4:7: the text is not UTF-8 here");
  expect(refusal(text + "1,\x1B[31m2,3,4\n"), "p.csv:4:3: a control character");
}

TEST_F(FromFile, ParametersThatContradictEachOther) {
  const auto issues = [](const Json& config) { return issues_of(BRECCIA_FROM_FILE_PLUGIN, config); };
  EXPECT_TRUE(issues({{"file", "/a.csv"}, {"length_unit", "mm"}, {"outline", "box"}}).empty());
  const Issues no_unit = issues({{"file", "/a.csv"}, {"outline", "box"}});
  ASSERT_EQ(no_unit.size(), 1u);
  EXPECT_EQ(no_unit[0].path, "length_unit");
  EXPECT_TRUE(issues({{"file", "/a.Csv"}, {"length_unit", "mm"}, {"outline", "disc"}}).empty());
  const Issues no_outline = issues({{"file", "/a.csv"}, {"length_unit", "mm"}});
  ASSERT_EQ(no_outline.size(), 1u);
  EXPECT_EQ(no_outline[0].path, "outline");
  const Issues type = issues({{"file", "/a.txt"}, {"outline", "box"}});
  ASSERT_EQ(type.size(), 1u);
  EXPECT_EQ(type[0].path, "file");
}

TEST_F(FromFile, TheFileEntersTheCacheKey) {
  const auto packing =
      make<Packing>(BRECCIA_FROM_FILE_PLUGIN, {{"file", "/a.csv"}, {"length_unit", "mm"}, {"outline", "box"}});
  EXPECT_EQ(packing->inputs(), std::vector<std::filesystem::path>{"/a.csv"});
}

#ifdef BRECCIA_HAS_VTK
TEST_F(FromFile, AFrameOfARunIsAPackingWithoutLoss) {
  const Specimen specimen(300, 3);
  auto output = make<Output>(BRECCIA_VTK_PLUGIN, {{"precision", "single"}});
  output->begin(folder_.path(), host_);
  output->frame(specimen.view(0), {});
  const auto p = load(folder_.path() / "particles_000000.vtp", {{"outline", "cylinder"}});
  const SimulationView view = specimen.view(0);
  EXPECT_TRUE(std::ranges::equal(p.position, view.particles.position));
  EXPECT_TRUE(std::ranges::equal(p.radius, view.particles.radius));
  EXPECT_EQ(p.outline, SpecimenShape::Outline::cylinder);
}

TEST_F(FromFile, BadVtpFilesAreRefused) {
  const Json cylinder = {{"outline", "cylinder"}};
  expect(user_error([&] { load(folder_.path() / "no.vtp", cylinder); }), "no.vtp: no such file");
  expect(user_error([&] { load(folder_.file("text.vtp", "x,y,z"), cylinder); }), "it is damaged, or no VTK poly data");
  // Types of arrays that VTK does not know ended the program.
  for (const char* type : {"Strifg", "\" typ=\"String"})
    expect(user_error([&] {
             load(folder_.file("type.vtp",
                               R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>)"
                               R"(<FieldData><Array Name="specimen_outline" NumberOfTuples="0" type=")" +
                                   std::string(type) + R"(" format="ascii"/></FieldData></PolyData></VTKFile>)"),
                  cylinder);
           }),
           "type.vtp: it is damaged");
  // Of this many components VTK looked for a name each, for hours.
  for (const char* components : {"1999999999999cii", "1999999999", "-3", "0", "3 "})
    expect(user_error([&] {
             load(folder_.file("many.vtp",
                               R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>)"
                               R"(<Piece NumberOfPoints="0"><PointData><DataArray type="Float64" Name="radius" )"
                               R"(NumberOfComponents=")" +
                                   std::string(components) +
                                   R"("/></PointData><Points><DataArray type="Float64" NumberOfComponents="3" )"
                                   R"(format="ascii"></DataArray></Points></Piece></PolyData></VTKFile>)"),
                  cylinder);
           }),
           "many.vtp: it is damaged");
  // More points than any file of this size can hold: memory for them was asked for.
  for (const char* points : {"3999999999999", "-1", "3 "})
    expect(user_error([&] {
             load(folder_.file("points.vtp",
                               R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>)"
                               R"(<Piece NumberOfPoints=")" +
                                   std::string(points) +
                                   R"("><Points><DataArray type="Float64" NumberOfComponents="3" )"
                                   R"(format="ascii">0 0 0</DataArray></Points></Piece></PolyData></VTKFile>)"),
                  cylinder);
           }),
           "points.vtp: it is damaged");
  auto output = make<Output>(BRECCIA_VTK_PLUGIN, {});
  output->begin(folder_.path(), host_);
  output->frame(Specimen(20, 3).view(0), {});
  expect(user_error([&] { load(folder_.path() / "walls_000000.vtp", cylinder); }), "no point array `radius`");
  std::ifstream in(folder_.path() / "particles_000000.vtp", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  for (const std::size_t length : {whole.size() / 20, whole.size() / 2, whole.size() - 30})
    expect(user_error([&] { load(folder_.file("cut.vtp", whole.substr(0, length)), cylinder); }),
           "cut.vtp: it is damaged");
  const Issues issues =
      issues_of(BRECCIA_FROM_FILE_PLUGIN, {{"file", "/a.vtp"}, {"length_unit", "mm"}, {"outline", "box"}});
  ASSERT_EQ(issues.size(), 1u);
  expect(issues[0].text, "is in metres");
}
#endif

}  // namespace
}  // namespace breccia::test
