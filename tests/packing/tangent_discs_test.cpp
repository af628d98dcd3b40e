// SPDX-License-Identifier: BSD-3-Clause
/// Discs that touch exactly: what the packing promises, looked at by loops of the tests' own, and the specimens of
/// Ouyang et al. (2017), Tables 1 and 4.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "host.hpp"
#include "plugin_under_test.hpp"

namespace breccia {
namespace {

using test::user_error;
constexpr const char* plugin = BRECCIA_TANGENT_DISCS_PLUGIN;
constexpr double exact = 1e-12;  // over the sum of the radii

PackedParticles pack(const Json& config, Host& host, std::uint64_t seed = 1, int dimension = 2) {
  return generate(*test::make<Packing>(plugin, config), {{dimension, 0.5}, seed}, host);
}
PackedParticles pack(const Json& config, std::uint64_t seed = 1) {
  TestHost host;
  return pack(config, host, seed);
}

Json rectangle(double width, double height, double min = 0.3e-3, double max = 0.9e-3) {
  return {{"container", {{"shape", "box"}, {"size", {width, height}}}}, {"radius_min", min}, {"radius_max", max}};
}
Json round(double diameter, double min = 0.3e-3, double max = 0.9e-3) {
  return {{"container", {{"shape", "sphere"}, {"diameter", diameter}}}, {"radius_min", min}, {"radius_max", max}};
}

/// Distances of a point from the walls of a container of the tests.
std::vector<double> walls(const Json& container, const Vec3& x) {
  if (container["shape"] == "sphere") {
    const double radius = 0.5 * container["diameter"].get<double>();
    return {radius - std::hypot(x.x(), x.y() - radius)};
  }
  const auto size = container["size"].get<std::vector<double>>();
  return {0.5 * size[0] + x.x(), 0.5 * size[0] - x.x(), x.y(), size[1] - x.y()};
}

struct Found {
  std::size_t tangent = 0, bonds = 0, at_walls = 0;  // pairs within 1e-12 and within 1e-3
  double overlap = -1, out = -1, mean = 0, solid = 0;
  double xx = 0, xy = 0;  // fabric: means over the bonds of n_x n_x, n_x n_y
  double coordination = 0;
  std::vector<int> touching;  // of each disc, walls included
};

Found look(const PackedParticles& p, const Json& config) {
  Found f;
  const std::size_t n = p.radius.size();
  f.touching.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    f.mean += p.radius[i] / double(n);
    f.solid += std::numbers::pi * p.radius[i] * p.radius[i];
    for (const double d : walls(config["container"], p.position[i])) {
      f.out = std::max(f.out, 1 - d / p.radius[i]);
      const bool touches = std::abs(d / p.radius[i] - 1) <= exact;
      f.at_walls += touches;
      f.touching[i] += touches;
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 way = p.position[i] - p.position[j];
      const double s = p.radius[i] + p.radius[j], square = way.squaredNorm();
      if (square > s * s * 1.003) continue;
      const double gap = std::sqrt(square) / s - 1;
      f.overlap = std::max(f.overlap, -gap);
      if (gap <= exact) {
        ++f.tangent;
        ++f.touching[i];
        ++f.touching[j];
      }
      if (gap > 1e-3) continue;
      ++f.bonds;
      f.xx += way.x() * way.x() / square;
      f.xy += way.x() * way.y() / square;
    }
  }
  f.xx /= double(f.bonds);
  f.xy /= double(f.bonds);
  f.coordination = 2 * double(f.bonds) / double(n);
  return f;
}

/// A disc of radius r that fits nowhere, wherever two neighbours would hold it: then it fits nowhere at all.
bool has_room(const PackedParticles& p, const Json& config, double r) {
  const auto free = [&](const Vec3& x) {
    for (const double d : walls(config["container"], x))
      if (d < r * (1 - 1e-9)) return false;
    for (std::size_t k = 0; k < p.radius.size(); ++k)
      if ((x - p.position[k]).norm() < (p.radius[k] + r) * (1 - 1e-9)) return false;
    return true;
  };
  for (std::size_t i = 0; i < p.radius.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 way = p.position[j] - p.position[i];
      const double a = p.radius[i] + r, b = p.radius[j] + r, d = way.norm(), along = (a * a - b * b + d * d) / (2 * d);
      if (d > a + b || along * along > a * a) continue;
      const double h = std::sqrt(a * a - along * along);
      const Vec3 u = way / d, across(-u.y(), u.x(), 0);
      if (free(p.position[i] + along * u + h * across) || free(p.position[i] + along * u - h * across)) return true;
    }
  return false;
}

struct Case {
  const char* name;
  Json config;
  double measure;  // [m2]: by hand
};
const Case cases[] = {
    {"rectangle", rectangle(0.02, 0.03), 6e-4},
    {"disc", round(0.025), std::numbers::pi / 4 * 6.25e-4},
    {"radii of ratio 10", rectangle(0.02, 0.015, 0.1e-3, 1e-3), 3e-4},
    {"disc, radii of ratio 1.5", round(0.03, 0.6e-3, 0.9e-3), std::numbers::pi / 4 * 9e-4},
    {"equal radii", rectangle(0.02, 0.02, 0.5e-3, 0.5e-3), 4e-4},
    {"narrow", rectangle(0.0025, 0.03), 7.5e-5},
};

TEST(TangentDiscs, TouchExactlyOverlapNowhereAndStayInside) {
  for (const Case& c : cases)
    for (const std::uint64_t seed : {1, 2, 3}) {
      SCOPED_TRACE(c.name);
      const double min = c.config["radius_min"], max = c.config["radius_max"];
      TestHost host;
      const PackedParticles p = pack(c.config, host, seed);
      const Found f = look(p, c.config);
      ASSERT_GT(p.radius.size(), 25u);
      EXPECT_LT(f.overlap, exact);
      EXPECT_LT(f.out, exact);
      for (std::size_t i = 0; i < p.radius.size(); ++i) {
        ASSERT_EQ(p.position[i].z(), 0);
        ASSERT_GE(p.radius[i], min);
        ASSERT_LE(p.radius[i], max);
        ASSERT_GE(f.touching[i], 2) << "disc " << i;
      }
      EXPECT_EQ(got(p, "particles"), double(p.radius.size()));
      EXPECT_NEAR(got(p, "porosity"), 1 - f.solid / c.measure, 1e-12);
      EXPECT_NEAR(got(p, "radius_mean"), f.mean, 1e-15);
      EXPECT_LT(got(p, "max_overlap"), exact);  // of the pairs made to touch
      EXPECT_LT(got(p, "max_gap"), exact);
      EXPECT_GT(got(p, "max_gap") + got(p, "max_overlap"), 0);
      // Pairs may touch by chance as well: equal discs on a lattice do.
      EXPECT_GE(double(f.tangent), got(p, "tangent_pairs"));
      EXPECT_EQ(double(f.bonds), got(p, "tangent_pairs") + got(p, "nearly_tangent_pairs"));
      EXPECT_GE(double(f.at_walls), got(p, "tangencies_with_walls"));
      EXPECT_NEAR(got(p, "coordination_number"), 2 * got(p, "tangent_pairs") / double(p.radius.size()), 1e-12);
      EXPECT_NEAR(p.container_volume, 0.5 * c.measure, 1e-12 * c.measure);
      EXPECT_TRUE(host.never_back);
      EXPECT_EQ(host.last, 1);
    }
}

/// Some of so many triples of curves have discs that the closed form alone misses by more: all end at rounding.
TEST(TangentDiscs, RareTriplesTouchAsExactly) {
  double gap = 0, overlap = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const PackedParticles p = pack(round(0.025), seed);
    gap = std::max(gap, got(p, "max_gap"));
    overlap = std::max(overlap, got(p, "max_overlap"));
  }
  EXPECT_LT(gap, 5e-14);
  EXPECT_LT(overlap, 5e-14);
}

