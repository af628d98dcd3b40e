// SPDX-License-Identifier: BSD-3-Clause
/// Specimen 1 of Rojek et al. (2012), Int. J. Solids Struct. 49, 1497-1517, which was packed with this method: the
/// statistics of its bonds (section 5.1 and Table A.1) must come out of the radii, number and porosity alone.
#include <gtest/gtest.h>

#include <cmath>

#include "neighbours.hpp"
#include "support.hpp"

namespace breccia::labra_onate {
namespace {

constexpr std::size_t bonds = 60809;

struct Packed {
  PackedParticles particles;
  NeighbourSet set;  // the 60809 closest pairs: its bonds
};

const Packed& specimen() {
  static const Packed packed = [] {
    const Json config = {{"container", {{"shape", "cylinder"}, {"diameter", 0.023}, {"height", 0.046}}},
                         {"particles", 10225},
                         {"porosity", 0.23},
                         {"radius",
                          {{"distribution", "normal"},
                           {"mean", 0.6759350e-3},
                           {"standard_deviation", 0.1346085e-3},
                           {"min", 0.3122622e-3},
                           {"max", 1.1861220e-3}}},
                         {"neighbours_per_particle", 2.0 * bonds / 10225},
                         {"max_iterations", 200},
                         {"tolerance", 1e-4}};
    TestHost host(2);
    Packed p{pack(config, host), {}};
    const Container box = Container::cylinder(0.023, 0.046);
    p.set = NeighbourFinder(box, 1).find({p.particles.position, p.particles.radius}, bonds);
    return p;
  }();
  return packed;
}

template <class F>
double bond_mean(F&& f) {
  const Packed& p = specimen();
  double sum = 0;
  for (std::size_t i = 0; i < p.particles.radius.size(); ++i)
    for (const Index j : p.set.row(i))
      if (j > i) sum += f(i, j);
  return sum / double(p.set.pairs());
}

TEST(Specimen1, NumberPorosityAndRadii) {
  const PackedParticles& p = specimen().particles;
  EXPECT_EQ(p.radius.size(), 10225u);
  EXPECT_NEAR(got(p, "porosity"), 0.23, 1e-9);
  // The radii of Table A.1 give 22.4 %, and the text says 23 %: the factor makes good a quarter of a percent.
  EXPECT_NEAR(got(p, "radius_factor"), 1, 4e-3);
  EXPECT_NEAR(got(p, "radius_mean"), 0.6759350e-3, 4e-3 * 0.6759350e-3);
  EXPECT_NEAR(got(p, "radius_standard_deviation"), 0.1346085e-3, 4e-3 * 0.1346085e-3);
}

TEST(Specimen1, BondsNeedATightTolerance) {
  ASSERT_EQ(specimen().set.pairs(), bonds);
  EXPECT_LT(specimen().set.tolerance, 0.20);  // plain random packings with overlap need 0.2 to 0.3
}

TEST(Specimen1, PairRadiiOfTableA1) {
  const std::vector<double>& r = specimen().particles.radius;
  EXPECT_NEAR(bond_mean([&](auto i, auto j) { return (r[i] + r[j]) / 2; }), 0.7032214e-3, 0.01 * 0.70e-3);
  EXPECT_NEAR(bond_mean([&](auto i, auto j) { return 2 * r[i] * r[j] / (r[i] + r[j]); }), 0.6909727e-3, 0.01 * 0.69e-3);
  EXPECT_NEAR(bond_mean([&](auto i, auto j) { return std::min(r[i], r[j]); }), 0.6291815e-3, 0.01 * 0.63e-3);
}

TEST(Specimen1, FabricIsAlmostIsotropic) {
  const auto& x = specimen().particles.position;
  const double published[3] = {0.33168, 0.33142, 0.33689};
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(bond_mean([&](auto i, auto j) { return std::pow((x[i] - x[j]).normalized()[k], 2); }), published[k],
                0.004);
}

TEST(Specimen1, PlatensTouchManySpheres) {
  // End face over the cross-section of a mean sphere: 290.
  EXPECT_GT(got(specimen().particles, "particles_on_lower_end"), 150);
  EXPECT_GT(got(specimen().particles, "particles_on_upper_end"), 150);
}

}  // namespace
}  // namespace breccia::labra_onate
