// SPDX-License-Identifier: BSD-3-Clause
/// Copies of a periodic cell: moved to the last bit, with the cell's contacts across the seams, each counted here one
/// by one.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <set>

#include "host.hpp"
#include "plugin_under_test.hpp"

namespace breccia {
namespace {

constexpr const char* plugin = BRECCIA_REPLICATED_CELL_PLUGIN;

/// Of each particle, over all images that may be near.
std::vector<int> contacts_of(const PackedParticles& p, int dimension) {
  std::vector<int> count(p.radius.size());
  const int z = dimension == 3 && p.period.z() > 0, y = p.period.y() > 0, x = p.period.x() > 0;
  for (std::size_t i = 0; i < p.radius.size(); ++i)
    for (std::size_t j = 0; j < p.radius.size(); ++j)
      for (int c = -z; c <= z; ++c)
        for (int b = -y; b <= y; ++b)
          for (int a = -x; a <= x; ++a) {
            if (i == j && a == 0 && b == 0 && c == 0) continue;
            const Vec3 far = p.position[j] + Vec3(a, b, c).cwiseProduct(p.period);
            count[i] += (far - p.position[i]).norm() < (1 + 1e-3) * (p.radius[i] + p.radius[j]);
          }
  return count;
}

class ReplicatedCell : public ::testing::Test {
 protected:
  static PackingRequest request(int dimension, const std::array<bool, 3>& periodic) {
    PackingRequest r{{dimension, dimension == 2 ? 0.5 : 1}, 1};
    r.periodic = periodic;
    return r;
  }
  /// 300 spheres at 38 % in 8 mm x 7 mm x 9 mm, some with overlaps; or discs.
  const PackedParticles& packed(int dimension, const std::array<bool, 3>& periodic) {
    static std::map<std::pair<int, std::array<bool, 3>>, PackedParticles> made;
    PackedParticles& p = made[{dimension, periodic}];
    if (!p.radius.empty()) return p;
    Json size = {8e-3, 7e-3};
    if (dimension == 3) size.push_back(9e-3);
    p = generate(*test::make<Packing>(BRECCIA_REARRANGEMENT_PLUGIN,
                                      {{"container", {{"shape", "box"}, {"size", size}}},
                                       {"radius", {{"distribution", "uniform"}, {"min", 0.4e-3}, {"max", 0.65e-3}}},
                                       {"porosity", dimension == 3 ? 0.36 : 0.14},
                                       {"overlap_tolerance", 0.2}}),
                 request(dimension, periodic), host_);
    return p;
  }
  /// As a table in metres, to the last bit.
  std::string file(const PackedParticles& p) {
    std::ostringstream csv;
    csv.precision(17);
    csv << "radius,x,y,z,grain\n";
    for (std::size_t k = 0; k < p.radius.size(); ++k)
      csv << p.radius[k] << ',' << p.position[k].x() << ',' << p.position[k].y() << ',' << p.position[k].z() << ',' << k
          << '\n';
    return folder_.file("cell.csv", csv.str()).string();
  }
  PackedParticles copies(const PackedParticles& cell, Json more, int dimension, const std::array<bool, 3>& periodic) {
    more["file"] = file(cell);
    more["length_unit"] = "m";
    if (!more.contains("period")) more["period"] = {cell.period.x(), cell.period.y(), cell.period.z()};
    return generate(*test::make<Packing>(plugin, more), request(dimension, periodic), host_);
  }
  std::string refusal(const PackedParticles& cell, const Json& more, int dimension = 3,
                      const std::array<bool, 3>& periodic = {}) {
    return test::user_error([&] { copies(cell, more, dimension, periodic); });
  }
  static void expect(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }

