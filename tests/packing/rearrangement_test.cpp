// SPDX-License-Identifier: BSD-3-Clause
/// Collective rearrangement, from end to end: what it promises, looked at by loops of the tests' own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "breccia/packing_tools/radius_distribution.hpp"
#include "host.hpp"
#include "plugin_under_test.hpp"

namespace breccia {
namespace {

using test::user_error;
constexpr const char* plugin = BRECCIA_REARRANGEMENT_PLUGIN;

PackedParticles pack(const Json& config, Host& host, std::uint64_t seed = 1, int dimension = 3) {
  return generate(*test::make<Packing>(plugin, config), {{dimension, 0.5}, seed}, host);
}

/// Radii of ratio 3, about 350 spheres at 45 % porosity.
Json loose(Json container) {
  return {{"container", std::move(container)},
          {"porosity", 0.45},
          {"radius", {{"distribution", "uniform"}, {"min", 0.3e-3}, {"max", 0.9e-3}}}};
}
const Json cylinder = {{"shape", "cylinder"}, {"diameter", 0.010}, {"height", 0.008}};
const Json box = {{"shape", "box"}, {"size", {0.008, 0.009, 0.0085}}};
const Json ball = {{"shape", "sphere"}, {"diameter", 0.0105}};
const Json rectangle = {{"shape", "box"}, {"size", {0.02, 0.03}}};
const Json disc = {{"shape", "sphere"}, {"diameter", 0.025}};

struct Overlaps {
  double largest = 0, sum = 0;
};
Overlaps overlaps(const PackedParticles& p) {
  Overlaps o;
  for (std::size_t i = 0; i < p.radius.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double part = 1 - (p.position[i] - p.position[j]).norm() / (p.radius[i] + p.radius[j]);
      o.largest = std::max(o.largest, part);
      o.sum += std::max(0.0, part);
    }
  return o;
}

double solid(const PackedParticles& p, int dimension) {
  double sum = 0;
  for (const double r : p.radius)
    sum += dimension == 2 ? std::numbers::pi * r * r : 4 * std::numbers::pi / 3 * r * r * r;
  return sum;
}

/// How far sphere i reaches out of a container that stands on the origin, over its radius.
double out_of(const Json& container, const Vec3& x, double r, int dimension) {
  const double across = dimension == 2 ? std::abs(x.x()) : std::hypot(x.x(), x.y());
  const double up = dimension == 2 ? x.y() : x.z();
  const std::string shape = container["shape"];
  double least;
  if (shape == "sphere") {
    const double radius = 0.5 * container["diameter"].get<double>();
    least = radius - std::hypot(across, up - radius);
  } else if (shape == "cylinder") {
    least = std::min({0.5 * container["diameter"].get<double>() - across, up, container["height"].get<double>() - up});
  } else {
    const auto size = container["size"].get<std::vector<double>>();
    least = std::min({0.5 * size[0] - std::abs(x.x()), up, size.back() - up});
    if (dimension == 3) least = std::min(least, 0.5 * size[1] - std::abs(x.y()));
  }
  return (r - least) / r;
}

struct Case {
  const char* name;
  Json container;
  int dimension;
  double measure;  // [m3], [m2]: by hand
};
const Case cases[] = {
    {"cylinder", cylinder, 3, std::numbers::pi * 25e-6 * 0.008},
    {"box", box, 3, 0.008 * 0.009 * 0.0085},
    {"sphere", ball, 3, std::numbers::pi / 6 * 0.0105 * 0.0105 * 0.0105},
    {"rectangle", rectangle, 2, 6e-4},
    {"disc", disc, 2, std::numbers::pi / 4 * 6.25e-4},
};

TEST(CollectiveRearrangement, ACellThatRepeatsItselfHasNoWalls) {
  const Json config = {{"container", {{"shape", "box"}, {"size", {10e-3, 10e-3, 10e-3}}}},
                       {"radius", {{"distribution", "uniform"}, {"min", 0.4e-3}, {"max", 0.7e-3}}},
                       {"porosity", 0.42}};
  PackingRequest request{{3, 1}, 5};
  request.periodic = {true, true, true};
  TestHost host;
  const PackedParticles p = generate(*test::make<Packing>(plugin, config), request, host);
  EXPECT_EQ(p.period, Vec3::Constant(10e-3));
  Space space = request;
  space.cell = Cell::box(p.period);
  double solid = 0, deepest = 0;
  Vec3 low = p.position[0], high = low;
  for (std::size_t i = 0; i < p.radius.size(); ++i) {
    solid += space.solid_volume(p.radius[i]);
    low = low.cwiseMin(p.position[i]);
    high = high.cwiseMax(p.position[i]);
    for (std::size_t j = 0; j < i; ++j)
      deepest = std::max(deepest, 1 - space.branch(p.position[i], p.position[j]).norm() / (p.radius[i] + p.radius[j]));
  }
  EXPECT_LT(deepest, 1e-3) << "nor an overlap across a face";
  EXPECT_NEAR(1 - solid / 1e-6, 0.42, 2e-3);
  // Centres reach the faces, which a wall would keep them off.
  EXPECT_LT(low.x(), -4.9e-3);
  EXPECT_GT(high.y(), 4.9e-3);
  EXPECT_LT(low.z(), 0.1e-3);
  EXPECT_GE(low.z(), 0);
  EXPECT_LT(high.z(), 10e-3);
}

TEST(CollectiveRearrangement, WhatCannotRepeatItselfSaysSo) {
  PackingRequest request{{3, 1}, 5};
  request.periodic = {true, false, false};
  const Json cube = {{"container", {{"shape", "box"}, {"size", {10e-3, 10e-3, 10e-3}}}},
                     {"radius", {{"distribution", "uniform"}, {"min", 0.4e-3}, {"max", 0.5e-3}}},
                     {"particles", 10}};
  Json margin = cube, round = cube;
  margin["margin"] = 1e-3;
  round["container"] = {{"shape", "cylinder"}, {"diameter", 10e-3}, {"height", 20e-3}};
  EXPECT_EQ(test::make<Packing>(plugin, cube)->why_not(request), "");
  EXPECT_NE(test::make<Packing>(plugin, margin)->why_not(request).find("margin"), std::string::npos);
  EXPECT_NE(test::make<Packing>(plugin, round)->why_not(request).find("box"), std::string::npos);
}

TEST(CollectiveRearrangement, ASpecimenAsWideAsItsVesselLiesFlushAgainstTheSides) {
  // Packed as the rectangle alone, to the last bit; of that, the discs whose centres lie in the middle's circle.
  TestHost host;
  Json config = loose(rectangle);
  config["porosity"] = 0.16;  // jammed, so that the walls are touched
  config["overlap_tolerance"] = 0.2;
  const PackedParticles whole = pack(config, host, 1, 2);
  config["container"] = {{"shape", "sphere"}, {"diameter", 0.02}};
  config["vessel"] = {0.02, 0.03};
  const PackedParticles p = pack(config, host, 1, 2);
  std::vector<Vec3> expected;
  for (const Vec3& x : whole.position)
    if (std::hypot(x.x(), x.y() - 0.015) <= 0.01) expected.push_back(x - Vec3(0, 0.005, 0));
  ASSERT_EQ(p.position.size(), expected.size());
  std::size_t sides[2] = {0, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((p.position[i] - expected[i]).norm(), 1e-15);
    for (const int side : {0, 1})
      sides[side] += std::abs(0.01 - (side ? 1 : -1) * p.position[i].x() - p.radius[i]) < 1e-3 * p.radius[i];
  }
  EXPECT_GE(sides[0], 3u) << "a disc cut free all round has one";
  EXPECT_GE(sides[1], 3u);
  EXPECT_EQ(p.outline, SpecimenShape::Outline::ellipsoid);
}

TEST(CollectiveRearrangement, AVesselThatIsTooNarrowSaysSo) {
  Json config = loose(cylinder);
  config["vessel"] = {0.010, 0.0099, 0.008};
  const PackingRequest request{{3, 1}, 5};
  EXPECT_NE(test::make<Packing>(plugin, config)->why_not(request).find("narrower along y"), std::string::npos);
  config["vessel"] = {0.010, 0.010};
  EXPECT_NE(test::make<Packing>(plugin, config)->why_not(request).find("three entries"), std::string::npos);
  config["vessel"] = {0.010, 0.010, 0.008};
  EXPECT_EQ(test::make<Packing>(plugin, config)->why_not(request), "");
}

TEST(Rearrangement, LoosePackingsTouchNothingAndStayInside) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    TestHost host;
    const PackedParticles p = pack(loose(c.container), host, 1, c.dimension);
    ASSERT_GT(p.radius.size(), 200u);
    EXPECT_LE(overlaps(p).largest, 1e-3);
    double farthest = -1;
    for (std::size_t i = 0; i < p.radius.size(); ++i)
      farthest = std::max(farthest, out_of(c.container, p.position[i], p.radius[i], c.dimension));
    EXPECT_LE(farthest, 1e-9);
    for (const Vec3& x : p.position) ASSERT_TRUE(c.dimension == 3 || x.z() == 0);
    // The number that comes nearest: the next one, of mean size, is farther off.
    const double mean = solid(p, c.dimension) / double(p.radius.size());
    EXPECT_NEAR(solid(p, c.dimension), 0.55 * c.measure, 0.51 * mean);
    EXPECT_NEAR(p.container_volume, c.measure * (c.dimension == 2 ? 0.5 : 1), 1e-9 * c.measure);
    EXPECT_NEAR(got(p, "porosity"), 1 - solid(p, c.dimension) / c.measure, 1e-9);
    EXPECT_EQ(host.warnings, "");
    EXPECT_TRUE(host.never_back);
    EXPECT_EQ(host.last, 1);
  }
}