TEST(TangentDiscs, NoPlaceIsLeftForTheSmallestDisc) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const double min = c.config["radius_min"];
    PackedParticles p = pack(c.config);
    EXPECT_FALSE(has_room(p, c.config, min));
    p.position.erase(p.position.begin() + std::ptrdiff_t(p.radius.size() / 2));  // the search does find room
    p.radius.erase(p.radius.begin() + std::ptrdiff_t(p.radius.size() / 2));
    EXPECT_TRUE(has_room(p, c.config, min));
  }
}

/// Ouyang et al. (2017). Their squares have 1960 to 2031 discs of mean radius 0.544 to 0.564 mm, 2003 and 0.557 mm on
/// average, at 13.65 to 14.02 %.
struct Specimen {
  const char* name;
  Json config;
  double area, discs, mean, bonds;
};
const Specimen specimens[] = {
    {"Table 1", rectangle(0.05, 0.05), 0.05 * 0.05, 2003.2, 0.5568e-3, 5027.2},
    {"Table 4, granite", rectangle(0.063, 0.1575), 0.063 * 0.1575, 7892, 0.562e-3, 20071},
    {"Table 4, quartzite", rectangle(0.031, 0.078, 0.2e-3, 0.6e-3), 0.031 * 0.078, 4365, 0.373e-3, 11021},
};

