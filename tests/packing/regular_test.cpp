// SPDX-License-Identifier: BSD-3-Clause
/// Lattices: distances, neighbours and porosities of the textbooks, counted here.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host.hpp"
#include "plugin_under_test.hpp"

namespace breccia {
namespace {

constexpr const char* plugin = BRECCIA_REGULAR_PLUGIN;

PackedParticles lattice(const Json& config, int dimension) {
  TestHost host;
  return generate(*test::make<Packing>(plugin, config), {{dimension, 0.5}, 1}, host);
}

const double root2 = std::numbers::sqrt2, root3 = std::numbers::sqrt3;

struct Kind {
  const char* name;
  int dimension, neighbours;
  double porosity;  // 1 - pi/6, 1 - sqrt(3) pi/8, 1 - pi/sqrt(18) twice, 1 - pi/4, 1 - pi/sqrt(12)
  Vec3 edge;        // of the orthogonal cell, in radii
};
const Kind kinds[] = {{"sc", 3, 6, 0.476401, {2, 2, 2}},
                      {"bcc", 3, 8, 0.319825, Vec3::Constant(4 / root3)},
                      {"fcc", 3, 12, 0.259520, Vec3::Constant(2 * root2)},
                      {"hcp", 3, 12, 0.259520, {2, 2 * root3, 2 * std::sqrt(8.0 / 3)}},
                      {"square", 2, 4, 0.214602, {2, 2, 0}},
                      {"hexagonal", 2, 6, 0.093100, {2, 2 * root3, 0}}};

TEST(Regular, RepeatsItselfAfterWholeCells) {
  TestHost host;
  for (const Kind& k : kinds) {
    SCOPED_TRACE(k.name);
    Json size = {12.3, 9.1};  // in radii; not whole cells
    if (k.dimension == 3) size.push_back(10.7);
    PackingRequest request{{k.dimension, 0.5}, 1};
    for (int c = 0; c < k.dimension; ++c) request.periodic[std::size_t(c)] = true;
    const PackedParticles p =
        generate(*test::make<Packing>(
                     plugin, {{"lattice", k.name}, {"container", {{"shape", "box"}, {"size", size}}}, {"radius", 1.0}}),
                 request, host);
    Space space = request;
    space.cell = Cell::box(p.period);
    for (int c = 0; c < k.dimension; ++c) {
      const double cells = p.period[c] / k.edge[c];
      EXPECT_NEAR(cells, std::round(cells), 1e-9);
      EXPECT_LT(std::abs(p.period[c] - size[std::size_t(c)].get<double>()), 0.501 * k.edge[c]);
    }
    for (std::size_t i = 0; i < p.radius.size(); ++i) {
      int touching = 0;
      for (std::size_t j = 0; j < p.radius.size(); ++j)
        touching += i != j && space.branch(p.position[i], p.position[j]).norm() < 2 * (1 + 1e-9);
      EXPECT_EQ(touching, k.neighbours) << "particle " << i << " knows no boundary";
    }
    const double each = space.solid_volume(1);
    EXPECT_NEAR(1 - double(p.radius.size()) * each / p.container_volume, k.porosity, 1e-5);
  }
}

TEST(Regular, DistancesNeighboursAndPorosity) {
  for (const Kind& k : kinds)
    for (const double gap : {0.0, 0.05, -0.02}) {
      SCOPED_TRACE(std::string(k.name) + " with a gap of " + std::to_string(gap));
      const double side = 23;  // in radii of 1
      Json size = {side, side};
      if (k.dimension == 3) size.push_back(side);
      const PackedParticles p = lattice(
          {{"lattice", k.name}, {"container", {{"shape", "box"}, {"size", size}}}, {"radius", 1.0}, {"gap", gap}},
          k.dimension);
      const double nearest = 2 * (1 + gap);
      const Vec3 middle = k.dimension == 2 ? Vec3(0, side / 2, 0) : Vec3(0, 0, side / 2);
      double closest = 1e9;
      std::size_t inner = 0;
      for (std::size_t i = 0; i < p.radius.size(); ++i) {
        const bool inside = (p.position[i] - middle).cwiseAbs().maxCoeff() < 5;
        int touching = 0;
        for (std::size_t j = 0; j < p.radius.size(); ++j) {
          if (i == j) continue;
          const double d = (p.position[i] - p.position[j]).norm();
          closest = std::min(closest, d);
          touching += d < nearest * (1 + 1e-9);
        }
        if (!inside) continue;
        ++inner;
        ASSERT_EQ(touching, k.neighbours) << p.position[i].transpose();
      }
      EXPECT_GT(inner, 10u);
      EXPECT_NEAR(closest, nearest, 1e-9);
      // Spheres with their centres in a window of 3 cells along each edge, wherever it begins, against the textbook.
      const Vec3 edge = (1 + gap) * k.edge, low = middle - Vec3(5.1, 5.2, 5.3), high = low + 3 * edge;
      int count = 0;
      for (const Vec3& x : p.position) {
        bool inside = true;
        for (int c = 0; c < k.dimension; ++c) inside = inside && x[c] >= low[c] && x[c] < high[c];
        count += inside;
      }
      const double each = k.dimension == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
      const double window = k.dimension == 2 ? 9 * edge.x() * edge.y() : 27 * edge.prod();
      EXPECT_NEAR(1 - count * each / window, 1 - (1 - k.porosity) / std::pow(1 + gap, k.dimension), 1e-6);
    }
}

/// A box of n whole cells and one diameter more: (n + 1)^3 corners, n^3 centres, 3 n^2 (n + 1) faces.
TEST(Regular, CountsOfWholeCellsByHand) {
  const auto count = [](const Kind& kind, const std::vector<double>& cells) {
    std::vector<double> size;
    for (std::size_t k = 0; k < cells.size(); ++k) size.push_back(2 + cells[k] * kind.edge[int(k)]);  // radius 1
    return lattice({{"lattice", kind.name}, {"container", {{"shape", "box"}, {"size", size}}}, {"radius", 1.0}},
                   int(cells.size()))
        .radius.size();
  };
  EXPECT_EQ(count(kinds[0], {6, 6, 6}), 343u);
  EXPECT_EQ(count(kinds[1], {5, 5, 5}), 216u + 125u);
  EXPECT_EQ(count(kinds[2], {5, 5, 5}), 216u + 3 * 25 * 6);
  EXPECT_EQ(count(kinds[4], {6, 4}), 35u);
  // Rows of 7 and 6 by turns, 9 rows.
  EXPECT_EQ(count(kinds[5], {6, 4}), 5u * 7 + 4 * 6);
  // Layers A of rows 7, 6, 7, 6, 7 and B, a third of the cell up y: rows 7 and 6 by turns, of which four fit.
  EXPECT_EQ(count(kinds[3], {6, 2, 1}), 2u * (3 * 7 + 2 * 6) + (2 * 7 + 2 * 6));
}

TEST(Regular, ABoxOfExactlyTenDiametersHoldsAThousand) {
  const PackedParticles p = lattice(
      {{"lattice", "sc"}, {"container", {{"shape", "box"}, {"size", {0.02, 0.02, 0.02}}}}, {"radius", 1e-3}}, 3);
  EXPECT_EQ(p.radius.size(), 1000u);
  EXPECT_NEAR(got(p, "porosity"), 1 - std::numbers::pi / 6, 1e-12);
  EXPECT_NEAR(p.container_volume, 8e-6, 1e-18);
  double low = 1;
  for (const Vec3& x : p.position) low = std::min(low, x.z());
  EXPECT_NEAR(low, 1e-3, 1e-15);
}

TEST(Regular, EveryContainerHoldsWholeSpheresOnly) {
  const PackedParticles cylinder =
      lattice({{"lattice", "hcp"},
               {"container", {{"shape", "cylinder"}, {"diameter", 0.02}, {"height", 0.03}}},
               {"radius", 1e-3}},
              3);
  bool on_axis = false;
  for (const Vec3& x : cylinder.position) {
    ASSERT_LE(std::hypot(x.x(), x.y()), 0.009 * (1 + 1e-9));
    ASSERT_GE(x.z(), 0.001 * (1 - 1e-9));
    ASSERT_LE(x.z(), 0.029 * (1 + 1e-9));
    on_axis = on_axis || x == Vec3(0, 0, 1e-3);
  }
  EXPECT_TRUE(on_axis);
  // The lattice fills a cylinder that is smaller by a radius all round with 74.05 %: 56 % of the whole one.
  EXPECT_NEAR(got(cylinder, "porosity"), 1 - 0.7405 * (9 * 9 * 28) / (10 * 10 * 30), 0.05);

  const PackedParticles disc = lattice(
      {{"lattice", "hexagonal"}, {"container", {{"shape", "sphere"}, {"diameter", 0.006}}}, {"radius", 1e-3}}, 2);
  EXPECT_EQ(disc.radius.size(), 7u);  // one and a ring of six, just fitting
  EXPECT_NEAR(disc.container_volume, 0.5 * std::numbers::pi / 4 * 36e-6, 1e-15);
  const PackedParticles ball =
      lattice({{"lattice", "fcc"}, {"container", {{"shape", "sphere"}, {"diameter", 0.006}}}, {"radius", 1e-3}}, 3);
  EXPECT_EQ(ball.radius.size(), 13u);  // one and its twelve neighbours, just fitting
}

TEST(Regular, MistakesAreNamed) {
  Json j = {{"lattice", "square"}, {"container", {{"shape", "box"}, {"size", {0.02, 0.02, 0.02}}}}, {"radius", 1e-3}};
  EXPECT_EQ(test::user_error([&] { lattice(j, 3); }), "in three dimensions the lattice is sc, bcc, fcc or hcp");
  j["lattice"] = "fcc";
  EXPECT_EQ(test::user_error([&] { lattice(j, 2); }), "in two dimensions the lattice is square or hexagonal");
  j["radius"] = 1e-6;
  EXPECT_NE(test::user_error([&] { lattice(j, 3); }).find("use a larger radius"), std::string::npos);
  j["radius"] = 0.011;
  const Issues issues = test::issues_of(plugin, j);
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues[0].path, "radius");
}

}  // namespace
}  // namespace breccia