TEST(Rearrangement, RadiiAreTheQuantilesToTheLastBit) {
  TestHost host;
  PackedParticles p = pack(loose(cylinder), host);
  std::sort(p.radius.begin(), p.radius.end());
  RadiusConfig radius;
  radius.distribution = DistributionFamily::uniform;
  radius.min = 0.3e-3;
  radius.max = 0.9e-3;
  EXPECT_EQ(p.radius, quantile_radii(radius.law(), p.radius.size()));
}

TEST(Rearrangement, SameBitsForAnyNumberOfThreadsOtherPlacesForAnotherSeed) {
  Json dense = loose(cylinder);  // overlapping neighbours to the end, and drawn together
  dense["porosity"] = 0.32;
  dense["overlap_tolerance"] = 0.5;
  dense["neighbours_per_particle"] = 8.0;
  dense["max_iterations"] = 100;
  dense["margin"] = 1e-3;
  TestHost one(1), three(3);
  const PackedParticles a = pack(dense, one, 7);
  EXPECT_TRUE(same_bits(a, pack(dense, three, 7)));
  EXPECT_FALSE(same_bits(a, pack(dense, one, 8)));
}

TEST(Rearrangement, ReportsTheOverlapsThatAreThere) {
  Json j = loose(box);
  j["porosity"] = 0.3;
  j["overlap_tolerance"] = 0.5;
  j["max_iterations"] = 300;
  TestHost host;
  const PackedParticles p = pack(j, host);
  const Overlaps o = overlaps(p);
  EXPECT_GT(o.largest, 0.02);  // 70 % solid is beyond random close packing
  EXPECT_NEAR(got(p, "max_overlap"), o.largest, 1e-12);
  EXPECT_NEAR(got(p, "mean_overlap") * got(p, "contacts_per_particle") * 0.5 * double(p.radius.size()), o.sum,
              1e-9 * o.sum);
}