TEST(TangentDiscs, SpecimensOfOuyangAndOthersAreAsPublished) {
  for (const Specimen& s : specimens)
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      SCOPED_TRACE(std::string(s.name) + ", seed " + std::to_string(seed));
      const PackedParticles p = pack(s.config, seed);
      const Found f = look(p, s.config);
      EXPECT_NEAR(double(p.radius.size()), s.discs, 0.05 * s.discs);
      EXPECT_NEAR(double(f.bonds), s.bonds, 0.05 * s.bonds);
      EXPECT_NEAR(f.mean, s.mean, 0.03 * s.mean);
      EXPECT_GT(1 - f.solid / s.area, 0.130);
      EXPECT_LT(1 - f.solid / s.area, 0.145);
      EXPECT_NEAR(f.coordination, 5.0, 0.15);
      EXPECT_LT(f.overlap, exact);
      EXPECT_LT(f.out, exact);
      // Bonds that are not by construction: about one in 5000.
      EXPECT_LT(double(f.bonds - f.tangent), 2e-3 * double(f.bonds));
    }
}

TEST(TangentDiscs, BondsPointEverywhere) {
  // For n independent directions n_x n_x has a standard deviation of 1/sqrt(8 n): 0.0022 for five squares.
  const Json square = rectangle(0.05, 0.05);
  double xx = 0, xy = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Found f = look(pack(square, seed), square);
    xx += f.xx / 5;
    xy += f.xy / 5;
  }
  EXPECT_NEAR(xx, 0.5, 0.004);
  EXPECT_NEAR(xy, 0.0, 0.004);
}

TEST(TangentDiscs, WallsAreLinedWithoutHoles) {
  for (const Case& c : {cases[0], cases[1]}) {
    SCOPED_TRACE(c.name);
    const PackedParticles p = pack(c.config);
    const double outline = c.config["container"]["shape"] == "sphere" ? std::numbers::pi * 0.025 : 0.1;
    EXPECT_GT(got(p, "tangencies_with_walls"), outline / (2 * 0.9e-3));
    std::vector<double> along;  // the discs on the lower wall, or round the wall in radians
    const double radius = 0.0125;
    const bool disc = c.config["container"]["shape"] == "sphere";
    for (std::size_t i = 0; i < p.radius.size(); ++i) {
      const Vec3& x = p.position[i];
      const double d = disc ? radius - std::hypot(x.x(), x.y() - radius) : x.y();
      if (std::abs(d / p.radius[i] - 1) < exact)
        along.push_back(disc ? radius * std::atan2(x.y() - radius, x.x()) : x.x());
    }
    std::sort(along.begin(), along.end());
    for (std::size_t k = 1; k < along.size(); ++k) EXPECT_LT(along[k] - along[k - 1], 2.2 * 0.9e-3);
  }
}

