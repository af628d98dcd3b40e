// SPDX-License-Identifier: BSD-3-Clause
// Bonds that a protocol protects: whatever they carry they hold, and their neighbours break as always.
#include <gtest/gtest.h>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

struct Case {
  std::string law;
  Json config;
  double limit;  ///< strain at which a bond breaks in pure tension
};

const Case cases[] = {{"elastic_brittle", elastic_brittle(), 40e6 / 10e9},
                      {"nonlinear_tension", nonlinear_tension(), 4e-3},
                      {"elasto_damage_plastic",
                       {{"youngs_modulus", 10e9},
                        {"poisson_ratio", 0.2},
                        {"area_factor", 1.0},
                        {"contact_damping", 0.5},
                        {"tensile_strength", 10e6},
                        {"shear_strength", 10e6},
                        {"internal_friction", 0.5},
                        {"friction", 0.3},
                        {"softening_tension", 1.0},
                        {"softening_shear", 1.0},
                        {"failure", "coupled"}},
                       2e-3}};

class Protection : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Laws, Protection, ::testing::ValuesIn(cases), [](const auto& c) { return c.param.law; });

/// A chain of four spheres pulled apart by its ends to three times the limit, or sheared to sixty times.
TEST_P(Protection, HoldsInTensionAndShear) {
  const Case& c = GetParam();
  for (const bool shear : {false, true}) {
    const double r = 1e-3;
    // Two chains side by side that do not touch: one protected, one not.
    PackedParticles p = simple_cubic(1, 1, 4, r), other = p;
    for (Vec3& x : other.position) x.x() += 10 * r;
    p.position.insert(p.position.end(), other.position.begin(), other.position.end());
    p.radius.insert(p.radius.end(), other.radius.begin(), other.radius.end());
    EngineSettings settings;
    settings.damping = {0.3, 0.3};
    Bench b = make_bench(p, c.config, 1e-9, settings, 3, c.law);
    const auto& s = b->state();
    ASSERT_EQ(s.bonds.size(), 6u);
    const auto right = [&](Index k) { return s.particles.position()[k].x() > 5 * r; };
    std::vector<Index> protect;
    for (Index k = 0; k < 6; ++k)
      if (right(s.bonds.i[k])) protect.push_back(k);
    b->protect_bonds(protect);
    b->prepare();
    const int steps = 20000;
    const double way = (shear ? 60 : 3) * c.limit * 6 * r;
    const Vec3 velocity = way / (steps * b->time_step()) * (shear ? Vec3::UnitY() : Vec3::UnitZ());
    for (Index k = 0; k < s.particles.size(); ++k) {
      if (s.particles.position()[k].z() < 2 * r) b->hold(k, dof::all, Vec3::Zero(), Vec3::Zero());
      if (s.particles.position()[k].z() > 6 * r) b->hold(k, dof::all, velocity, Vec3::Zero());
    }
    b.steps(steps);
    int broken = 0;
    for (Index k = 0; k < 6; ++k) {
      if (!right(s.bonds.i[k])) broken += is_broken(s.bonds.state[k]);
      else EXPECT_EQ(s.bonds.state[k], BondState::intact) << shear;
    }
    EXPECT_GE(broken, 1) << "the chain without protection must fail, or nothing was tested " << shear;
    for (std::size_t k = 0; k < s.pairs.size(); ++k) {
      if (!right(s.pairs.i[k]) || s.pairs.state[k] != BondState::intact) continue;
      const PairForce& f = s.pairs.force[k];
      const double area = 4 * r * r;
      EXPECT_GT(Vec3(f.fx, f.fy, f.fz).norm(), 0.5e6 * area) << "it carries its load";
    }
  }
}

/// A law from outside that knows nothing of protection.
struct Unaware {
  struct Config {};
  static void describe(Schema<Config>& s) { s.summary("breaks when it likes"); }
  struct State {};
  static constexpr std::array<StateColumn<State>, 0> columns{};
  Unaware(const Config&, const Assembly&) {}
  BRECCIA_KERNEL State initial(const Contact&) const { return {}; }
  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State&) const {
    ContactForce f;
    f.normal = 1e6 * (c.distance - c.rest_length);
    return f;
  }
  BRECCIA_KERNEL double energy(const Contact&, const State&) const { return 0; }
  BRECCIA_KERNEL ContactStiffness stiffness(const Contact&) const { return {1e6, 0}; }
};

TEST(ProtectionRefused, WithALawThatDoesNotKnowIt) {
  ContactLawOf<Unaware> law(Unaware::Config{});
  Simulation simulation(assemble(simple_cubic(1, 1, 2, 1e-3), {2650}, 3, 1.0), law, {});
  simulation.bond({GapMeasure::relative, 1e-9, std::nullopt});
  const Index first = 0;
  simulation.protect_bonds({});  // none: nothing to support
  EXPECT_THROW(simulation.protect_bonds({&first, 1}), UserError);
}

}  // namespace
}  // namespace breccia::testing
