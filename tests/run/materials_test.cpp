// SPDX-License-Identifier: BSD-3-Clause
// Several materials, parameters by pair of materials, strengths that scatter.
#include "workflow/materials.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/counter_random.hpp"
#include "support/support.hpp"
#include "workflow/contact_laws.hpp"

namespace breccia::testing {
namespace {

const Registry& plugins() {
  static const Registry registry;
  return registry;
}

Json scattering(const char* shape, double mean, const char* width, double value) {
  return {{"distribution", shape}, {"mean", mean}, {width, value}};
}

struct Specimen {
  Specimen(const PackedParticles& packing, const Json& law, Materials materials, std::uint64_t seed = 1,
           EngineSettings settings = {}, double tolerance = 1e-6)
      : laws(plugins(), PluginStack{{{"elastic_brittle", law}}}, materials.list, seed),
        simulation(assemble(packing, materials, 3, 1.0), laws.interactions(), settings) {
    simulation.bond({GapMeasure::relative, tolerance, std::nullopt});
  }
  void steps(int n) {
    for (int k = 0; k < n; ++k) {
      if (!simulation.forces_known()) simulation.forces();
      simulation.advance();
    }
    simulation.forces();
  }
  Index row_of(Index id) const {
    const auto& all = simulation.state().particles.id;
    return Index(std::find(all.begin(), all.end(), id) - all.begin());
  }
  ContactLaws laws;
  Simulation simulation;
};

TEST(Philox, KnownAnswers) {  // of the Random123 distribution
  EXPECT_EQ(philox({0, 0, 0, 0}, 0, 0), (Counter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, 0xffffffff, 0xffffffff),
            (Counter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0xa4093822, 0x299f31d0),
            (Counter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Distribution, HasTheMeanAndTheDeviationAskedFor) {
  for (const Distribution& d : {Distribution{Distribution::Shape::normal, 40e6, 4e6, 0, {}, {}},
                                Distribution{Distribution::Shape::lognormal, 40e6, 12e6, 0, {}, {}},
                                Distribution{Distribution::Shape::uniform, 40e6, 8e6, 0, {}, {}},
                                Distribution{Distribution::Shape::weibull, 40e6, 0, 8, {}, {}}}) {
    constexpr int n = 200000;
    double sum = 0, square = 0;
    for (int k = 0; k < n; ++k) {
      const double x = d.quantile((k + 0.5) / n);
      sum += x;
      square += x * x;
    }
    const double mean = sum / n, deviation = std::sqrt(square / n - mean * mean);
    const double gamma1 = std::tgamma(1 + 1 / 8.0), gamma2 = std::tgamma(1 + 2 / 8.0);
    const double wanted =
        d.shape == Distribution::Shape::weibull ? 40e6 * std::sqrt(gamma2 / (gamma1 * gamma1) - 1) : d.deviation;
    EXPECT_NEAR(mean, 40e6, 2e-4 * 40e6) << int(d.shape);
    EXPECT_NEAR(deviation, wanted, 2e-3 * wanted) << int(d.shape);
  }
}

TEST(Distribution, IsTruncatedWithoutHeapsAtTheLimits) {
  Distribution d{Distribution::Shape::normal, 40, 10, 0, 30.0, 55.0};
  EXPECT_NEAR(d.quantile(1e-12), 30, 1e-6);
  EXPECT_NEAR(d.quantile(1 - 1e-12), 55, 1e-6);
  int at_limit = 0;
  for (int k = 0; k < 1000; ++k) {
    const double x = d.quantile((k + 0.5) / 1000);
    at_limit += x <= 30.0 || x >= 55.0;
    EXPECT_GE(x, 30);
    EXPECT_LE(x, 55);
  }
  EXPECT_EQ(at_limit, 0);
  EXPECT_NEAR(d.share_within(), 0.5 * (std::erf(1.5 / std::sqrt(2)) + std::erf(1 / std::sqrt(2))), 1e-12);
}

TEST(Materials, ATwoLayerBarHasTheSeriesStiffness) {
  const int n = 10;
  const PackedParticles bar = simple_cubic(1, 1, n, 1e-3);
  Materials two;
  two.list = {{2650, "soft"}, {3000, "hard"}};
  for (int k = 0; k < n; ++k) two.of_particle.push_back(k < n / 2 ? 0 : 1);
  Json law = elastic_brittle({{"tensile_strength", 1e12}, {"shear_strength", 1e12}});
  const auto changed = [&](const char* a, const char* b, double modulus) {
    Json item = law;
    item["bond_modulus"] = modulus;
    item["materials"] = {a, b};
    return item;
  };
  Json with_pairs = law;
  with_pairs["between"] = {changed("hard", "hard", 30e9), changed("hard", "soft", 17e9)};
  EngineSettings settings;
  settings.damping = {0.7, 0.7};
  Specimen s(bar, with_pairs, two, 1, settings);
  s.simulation.prepare();
  EXPECT_EQ(s.simulation.view().particles.mass[s.row_of(0)] * 3000,
            s.simulation.view().particles.mass[s.row_of(9)] * 2650);

  const double u = 1e-7;
  const int pull = 1000;
  s.simulation.hold(s.row_of(0), dof::all, Vec3::Zero(), Vec3::Zero());
  s.simulation.hold(s.row_of(n - 1), dof::all, Vec3(0, 0, u / (pull * s.simulation.time_step())), Vec3::Zero());
  s.steps(pull);
  s.simulation.hold(s.row_of(n - 1), dof::all, Vec3::Zero(), Vec3::Zero());
  s.steps(30000);
  const double stretch = s.simulation.state().particles.position()[s.row_of(n - 1)].z() - bar.position[n - 1].z();
  const auto k = [](double modulus) { return 2 * modulus * 1e-3; };
  const double series = 1 / (4 / k(10e9) + 1 / k(17e9) + 4 / k(30e9));
  EXPECT_NEAR(-s.simulation.state().particles.force()[s.row_of(n - 1)].z() / stretch, series, 1e-9 * series);
}

/// Kolmogorov and Smirnov's largest distance between shares and what they should be.
double distance_from(std::vector<double> x, const std::function<double(double)>& cumulative) {
  std::sort(x.begin(), x.end());
  double most = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double f = cumulative(x[k]);
    most = std::max({most, f - double(k) / double(x.size()), double(k + 1) / double(x.size()) - f});
  }
  return most;
}

/// Chains side by side, far enough apart, pulled until each has broken.
std::vector<double> chain_strengths(int chains, int bonds, std::uint64_t seed) {
  const double r = 1e-3, mean = 40e6, modulus = 6;
  PackedParticles p;
  for (int c = 0; c < chains; ++c)
    for (int k = 0; k <= bonds; ++k) {
      p.position.emplace_back(10 * r * (c % 16), 10 * r * (c / 16), 2 * r * k);
      p.radius.push_back(r);
    }
  p.outline = SpecimenShape::Outline::box;
  EngineSettings settings;
  settings.damping = {0.5, 0.5};
  Specimen s(p,
             elastic_brittle(
                 {{"tensile_strength", scattering("weibull", mean, "modulus", modulus)}, {"shear_strength", 1e12}}),
             Materials(2650), seed, settings);
  s.simulation.prepare();
  const double stiffness = 2 * 10e9 * r, area = 4 * r * r;
  const double speed = 2.5 * mean * area / stiffness * bonds / (15000 * s.simulation.time_step());
  for (int c = 0; c < chains; ++c) {
    s.simulation.hold(s.row_of(Index(c * (bonds + 1))), dof::all, Vec3::Zero(), Vec3::Zero());
    s.simulation.hold(s.row_of(Index(c * (bonds + 1) + bonds)), dof::all, Vec3(0, 0, speed), Vec3::Zero());
  }
  s.steps(15000);
  std::vector<double> strength(std::size_t(chains), -1.0);
  const State& state = s.simulation.state();
  for (std::size_t b = 0; b < state.bonds.size(); ++b) {
    if (state.bonds.crack_of[b] == BondsView::no_crack) continue;
    const double time = state.bonds.cracks[state.bonds.crack_of[b]].time;
    const std::size_t c = state.particles.id[state.bonds.i[b]] / std::size_t(bonds + 1);
    const double at = stiffness * speed * time / bonds / area;
    if (strength[c] < 0 || at < strength[c]) strength[c] = at;
  }
  return strength;
}

TEST(Scatter, ChainsFollowTheWeakestLink) {
  const int chains = 200, bonds = 8;
  const std::vector<double> strength = chain_strengths(chains, bonds, 7);
  EXPECT_GT(*std::min_element(strength.begin(), strength.end()), 0);
  const double scale = 40e6 / std::tgamma(1 + 1 / 6.0);
  const auto weakest = [&](int links) {
    return [=](double x) { return 1 - std::exp(-links * std::pow(x / scale, 6)); };
  };
  const double critical = 1.63 / std::sqrt(double(chains));  // at 1 %
  EXPECT_LT(distance_from(strength, weakest(bonds)), critical);
  EXPECT_GT(distance_from(strength, weakest(1)), critical);  // the test can tell
  EXPECT_GT(distance_from(strength, weakest(3 * bonds)), critical);
}

TEST(Scatter, IsTheSameForAnyThreadsAndAnotherSeedIsAnother) {
  const PackedParticles block = random_block(7, 7, 7, 1e-3, 3);
  const auto end = [&](std::uint64_t seed, int threads, const Json& strength) {
    EngineSettings settings;
    settings.threads = threads;
    Specimen s(block, elastic_brittle({{"tensile_strength", strength}, {"shear_strength", 0.5e6}}), Materials(2650),
               seed, settings, 0.1);
    s.simulation.prepare();
    for (Index k = 0; k < 49; ++k) s.simulation.hold(s.row_of(k), dof::all, Vec3(0, 0, -1.5), Vec3::Zero());
    s.steps(300);
    EXPECT_GT(s.simulation.broken_bonds(), 20u);
    const auto position = s.simulation.state().particles.position();
    return std::vector<Vec3>(position.begin(), position.end());
  };
  const Json weibull = scattering("weibull", 2e6, "modulus", 3);
  const auto one = end(1, 1, weibull);
  for (const int threads : {2, 3, 8}) EXPECT_TRUE(one == end(1, threads, weibull)) << threads;
  EXPECT_FALSE(one == end(2, 1, weibull));
  EXPECT_FALSE(one == end(1, 1, 2e6));
}

TEST(Materials, OneGivenTwiceUnderTwoNamesGivesTheBitsOfOne) {
  const PackedParticles block = random_block(7, 7, 7, 1e-3, 3);
  const Json law = elastic_brittle({{"tensile_strength", 2e6}, {"shear_strength", 1e6}});
  const auto end = [&](const Materials& materials, const Json& config) {
    Specimen s(block, config, materials, 1, {}, 0.1);
    s.simulation.prepare();
    for (Index k = 0; k < 49; ++k) s.simulation.hold(s.row_of(k), dof::all, Vec3(0, 0, -0.6), Vec3::Zero());
    s.steps(300);
    EXPECT_GT(s.simulation.broken_bonds(), 20u);
    const auto position = s.simulation.state().particles.position();
    return std::vector<Vec3>(position.begin(), position.end());
  };
  Materials two;
  two.list = {{2650, "a"}, {2650, "b"}};
  for (std::size_t k = 0; k < block.radius.size(); ++k) two.of_particle.push_back(std::uint8_t(k * k % 3 == 1));
  Json pairs = law, item = law;
  item["materials"] = {"b", "a"};
  pairs["between"] = {item};
  const auto one = end(Materials(2650), law);
  EXPECT_TRUE(one == end(two, law));
  EXPECT_TRUE(one == end(two, pairs));
  item["tensile_strength"] = 1e6;
  pairs["between"] = {item};
  EXPECT_FALSE(one == end(two, pairs));
}

double share_of(const std::vector<std::uint8_t>& of, const PackedParticles& p, std::uint8_t material) {
  double all = 0, own = 0;
  for (std::size_t k = 0; k < of.size(); ++k) {
    const double v = std::pow(p.radius[k], 3);
    all += v;
    own += of[k] == material ? v : 0;
  }
  return own / all;
}

TEST(Assignment, SharesAreOfTheSolidVolume) {
  const PackedParticles p = random_block(12, 12, 12, 1e-3, 5);
  const std::vector<Material> list = {{2650, "quartz"}, {2560, "feldspar"}, {3000, "mica"}};
  MaterialOfConfig way;
  way.shares.emplace();
  way.shares->assign({{"feldspar", 0.6}, {"mica", 0.1}, {"quartz", 0.3}});
  const auto of = assign_materials(way, list, p, {}, 1);
  EXPECT_NEAR(share_of(of, p, 0), 0.3, 2e-3);
  EXPECT_NEAR(share_of(of, p, 1), 0.6, 2e-3);
  EXPECT_NEAR(share_of(of, p, 2), 0.1, 2e-3);
  EXPECT_NE(of, assign_materials(way, list, p, {}, 2));
  // Neighbours know nothing of each other: equal ones as often as chance has it.
  std::size_t same = 0, all = 0;
  for (std::size_t k = 1; k < of.size(); ++k, ++all) same += of[k] == of[k - 1];
  EXPECT_NEAR(double(same) / double(all), 0.46, 0.05);
}

TEST(Assignment, GrainsAreCellsOfOneMaterial) {
  const PackedParticles p = simple_cubic(20, 20, 20, 0.5e-3);
  const std::vector<Material> list = {{2650, "quartz"}, {2560, "feldspar"}};
  MaterialOfConfig way;
  way.grains.emplace();
  way.grains->size = 5e-3;
  way.grains->shares.assign({{"quartz", 0.4}, {"feldspar", 0.6}});
  const auto of = assign_materials(way, list, p, {}, 1);
  EXPECT_NEAR(share_of(of, p, 0), 0.4, 0.03);  // by whole grains
  std::size_t same = 0, all = 0;
  for (std::size_t k = 1; k < of.size(); ++k)
    if (k % 20) same += of[k] == of[k - 1], ++all;
  EXPECT_GT(double(same) / double(all), 0.8);  // a grain is five particles wide
}

TEST(Assignment, BySizeRegionLayerAndColumn) {
  PackedParticles p = simple_cubic(1, 1, 10, 0.5e-3);  // centres at z = 0.5, 1.5, ... 9.5 mm
  const std::vector<Material> list = {{2650, "a"}, {2560, "b"}};
  using Numbers = std::vector<std::uint8_t>;
  MaterialOfConfig layers;
  layers.layers = LayersConfig{{"b", "a"}, {2e-3, 1e-3}, 0, 0, Vec3(0, 0, -1e-3)};
  EXPECT_EQ(assign_materials(layers, list, p, {}, 1), (Numbers{1, 0, 1, 1, 0, 1, 1, 0, 1, 1}));
  MaterialOfConfig regions;
  regions.elsewhere = "a";
  RegionConfig ball, half, rod;
  ball.material = half.material = "b";
  ball.sphere = SphereConfig{Vec3(0.5e-3, 0.5e-3, 2.5e-3), 1.1e-3};
  half.half_space = HalfSpaceConfig{Vec3(0, 0, 8e-3), Vec3(0, 0, 3)};
  rod.material = "a";
  rod.cylinder = CylinderConfig{Vec3(0.5e-3, 0.5e-3, 3e-3), Vec3(0.5e-3, 0.5e-3, 9e-3), 0.1e-3};
  regions.regions = {ball, rod, half};
  EXPECT_EQ(assign_materials(regions, list, p, {}, 1), (Numbers{0, 1, 1, 1, 0, 0, 0, 0, 0, 1}));
  for (std::size_t k = 0; k < 10; ++k) p.radius[k] = 0.1e-3 * double(k + 1);
  MaterialOfConfig sizes;
  sizes.sizes = {{"b", 0.35e-3}, {"a", std::nullopt}};
  EXPECT_EQ(assign_materials(sizes, list, p, {}, 1), (Numbers{1, 1, 1, 0, 0, 0, 0, 0, 0, 0}));
  MaterialOfConfig column;
  column.column.emplace();
  column.column->name = "mineral";
  column.column->values.assign({{"a", 4}, {"b", 7}});
  p.columns = {{"mineral", {4, 7, 7, 4, 4, 4, 7, 7, 7, 7}}};
  EXPECT_EQ(assign_materials(column, list, p, {}, 1), (Numbers{0, 1, 1, 0, 0, 0, 1, 1, 1, 1}));
  p.columns[0].second[3] = 5;
  try {
    assign_materials(column, list, p, {}, 1);
    FAIL();
  } catch (const UserError& e) {
    EXPECT_NE(std::string(e.what()).find("none is 5, which column `mineral` has for particle 3"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace breccia::testing