TEST(Rearrangement, TooDenseIsRefusedWithTheWayOut) {
  Json j = loose(box);
  j["porosity"] = 0.25;
  j["max_iterations"] = 100;
  TestHost host;
  const std::string text = user_error([&] { pack(j, host); });
  EXPECT_NE(text.find("cannot be packed so densely"), std::string::npos) << text;
  EXPECT_NE(text.find("overlap_tolerance"), std::string::npos) << text;
  j["porosity"] = 0.03;
  const std::string full = user_error([&] { pack(j, host); });
  EXPECT_NE(full.find("0.97 of the volume to be filled"), std::string::npos) << full;
}

TEST(Rearrangement, DrawingNeighboursTogetherNarrowsTheNearestGaps) {
  // Root mean square of d/s - 1 over the nearest four pairs per sphere.
  const auto spread = [](const PackedParticles& p) {
    std::vector<double> gap;
    for (std::size_t i = 0; i < p.radius.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        gap.push_back((p.position[i] - p.position[j]).norm() / (p.radius[i] + p.radius[j]) - 1);
    const std::size_t n = 4 * p.radius.size();
    std::nth_element(gap.begin(), gap.begin() + std::ptrdiff_t(n), gap.end());
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += gap[k] * gap[k];
    return std::sqrt(sum / double(n));
  };
  Json j = loose(box);
  j["porosity"] = 0.36;
  j["overlap_tolerance"] = 0.5;
  TestHost host;
  const double before = spread(pack(j, host));
  j["neighbours_per_particle"] = 8.0;
  TestHost another;
  EXPECT_LT(spread(pack(j, another)), 0.9 * before);
  EXPECT_TRUE(another.never_back);
}

TEST(Rearrangement, AMarginLeavesFlatEndsTouchedAndNoGapAlongTheSide) {
  Json j = loose(cylinder);
  TestHost host;
  const PackedParticles plain = pack(j, host);
  j["margin"] = 2e-3;
  const PackedParticles cut = pack(j, host);
  EXPECT_EQ(cut.radius.size(), plain.radius.size());
  EXPECT_NEAR(got(cut, "porosity"), 0.45, 0.01);
  EXPECT_LE(overlaps(cut).largest, 1e-3);
  // Ends: as without a margin, whole spheres, some of which touch. Side: only the centres are inside.
  double low = 1, high = 1, sides = -1, plain_sides = -1, outer[2] = {0, 0};
  for (std::size_t i = 0; i < cut.radius.size(); ++i) {
    const double r = cut.radius[i];
    low = std::min(low, (cut.position[i].z() - r) / r);
    high = std::min(high, (0.008 - cut.position[i].z() - r) / r);
    const double rho = std::hypot(cut.position[i].x(), cut.position[i].y());
    ASSERT_LE(rho, 0.005);
    sides = std::max(sides, rho);
    outer[0] += rho > 0.0047;
  }
  EXPECT_NEAR(low, 0, 1e-3);
  EXPECT_NEAR(high, 0, 1e-3);
  for (std::size_t i = 0; i < plain.radius.size(); ++i) {
    const double rho = std::hypot(plain.position[i].x(), plain.position[i].y());
    plain_sides = std::max(plain_sides, rho);
    outer[1] += rho > 0.0047;
  }
  // No centre of an uncut packing comes nearer to the wall than the smallest radius; cut, the outermost 0.3 mm hold
  // their share of the cross-section, 11.6 %, give or take four standard deviations of a random number.
  EXPECT_EQ(outer[1], 0);
  EXPECT_LT(plain_sides, 0.0047 + 1e-9);
  const double share = (25 - 4.7 * 4.7) / 25 * double(cut.radius.size());
  EXPECT_NEAR(outer[0], share, 4 * std::sqrt(share));
}

TEST(Rearrangement, AMarginWithoutFlatEndsCutsThemToo) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    Json j = loose(c.container);
    j["margin"] = 1e-3;
    j["flat_ends"] = false;
    TestHost host;
    const PackedParticles p = pack(j, host, 1, c.dimension);
    double centre = -1, whole = -1;
    for (std::size_t i = 0; i < p.radius.size(); ++i) {
      // A point in the place of the sphere: its own reach is what the sphere's lacks.
      const double out = out_of(c.container, p.position[i], p.radius[i], c.dimension);
      centre = std::max(centre, out - 1);
      whole = std::max(whole, out);
    }
    EXPECT_LE(centre, 1e-9);
    EXPECT_GT(whole, 0.5);
    EXPECT_NEAR(got(p, "porosity"), 0.45, 0.04);
  }
}

