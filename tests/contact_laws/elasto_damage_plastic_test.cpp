// SPDX-License-Identifier: BSD-3-Clause
// Every branch of the law along paths whose forces are worked out by hand. Spheres of 1 mm that touch: A = pi mm2 and
// d0 = 2 mm, so that 20 GPa gives K_n = 10 pi N/um; nu = 0.25: K_s = 4 pi N/um. Forces below are in units of pi N, work
// in pi uJ, displacements in um.
#include <numbers>

#include "contact_laws/held_pair.hpp"

namespace breccia::testing {
namespace {

constexpr double pi = std::numbers::pi, um = 1e-6;

/// Tension: 5 at 0.5, to zero at 0.6. Shear: 10 at 2.5, to zero at 3. Pressed: bends at 20, 40, 60 (2, 6, 14 um),
/// stiffness 10, then 5, 2.5, 2.
Json config(const Json& changes = Json::object()) {
  Json c = {{"youngs_modulus", 20e9},
            {"poisson_ratio", 0.25},
            {"area_factor", 1.0},
            {"contact_damping", 0.0},
            {"tensile_strength", 5e6},
            {"shear_strength", 10e6},
            {"internal_friction", 0.5},
            {"friction", 0.3},
            {"softening_tension", 0.2},
            {"softening_shear", 0.2},
            {"failure", "uncoupled"},
            {"compressive_limits", {20e6, 40e6, 60e6}},
            {"compressive_slope_ratios", {2, 4, 5}}};
  for (const auto& [key, value] : changes.items()) c[key] = value;
  return c;
}

class Pair : public HeldPair {
 public:
  explicit Pair(const Json& changes = Json::object(), bool bonded = true, double step = 1e9)
      : HeldPair(make_law(config(changes), "elasto_damage_plastic"), bonded, step) {}
  Pair& to(double normal, double shear, int n = 100) {
    lead(normal * um, shear * um, n);
    return *this;
  }
  double pull() const { return normal_force() / pi; }
  double drag() const { return shear_force() / pi; }
};

double micro(double joule) { return joule / (pi * um); }
constexpr double exact = 1e-8;

TEST(ElastoDamagePlastic, TensionSoftensAndUnloadsAlongTheSecant) {
  Pair p;
  EXPECT_NEAR(p.to(0.25, 0).pull(), 2.5, exact);
  EXPECT_NEAR(p.to(0.5, 0).pull(), 5, exact);
  EXPECT_NEAR(p.history("tension_damage"), 0, exact);
  EXPECT_NEAR(p.to(0.54, 0).pull(), 3, exact) << "40 % of the way from 0.5 to 0.6";
  EXPECT_NEAR(p.history("tension_damage"), 0.4, exact);
  EXPECT_EQ(p.history("regime"), 1);
  EXPECT_NEAR(p.to(0.27, 0).pull(), 1.5, exact) << "half-way to the origin";
  EXPECT_EQ(p.history("regime"), 0);
  EXPECT_NEAR(p.to(-0.1, 0).pull(), -1, exact) << "closed: the initial stiffness";
  EXPECT_NEAR(p.to(0.54, 0).pull(), 3, exact) << "back along the secant";
  EXPECT_NEAR(p.history("tension_damage"), 0.4, exact);
  EXPECT_NEAR(p.to(0.56, 0).pull(), 2, exact);
  EXPECT_EQ(p.bond(), BondState::intact);
  EXPECT_EQ(p.to(0.61, 0).pull(), 0);
  EXPECT_EQ(p.bond(), BondState::broken_tension);
  EXPECT_EQ(p.history("tension_damage"), 1);
  EXPECT_EQ(p.history("shear_damage"), 0);
}

TEST(ElastoDamagePlastic, AFullTensionFailureTakesTheAreaUnderTheLine) {
  for (const int steps : {7, 61, 610}) {
    Pair p;
    p.to(0.61, 0, steps);
    EXPECT_NEAR(micro(p.energy().fracture), 0.5 * 5 * 0.6, 1e-6 * 1.5) << steps << " steps";
    EXPECT_NEAR(p.energy().elastic, 0, 1e-20);
    EXPECT_EQ(p.energy().contact, 0);
  }
  Pair interrupted;
  interrupted.to(0.55, 0).to(-0.2, 0).to(0.3, 0).to(0.7, 0, 1000);
  EXPECT_NEAR(micro(interrupted.energy().fracture), 1.5, 1e-6 * 1.5);
  EXPECT_NEAR(micro(interrupted.work()), 1.5, 1e-3);
}

TEST(ElastoDamagePlastic, ShearSoftensAndUnloadsAlongTheSecant) {
  Pair p;
  EXPECT_NEAR(p.to(0, 2.5).drag(), 10, exact);
  EXPECT_NEAR(p.to(0, 2.7).drag(), 6, exact) << "40 % of the way from 2.5 to 3";
  EXPECT_EQ(p.history("regime"), 2);
  EXPECT_NEAR(p.to(0, 1.35).drag(), 3, exact);
  EXPECT_NEAR(p.to(0, -2.7).drag(), -6, exact) << "the same in the other direction";
  EXPECT_NEAR(p.history("shear_damage"), 0.4, exact);
  EXPECT_NEAR(p.to(0, 2.8).drag(), 4, exact);
  EXPECT_EQ(p.history("tension_damage"), 0) << "uncoupled";
  EXPECT_EQ(p.bond(), BondState::intact);
  EXPECT_EQ(p.to(0, 3.05).drag(), 0) << "no pressure, no friction";
  EXPECT_EQ(p.bond(), BondState::broken_shear);
  EXPECT_NEAR(micro(p.energy().fracture), 0.5 * 10 * 3, 1e-6 * 15);
}

TEST(ElastoDamagePlastic, PressureStrengthensShearAndCoulombFollows) {
  Pair p;
  p.to(-1, 0);  // pressed with 10: strength 10 + 0.5 10 = 15 at 3.75, gone at 4.5
  EXPECT_NEAR(p.to(-1, 3.75).drag(), 15, exact);
  EXPECT_NEAR(p.to(-1, 4.125).drag(), 7.5, exact);
  EXPECT_NEAR(p.history("shear_damage"), 0.5, exact);
  EXPECT_NEAR(p.to(-1, 4.5 - 1e-6, 1000).drag(), 0, 1e-4);
  EXPECT_EQ(p.bond(), BondState::intact);
  p.to(-1, 4.5 + 1e-6, 1);
  EXPECT_EQ(p.bond(), BondState::broken_shear);
  EXPECT_NEAR(micro(p.energy().fracture), 0.5 * 15 * 4.5, 1e-6 * 33.75);
  EXPECT_NEAR(p.pull(), -10, exact) << "breaking in shear leaves the pressure";
  EXPECT_NEAR(p.to(-1, 5).drag(), 4 * 0.5, 1e-5) << "friction is taken up from zero";
  EXPECT_NEAR(p.to(-1, 5.5).drag(), 0.3 * 10, exact) << "mu2 |F_n|";
  EXPECT_EQ(p.history("regime"), 8);
  const double before = p.energy().friction;
  EXPECT_NEAR(p.to(-1, 7.5).drag(), 3, exact);
  EXPECT_NEAR(micro(p.energy().friction - before), 3 * 2, 1e-6);
  EXPECT_NEAR(p.to(-2, 8.5).drag(), 0.3 * 20, exact) << "grows with the pressure";
  EXPECT_EQ(p.to(0.1, 8.5).pull(), 0) << "no tension";
  EXPECT_EQ(p.drag(), 0);
}

TEST(ElastoDamagePlastic, LosingThePressureCanBreakInShear) {
  Pair p;
  p.to(-1, 0).to(-1, 3.5);  // below 3.75, but above the 3 at which nothing is left without pressure
  EXPECT_EQ(p.history("shear_damage"), 0);
  p.to(-0.5, 3.5);  // strength 12.5 at 3.125: 3.5 is 60 % of the way to 3.75
  EXPECT_NEAR(p.history("shear_damage"), 0.6, exact);
  EXPECT_NEAR(p.drag(), 0.4 * 12.5, exact);
  EXPECT_NEAR(p.to(-1, 3.5).drag(), 5, exact) << "the pressure comes back, the damage stays";
  p.to(0, 3.5);
  EXPECT_EQ(p.bond(), BondState::broken_shear);
}

TEST(ElastoDamagePlastic, CompressionHardensInThreeBranchesAndUnloadsElastically) {
  Pair p;
  EXPECT_NEAR(p.to(-2, 0).pull(), -20, exact);
  EXPECT_EQ(p.history("plastic_strain"), 0);
  EXPECT_NEAR(p.to(-4, 0).pull(), -30, exact) << "half of E";
  EXPECT_EQ(p.history("regime"), 4);
  EXPECT_NEAR(p.to(-3, 0).pull(), -20, exact) << "unloads with E";
  EXPECT_EQ(p.history("regime"), 0);
  EXPECT_NEAR(p.to(-4, 0).pull(), -30, exact);
  EXPECT_NEAR(p.history("plastic_strain"), 1 * um / 2e-3, 1e-12) << "30 is 3 um of elastic strain, out of 4";
  EXPECT_NEAR(p.to(-6, 0).pull(), -40, exact);
  EXPECT_NEAR(p.to(-10, 0).pull(), -50, exact) << "a quarter of E";
  EXPECT_NEAR(p.to(-8, 0).pull(), -30, exact);
  EXPECT_NEAR(p.to(-14, 0).pull(), -60, exact);
  EXPECT_NEAR(p.to(-20, 0).pull(), -72, exact) << "a fifth of E";
  EXPECT_NEAR(p.to(-12.8, 0).pull(), 0, 1e-7) << "7.2 um elastic: the rest is plastic";
  EXPECT_NEAR(p.history("plastic_strain"), 12.8 * um / 2e-3, 1e-12);
  // Area under the line 20 + 120 + 400 + 396, less what came back: 0.5 72 7.2.
  EXPECT_NEAR(micro(p.energy().contact), 936 - 259.2, 1e-6);
  EXPECT_NEAR(p.to(-12.3, 0).pull(), 5, 1e-7) << "the bond still holds, from its shortened length";
  EXPECT_NEAR(p.to(-12.24, 0).pull(), 2, 1e-6);
}

TEST(ElastoDamagePlastic, ThePlasticWorkDoesNotDependOnTheSteps) {
  Pair p(
      Json{{"compressive_slope_ratios", {1, 4, 1}}});  // bends at 40 only: 20 + 20 at 4 um, then 2.5/um to 60 at 12 um
  p.to(-16, 0, 3);
  EXPECT_NEAR(p.pull(), -100, exact);
  EXPECT_NEAR(micro(p.energy().contact), 0.5 * (40 + 60) * (8 - 2), 1e-6);
}

TEST(ElastoDamagePlastic, WithoutLimitsCompressionIsElastic) {
  Json c = config();
  c.erase("compressive_limits");
  c.erase("compressive_slope_ratios");
  HeldPair p(make_law(c, "elasto_damage_plastic"));
  p.lead(-100 * um, 0);
  EXPECT_NEAR(p.normal_force() / pi, -1000, 1e-6);
  EXPECT_EQ(p.history("plastic_strain"), 0);
}

TEST(ElastoDamagePlastic, CoupledFailureJoinsTheStrengthsByALine) {
  Pair p(Json{{"failure", "coupled"}});
  p.to(0.25, 1.25);  // half of either strength
  EXPECT_NEAR(p.history("tension_damage"), 0, exact);
  EXPECT_NEAR(p.pull(), 2.5, exact);
  EXPECT_NEAR(p.drag(), 5, exact);
  p.to(0.275, 1.375);
  EXPECT_NEAR(p.history("tension_damage"), 0.5, exact);
  EXPECT_NEAR(p.history("shear_damage"), 0.5, exact);
  EXPECT_NEAR(p.pull(), 1.25, exact);
  EXPECT_NEAR(p.drag(), 2.5, exact);
  p.to(0.305, 1.525);
  EXPECT_EQ(p.bond(), BondState::broken_combined);
  EXPECT_EQ(p.pull(), 0);
  EXPECT_EQ(p.drag(), 0);
  EXPECT_NEAR(micro(p.energy().fracture), 0.5 * (2.5 * 0.3 + 5 * 1.5), 1e-6);
  EXPECT_EQ(Pair(Json{{"failure", "coupled"}}).to(0.7, 0).bond(), BondState::broken_tension);
  EXPECT_EQ(Pair(Json{{"failure", "coupled"}}).to(-1, 0).to(-1, 4.6).bond(), BondState::broken_shear);
  EXPECT_NEAR(Pair(Json{{"failure", "coupled"}}).to(-1, 0).to(-1, 3.75).drag(), 15, exact)
      << "under pressure as uncoupled";
}

TEST(ElastoDamagePlastic, TheShearThatATensionFailureLeavesIsReleased) {
  Pair p;
  p.to(0, 2).to(0.61, 2);
  EXPECT_EQ(p.bond(), BondState::broken_tension);
  EXPECT_EQ(p.drag(), 0);
  EXPECT_NEAR(micro(p.energy().fracture), 1.5 + 0.5 * 8 * 2, 1e-6) << "triangle and shear spring";
}

TEST(ElastoDamagePlastic, ContactDampingFollowsEquation30) {
  Pair p(Json{{"contact_damping", 0.9}}, true, 1);
  const double m = 0.5 * HeldPair::density * 4.0 / 3.0 * pi * 1e-9, kn = 10 * pi / um;
  const double dashpot = 2 * pi * 1e-3 * 0.9 / 2e-3 * std::sqrt(m * kn);
  const int n = 200;
  const double time = n * p.simulation().time_step(), speed = 0.2 * um / time;
  p.to(0.2, 0, n);
  EXPECT_NEAR(p.normal_force(), kn * 0.2 * um + dashpot * speed, 1e-9 * p.normal_force());
  // The force over the way; over the first increment the mean of none and all of it.
  EXPECT_NEAR(p.energy().contact, dashpot * speed * 0.2 * um * (n - 0.5) / n, 1e-9 * p.energy().contact);
  EXPECT_NEAR(p.unaccounted(), 0, 1e-9 * p.work());
  p.to(-0.2, 0, n);
  EXPECT_NEAR(p.normal_force(), -kn * 0.2 * um - 2 * dashpot * speed, 1e-9 * -p.normal_force());
}

TEST(ElastoDamagePlastic, ADashpotWithoutBondDoesNotPull) {
  Pair p(Json{{"contact_damping", 0.9}}, false, 1);
  p.to(-0.1, 0, 1000);
  EXPECT_LT(p.pull(), -1);
  p.to(-0.05, 0, 1);  // fast enough for the dashpot to win over the spring
  EXPECT_EQ(p.pull(), 0);
  EXPECT_GT(p.energy().contact, 0);
  EXPECT_EQ(p.to(0.2, 0).pull(), 0);
}

TEST(ElastoDamagePlastic, TheStepIsStableWithFullDampingInAPacking) {
  for (const double damping : {0.0, 0.9, 1.0}) {
    Bench b;
    b.law = make_law(config({{"contact_damping", damping}, {"tensile_strength", 1e15}, {"shear_strength", 1e15}}),
                     "elasto_damage_plastic");
    EngineSettings settings;
    settings.safety = 1;
    b.simulation =
        std::make_unique<Simulation>(assemble(random_block(5, 5, 5, 1e-3, 3), {2650}, 3, 1.0), *b.law, settings);
    b->bond({GapMeasure::relative, 0.25, std::nullopt});
    b->prepare();
    std::mt19937_64 random(4);
    const auto speed = [&] { return 1e-3 * (double(random() >> 11) * 0x1p-52 - 1); };
    for (Index k = 0; k < 125; ++k) {
      b->hold(k, dof::all, Vec3(speed(), speed(), speed()), Vec3::Zero());
      b->release(k, dof::all);
    }
    b->forces();
    b->mark_start_of_loading();
    const double initial = b->view().energy.initial;
    for (int k = 0; k < 2000; ++k) {
      b->advance();
      b->forces();
    }
    const EnergyLedger e = b->view().energy;
    const double left = (e.elastic + e.kinetic) / initial;
    if (damping == 0) EXPECT_NEAR(left, 1, 1e-3);
    else EXPECT_LT(left, 0.3) << damping << ": an unstable step would let it grow";
    EXPECT_NEAR(left + e.contact / initial, 1, 1e-3) << damping;
  }
}

TEST(ElastoDamagePlastic, ARandomWalkLeavesNoEnergyUnaccounted) {
  for (const char* failure : {"uncoupled", "coupled"}) {
    std::mt19937_64 random(17);
    const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
    Pair p(Json{{"failure", failure}});
    double most = 0;
    for (int k = 0; k < 10; ++k) {
      p.to(0.58 - 6 * uniform(), 9 * uniform() - 4.5, 4000);
      most = std::max(most, std::abs(p.unaccounted()));
    }
    EXPECT_LT(most, 1e-3 * p.work()) << failure;
    EXPECT_GT(p.energy().contact, 0);
    EXPECT_GT(p.energy().fracture, 0);
    EXPECT_GT(p.energy().friction, 0) << "the walk must meet every branch";
  }
}

TEST(ElastoDamagePlastic, TheAreaFactorComesFromPorosityAndCoordinationNumber) {
  Json c = config();
  c.erase("area_factor");
  const auto law = make_law(c, "elasto_damage_plastic");
  Simulation s(assemble(simple_cubic(3, 3, 3, 1e-3), {2650}, 3, 1.0), *law, {});
  s.bond({GapMeasure::relative, 1e-9, std::nullopt});
  // A box of 27 cubes that a sphere each fills to pi/6; 54 contacts of 27 spheres.
  EXPECT_NEAR(law->derived().at(0).second.get<double>(), 40 * (1 - pi / 6) / 4, 1e-12);
  Simulation loose(assemble(simple_cubic(3, 3, 3, 1e-3), {2650}, 3, 1.0), *law, {});
  EXPECT_THROW(loose.bond({GapMeasure::relative, -0.1, std::nullopt}), UserError);
  Simulation plane(assemble(simple_cubic(3, 3, 1, 1e-3), {2650}, 3, 1.0), *law, {});
  EXPECT_NO_THROW(plane.bond({GapMeasure::relative, 1e-9, std::nullopt}));
}

}  // namespace
}  // namespace breccia::testing