TEST(TangentDiscs, SameBitsForASeedOtherDiscsForAnother) {
  for (const Case& c : {cases[0], cases[1]}) {
    TestHost one(1), three(3);
    const PackedParticles a = pack(c.config, one, 7);
    EXPECT_TRUE(same_bits(a, pack(c.config, three, 7)));
    EXPECT_FALSE(same_bits(a, pack(c.config, one, 8)));
  }
}

TEST(TangentDiscs, LengthsScale) {
  const PackedParticles small = pack(rectangle(0.02, 0.03)), large = pack(rectangle(20, 30, 0.3, 0.9));
  ASSERT_EQ(small.radius.size(), large.radius.size());
  for (std::size_t i = 0; i < small.radius.size(); ++i) ASSERT_NEAR(1e3 * small.radius[i], large.radius[i], 1e-6);
}

TEST(TangentDiscs, AsManyAsOneFit) {
  EXPECT_EQ(pack(round(0.0018, 0.9e-3, 0.9e-3)).radius.size(), 1u);
  EXPECT_EQ(pack(rectangle(0.0018, 0.0018, 0.9e-3, 0.9e-3)).radius.size(), 1u);
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    for (const Json& config : {round(0.0019), rectangle(0.0018, 0.0018), rectangle(0.0018, 0.005)}) {
      const PackedParticles p = pack(config, seed);
      const Found f = look(p, config);
      ASSERT_GE(p.radius.size(), 1u);
      EXPECT_LT(f.overlap, exact);
      EXPECT_LT(f.out, exact);
    }
  }
}

/// Outline, axis and places are those of the other packings.
TEST(TangentDiscs, TheSpecimenIsDescribed) {
  const PackedParticles box = pack(rectangle(0.02, 0.03)), disc = pack(round(0.025));
  EXPECT_EQ(box.outline, SpecimenShape::Outline::box);
  EXPECT_EQ(disc.outline, SpecimenShape::Outline::ellipsoid);
  EXPECT_EQ(box.axis, Vec3(Vec3::UnitY()));
  EXPECT_EQ(disc.axis, Vec3(Vec3::UnitY()));
}

TEST(TangentDiscs, TwoThousandTakeLessThanFiveSeconds) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_GT(pack(rectangle(0.05, 0.05)).radius.size(), 1900u);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5);
}

TEST(TangentDiscs, StopsWhenCancelled) {
  TestHost host;
  host.cancel_after = 1;
  EXPECT_THROW(pack(rectangle(0.05, 0.05), host), Cancelled);
  EXPECT_LE(host.calls, 2);
}

TEST(TangentDiscs, MistakesAreNamed) {
  const auto findings = [](const Json& j) {
    std::string text;
    for (const Issue& i : test::issues_of(plugin, j)) text += i.path + ": " + i.text + "\n";
    return text;
  };
  EXPECT_EQ(findings(rectangle(0.05, 0.05)), "");
  EXPECT_EQ(findings(rectangle(0.05, 0.05, 0.9e-3, 0.3e-3)), "radius_max: is below radius_min\n");
  EXPECT_EQ(findings(rectangle(0.05, 0.001)), "radius_max: the largest disc does not fit into the container\n");
  EXPECT_EQ(findings(round(0.0017)), "radius_max: the largest disc does not fit into the container\n");
  EXPECT_EQ(findings(rectangle(0.05, 5)), "radius_min: is less than 1/10000 of the container: use larger radii\n");
  Json j = rectangle(0.05, 0.05);
  j["container"] = {{"shape", "cylinder"}, {"diameter", 0.05}, {"height", 0.1}};
  EXPECT_NE(findings(j).find("container: a cylinder cannot be packed in two dimensions"), std::string::npos)
      << findings(j);
  TestHost host;
  EXPECT_EQ(user_error([&] { pack(rectangle(0.05, 0.05), host, 1, 3); }), "it makes discs: it needs `dimension: 2`");
}

}  // namespace
}  // namespace breccia