  static constexpr std::array<bool, 3> everywhere = {true, true, true}, nowhere = {},
                                       in_the_plane = {true, true, false};
  static constexpr const char* walls = "its boundary there cuts 0 contacts";
  test::Folder folder_;
  TestHost host_;
};

TEST_F(ReplicatedCell, CopiesAreMovedToTheLastBitWithTheContactsOfTheCell) {
  for (const int dimension : {3, 2}) {
    const auto& periodic = dimension == 3 ? everywhere : in_the_plane;
    const PackedParticles& cell = packed(dimension, periodic);
    const std::size_t n = cell.radius.size();
    const std::vector<int> of_cell = contacts_of(cell, dimension);
    const Json counts = dimension == 3 ? Json{{"x", 2}, {"y", 1}, {"z", 3}} : Json{{"x", 2}, {"y", 3}};
    const PackedParticles all = copies(cell, {{"copies", counts}}, dimension, periodic);
    ASSERT_EQ(all.radius.size(), 6 * n);
    const int ny = dimension == 3 ? 1 : 3, nz = dimension == 3 ? 3 : 1;
    EXPECT_EQ(all.period, Vec3(2 * cell.period.x(), ny * cell.period.y(), nz * cell.period.z()));
    std::size_t at = 0;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < ny; ++b)
        for (int c = 0; c < nz; ++c)
          for (std::size_t k = 0; k < n; ++k, ++at) {
            const Vec3 moved = cell.position[k] + Vec3(a * cell.period.x(), b * cell.period.y(), c * cell.period.z());
            ASSERT_EQ(all.position[at], moved) << "copy " << a << b << c << " of " << k;
            ASSERT_EQ(all.radius[at], cell.radius[k]);
            ASSERT_EQ(all.columns.at(0).second[at], double(k));
          }
    const std::vector<int> of_all = contacts_of(all, dimension);
    int sum = 0;
    for (std::size_t k = 0; k < of_all.size(); ++k) ASSERT_EQ(of_all[k], of_cell[k % n]) << "particle " << k;
    for (const int c : of_cell) sum += c;
    ASSERT_GT(sum, int(2 * n)) << "the cell must hold together";
    EXPECT_DOUBLE_EQ(got(all, "contacts_per_particle"), double(sum) / double(n));
    EXPECT_NEAR(got(all, "porosity"), got(cell, "porosity"), 1e-12);
    for (const AskedGot& line : all.report) {
      const double asked = line.asked.value_or(line.got);
      EXPECT_NEAR(line.got, asked, 1e-12 * std::abs(asked)) << line.name;
    }
    EXPECT_NEAR(all.container_volume, 6 * cell.container_volume, 1e-12 * all.container_volume);
    EXPECT_EQ(all.axis, dimension == 3 ? Vec3::UnitZ() : Vec3::UnitY());
  }
}

/// Lattice cells are smaller than the reach of their contacts: a sphere touches images of itself.
TEST_F(ReplicatedCell, CellsOfAFewParticlesMakeLattices) {
  struct Kind {
    const char* lattice;
    int dimension, neighbours;
    double porosity;
  };
  for (const Kind& k : {Kind{"sc", 3, 6, 0.476401},
                        {"fcc", 3, 12, 0.259520},
                        {"hcp", 3, 12, 0.259520},
                        {"bcc", 3, 8, 0.319825},
                        {"square", 2, 4, 0.214602},
                        {"hexagonal", 2, 6, 0.093100}}) {
    SCOPED_TRACE(k.lattice);
    const auto& periodic = k.dimension == 3 ? everywhere : in_the_plane;
    Json size = {2e-3, 2e-3};
    if (k.dimension == 3) size.push_back(2e-3);
    const PackedParticles cell =
        generate(*test::make<Packing>(
                     BRECCIA_REGULAR_PLUGIN,
                     {{"lattice", k.lattice}, {"container", {{"shape", "box"}, {"size", size}}}, {"radius", 1e-3}}),
                 request(k.dimension, periodic), host_);
    ASSERT_LE(cell.radius.size(), 4u);
    Json counts = {{"x", 3}, {"y", 4}};
    if (k.dimension == 3) counts["z"] = 3;
    const PackedParticles all = copies(cell, {{"copies", counts}}, k.dimension, periodic);
    EXPECT_EQ(all.radius.size(), (k.dimension == 3 ? 36 : 12) * cell.radius.size());
    EXPECT_EQ(got(all, "contacts_per_particle"), k.neighbours);
    EXPECT_NEAR(got(all, "porosity"), k.porosity, 1e-6);
    for (const int c : contacts_of(all, k.dimension)) ASSERT_EQ(c, k.neighbours);
  }
}

/// Which copy of which particle of the cell each is, or -1: to the last bit.
std::set<std::array<long, 4>> origins(const PackedParticles& all, const PackedParticles& cell) {
  std::set<std::array<long, 4>> found;
  for (std::size_t p = 0; p < all.radius.size(); ++p) {
    const auto k = std::size_t(all.columns.at(0).second[p]);
    std::array<long, 4> from{long(k), 0, 0, 0};
    Vec3 moved = cell.position[k];
    for (int d = 0; d < 3; ++d)
      if (cell.period[d] > 0) {
        const double n = std::round((all.position[p][d] - moved[d]) / cell.period[d]);
        moved[d] = cell.position[k][d] + n * cell.period[d];
        from[std::size_t(d) + 1] = long(n);
      }
    EXPECT_EQ(moved, all.position[p]);
    EXPECT_EQ(cell.radius[k], all.radius[p]);
    found.insert(from);
  }
  return found;
}

TEST_F(ReplicatedCell, WhatIsCutOutAreTheParticlesWithTheirCentresInside) {
  const PackedParticles& cell = packed(3, everywhere);
  const double diameter = 30e-3, height = 50e-3;
  const PackedParticles all =
      copies(cell, {{"cut", {{"shape", "cylinder"}, {"diameter", diameter}, {"height", height}}}}, 3, nowhere);
  EXPECT_EQ(all.outline, SpecimenShape::Outline::cylinder);
  EXPECT_EQ(all.period, Vec3::Zero());
  EXPECT_EQ(origins(all, cell).size(), all.radius.size()) << "none is there twice";
  // All copies that could be inside, far more than were made, one by one.
  std::size_t inside = 0;
  for (int a = -4; a <= 4; ++a)
    for (int b = -5; b <= 5; ++b)
      for (int c = -2; c <= 8; ++c)
        for (const Vec3& x : cell.position) {
          const Vec3 at = x + Vec3(a, b, c).cwiseProduct(cell.period);
          inside += std::hypot(at.x(), at.y()) <= diameter / 2 && at.z() >= 0 && at.z() <= height;
        }
  EXPECT_EQ(all.radius.size(), inside);
  EXPECT_NEAR(all.container_volume, std::numbers::pi / 4 * diameter * diameter * height, 1e-12);
  EXPECT_NEAR(got(all, "porosity"), got(cell, "porosity"), 0.01);
  EXPECT_NEAR(got(all, "radius_mean"), got(cell, "radius_mean"), 0.02 * got(cell, "radius_mean"));
}

TEST_F(ReplicatedCell, ABlockWithoutPeriodsHasTheCellsContactsWithin) {
  const PackedParticles& cell = packed(3, everywhere);
  const PackedParticles all = copies(cell, {{"copies", {{"x", 3}, {"y", 3}, {"z", 3}}}}, 3, nowhere);
  const std::size_t n = cell.radius.size();
  ASSERT_EQ(all.radius.size(), 27 * n);
  EXPECT_EQ(all.period, Vec3::Zero());
  EXPECT_EQ(all.outline, SpecimenShape::Outline::box);
  const std::vector<int> of_all = contacts_of(all, 3), of_cell = contacts_of(cell, 3);
  for (std::size_t k = 0; k < n; ++k) ASSERT_EQ(of_all[13 * n + k], of_cell[k]) << "the copy in the middle";
  EXPECT_LT(got(all, "contacts_per_particle"),
            0.99 * got(copies(cell, {{"copies", Json::object()}}, 3, everywhere), "contacts_per_particle"));
}

TEST_F(ReplicatedCell, APeriodicBoxIsAWholeNumberOfCells) {
  const PackedParticles& cell = packed(3, everywhere);
  const PackedParticles all =
      copies(cell, {{"cut", {{"shape", "box"}, {"size", {20e-3, 20e-3, 20e-3}}}}}, 3, {true, true, false});
  EXPECT_EQ(all.period, Vec3(3 * cell.period.x(), 3 * cell.period.y(), 0));  // 2.5 and 2.86 cells
  EXPECT_NEAR(all.container_volume, 9 * cell.period.x() * cell.period.y() * 20e-3, 1e-15);
  EXPECT_EQ(origins(all, cell).size(), all.radius.size());
  for (const Vec3& x : all.position) ASSERT_TRUE(x.z() >= 0 && x.z() <= 20e-3);
  const AskedGot& length =
      *std::find_if(all.report.begin(), all.report.end(), [](const AskedGot& line) { return line.name == "period_x"; });
  EXPECT_EQ(length.asked, 20e-3);
  EXPECT_EQ(length.got, all.period.x());
}

/// A frame of a later moment: no particle is moved back by the engine when it leaves the cell.
TEST_F(ReplicatedCell, CentresThatLeftTheCellAreBroughtBack) {
  PackedParticles cell = packed(3, everywhere);
  for (std::size_t k = 0; k < cell.radius.size(); k += 7) cell.position[k].y() += 3 * cell.period.y();
  const PackedParticles all = copies(cell, {{"copies", {{"y", 2}}}}, 3, everywhere);
  double low = 1, high = -1;
  for (const Vec3& x : all.position) {
    low = std::min(low, x.y());
    high = std::max(high, x.y());
  }
  EXPECT_LE(high - low, 2 * cell.period.y());
  EXPECT_EQ(contacts_of(all, 3),
            contacts_of(copies(packed(3, everywhere), {{"copies", {{"y", 2}}}}, 3, everywhere), 3));
}

TEST_F(ReplicatedCell, ACellThatIsNotPeriodicIsRefused) {
  const Json two = {{"x", 2}, {"y", 2}, {"z", 2}};
  PackedParticles walled = packed(3, nowhere);
  walled.period = Vec3(8e-3, 7e-3, 9e-3);
  expect(refusal(walled, {{"copies", two}}), "cell.csv is no cell that can be put beside itself");
  expect(refusal(walled, {{"copies", {{"z", 2}}}}), "along z: its boundary there cuts");
  expect(refusal(walled, {{"copies", Json::object()}}, 3, {true, false, false}), "along x: its boundary there cuts");
  EXPECT_EQ(copies(walled, {{"copies", Json::object()}}, 3, nowhere).radius.size(), walled.radius.size())
      << "one copy without a seam";
  // With ends between walls, periodic across: along the axis it has no copies.
  PackedParticles slab = packed(3, in_the_plane);
  EXPECT_EQ(copies(slab, {{"copies", {{"x", 2}, {"y", 2}}}}, 3, in_the_plane).radius.size(), 4 * slab.radius.size());
  expect(refusal(slab, {{"copies", two}}),
         "does not say after which length it repeats itself along z, and there are to "
         "be several copies: give `period`");
  expect(refusal(slab, {{"copies", {{"x", 2}}}}, 3, everywhere), "the specimen is to repeat itself there");
  expect(refusal(slab, {{"cut", {{"shape", "box"}, {"size", {8e-3, 8e-3, 30e-3}}}}}), "is shorter there than what");
  slab.period.z() = 9e-3;
  expect(refusal(slab, {{"copies", two}}), "along z: its boundary there cuts");
  slab.period.z() = 4.5e-3;  // what is brought back meets what is there
  expect(refusal(slab, {{"copies", {{"x", 2}}}}), "along z: contacts across its boundary there overlap by");
  // A period that is 4 % too short or too long.
  PackedParticles cell = packed(3, everywhere);
  cell.period.x() *= 0.96;
  expect(refusal(cell, {{"copies", two}}), "along x: contacts across its boundary there overlap by");
  cell.period.x() *= 1.04 / 0.96;
  expect(refusal(cell, {{"copies", two}}), "along x: its boundary there cuts");
}

TEST_F(ReplicatedCell, WhatCannotBeIsSaid) {
  const PackedParticles& cell = packed(3, everywhere);
  expect(refusal(cell, {{"copies", {{"x", 200}, {"y", 200}, {"z", 400}}}}),
         "200 x 200 x 400 copies of " + std::to_string(cell.radius.size()) + " particles are");
  expect(refusal(cell, {{"copies", {{"x", 200}, {"y", 200}, {"z", 400}}}}), "GB. More than 400 million particles");
  expect(refusal(cell, {{"cut", {{"shape", "sphere"}, {"diameter", 30.0}}}}),
         "look at the units of `cut` and `period`");
  expect(refusal(cell, {{"cut", {{"shape", "sphere"}, {"diameter", 1e20}}}}), "look at the units of `cut`");
  expect(refusal(cell, {{"cut", {{"shape", "sphere"}, {"diameter", 1e-6}}}}), "no particle has its centre");
  expect(refusal(cell, {{"cut", {{"shape", "cylinder"}, {"diameter", 0.02}, {"height", 0.04}}}}, 3, everywhere),
         "is filled by a box");
  expect(refusal(packed(2, in_the_plane), {{"copies", {{"z", 2}}}}, 2), "no copies along z");
  const Issues issues = test::issues_of(plugin, {{"file", "a.csv"}, {"length_unit", "mm"}, {"copies", {{"x", 2}}}});
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues[0].path, "period");
}

}  // namespace
}  // namespace breccia