TEST(Rearrangement, FewAndUnevenSpheresWork) {
  TestHost host;
  Json j = loose(box);
  j.erase("porosity");
  for (const int n : {1, 2, 3}) {
    j["particles"] = n;
    for (const int dimension : {2, 3}) EXPECT_EQ(pack(j, host, 1, dimension).radius.size(), std::size_t(n));
  }
  // One that fills the container; a few large ones among many of a tenth of their size.
  j["container"] = ball;
  j["particles"] = 1;
  j["radius"] = {{"distribution", "normal"}, {"mean", 0.00525}, {"standard_deviation", 0.0}};
  EXPECT_NEAR((pack(j, host).position[0] - Vec3(0, 0, 0.00525)).norm(), 0, 1e-12);
  j["particles"] = 450;
  j["radius"] = {{"distribution", "sieves"},
                 {"sieves",
                  {{{"size", 0.5e-3}, {"passing", 0.0}},
                   {{"size", 1e-3}, {"passing", 0.3}},
                   {{"size", 4e-3}, {"passing", 0.3}},
                   {{"size", 5e-3}, {"passing", 1.0}}}}};
  const PackedParticles uneven = pack(j, host);
  EXPECT_GT(uneven.radius.front(), 8 * uneven.radius.back());  // the largest come first
  EXPECT_LE(overlaps(uneven).largest, 1e-3);
}

TEST(Rearrangement, StopsWhenCancelled) {
  TestHost host;
  host.cancel_after = 2;
  EXPECT_THROW(pack(loose(box), host), Cancelled);
  EXPECT_LE(host.calls, 3);
}

TEST(Rearrangement, MistakesAreNamed) {
  const auto findings = [](const Json& j) {
    std::string text;
    for (const Issue& i : test::issues_of(plugin, j)) text += i.path + ": " + i.text + "\n";
    return text;
  };
  EXPECT_EQ(findings(loose(ball)), "");
  Json j = loose(ball);
  j["container"]["diameter"] = 1e-3;
  EXPECT_NE(findings(j).find("radius: the largest radius does not fit"), std::string::npos) << findings(j);
  j["container"]["height"] = 1e-3;
  EXPECT_NE(findings(j).find("container: a sphere is given by diameter"), std::string::npos) << findings(j);
  TestHost host;
  j = loose(cylinder);
  EXPECT_NE(user_error([&] { pack(j, host, 1, 2); }).find("two dimensions"), std::string::npos);
  j["radius"] = {{"distribution", "uniform"}, {"min", 1e-6}, {"max", 2e-6}};
  EXPECT_NE(user_error([&] { pack(j, host); }).find("use larger radii"), std::string::npos);
}

}  // namespace
}  // namespace breccia
