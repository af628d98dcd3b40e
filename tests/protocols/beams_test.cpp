// SPDX-License-Identifier: BSD-3-Clause
// Chains of `linear_parallel_bond` and of `beam_bond` are beams: deflections, slopes, first break and frequencies
// against exact solutions of the discrete chain or of the beam.
#include <Eigen/Eigenvalues>

#include "protocols/chain.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3, d = 2 * r, modulus = 1e9, ratio = 2.5, poisson = 0.25, pi = std::numbers::pi;
constexpr double shear_modulus = modulus / (2 * (1 + poisson));

Json parallel_bond(double strength = 1e15) {
  return {{"bond_modulus", modulus},   {"stiffness_ratio", ratio},       {"tensile_strength", strength},
          {"cohesion", 1e15},          {"internal_friction_angle", 0.0}, {"radius_multiplier", 1.0},
          {"moment_contribution", 1.0}};
}
Json beam_bond(double multiplier = 1) {
  return {{"bond_modulus", modulus},  {"poisson_ratio", poisson},     {"radius_multiplier", multiplier},
          {"tensile_strength", 1e15}, {"compressive_strength", 1e15}, {"shear_strength", 1e15}};
}

/// So small that the square of the rotations does not count.
double small_force(const BeamSection& s, double length) { return 1e-4 * modulus * s.bending / (length * length); }

/// Along the known vector; across it stands what goes with the square of the rotations: a bent chain is shorter.
void expect_near(const Vec3& found, const Vec3& known, const char* what) {
  const double size = known.norm(), along = found.dot(known) / size;
  EXPECT_TRUE(std::abs(along - size) < 1e-6 * size && (found - along * known / size).norm() < 1e-3 * size)
      << what << ": " << found.transpose() << ", known " << known.transpose();
}

// Rigid bars with springs in the middle between the centres. Hinge k, at x_k = (k - 1/2) d, turns by M(x_k)/(k_n I).
TEST(Beams, AChainOfParallelBondsBendsAsRigidBarsWithSpringsBetween) {
  for (const int dimension : {2, 3})
    for (const int n : {1, 3, 10}) {
      SCOPED_TRACE(std::to_string(n) + " bonds, " + std::to_string(dimension) + "D");
      const Chain chain = Chain::equal(dimension, n, r);
      const BeamSection s(dimension, r);
      const double L = n * d, ks = modulus / d / ratio, EI = modulus * s.bending, F = small_force(s, L);
      ProtocolRun run(chain.packing(), parallel_bond(), "linear_parallel_bond", 1e-6, "end_load",
                      cantilever(F * Vec3::UnitX(), Vec3::Zero()), dimension);
      run.go(500000, 2000);
      const double deflection = n * F / (ks * s.area) + F * L * L * L / (3 * EI) * (1 - 1 / (4.0 * n * n));
      expect_near(vector_result(run, "upper_load_displacement", "m"), deflection * Vec3::UnitX(), "deflection");
      expect_near(vector_result(run, "upper_load_rotation", "rad"), F * L * L / (2 * EI) * chain.bending_axis(),
                  "slope");
      expect_near(vector_result(run, "lower_support_reaction_force", "N"), -F * Vec3::UnitX(), "reaction");
      expect_near(vector_result(run, "lower_support_reaction_moment", "N m"), -F * L * chain.bending_axis(), "moment");
      EXPECT_EQ(run.summary.at("stopped_by"), "rest");

      ProtocolRun turned(chain.packing(), parallel_bond(), "linear_parallel_bond", 1e-6, "end_load",
                         cantilever(Vec3::Zero(), F * L * chain.bending_axis(), {{"rest", 2e-8}}), dimension);
      turned.go(500000, 2000);
      expect_near(vector_result(turned, "upper_load_displacement", "m"), F * L * L * L / (2 * EI) * Vec3::UnitX(),
                  "deflection by a moment");
      expect_near(vector_result(turned, "upper_load_rotation", "rad"), F * L * L / EI * chain.bending_axis(),
                  "slope by a moment");
    }
}

TEST(Beams, PullAndTwistAreThoseOfTheBar) {
  const int n = 5;
  const Chain chain = Chain::equal(3, n, r);
  const BeamSection s(3, r);
  const double L = n * d, F = 1e-6 * modulus * s.area, T = 1e-6 * modulus * s.torsion / L;
  const struct {
    const char* law;
    Json config;
    double shear_modulus;
  } laws[] = {{"linear_parallel_bond", parallel_bond(), modulus / ratio}, {"beam_bond", beam_bond(), shear_modulus}};
  for (const auto& law : laws) {
    SCOPED_TRACE(law.law);
    ProtocolRun run(chain.packing(), law.config, law.law, 1e-6, "end_load",
                    cantilever(F * Vec3::UnitZ(), T * Vec3::UnitZ()), 3);
    run.go(500000, 2000);
    expect_near(vector_result(run, "upper_load_displacement", "m"), F * L / (modulus * s.area) * Vec3::UnitZ(),
                "stretch");
    expect_near(vector_result(run, "upper_load_rotation", "rad"),
                T * L / (law.shear_modulus * s.torsion) * Vec3::UnitZ(), "twist");
  }
}

TEST(Beams, AChainOfParallelBondsBreaksAtItsRoot) {
  const int n = 6;
  const double strength = 1e6, L = n * d;
  for (const int dimension : {2, 3}) {
    const BeamSection s(dimension, r);
    const double F = strength * s.bending / r / (L - d / 2);
    ProtocolRun run(
        Chain::equal(dimension, n, r).packing(), parallel_bond(strength), "linear_parallel_bond", 1e-6, "end_load",
        cantilever(1.5 * F * Vec3::UnitX(), Vec3::Zero(), {{"ramp_time", 20e-3}, {"stop_at_first_break", true}}),
        dimension);
    run.go(500000, 2000);
    EXPECT_EQ(run.summary.at("stopped_by"), "first break");
    // The load grows in some ten periods of the chain, damped: what is left of inertia is below a hundredth.
    EXPECT_NEAR(1.5 * run.summary.at("load_factor_at_first_break").get<double>(), 1, 0.01) << dimension;
    const SimulationView v = run.simulation().view();
    ASSERT_EQ(v.bonds.cracks.size(), 1u);
    EXPECT_NEAR(v.bonds.cracks[0].position.dot(v.specimen.axis), d, 0.01 * d) << "the first contact of the chain";
  }
}

TEST(Beams, ABeamBondIsATimoshenkoBeamForAnyNumberOfThem) {
  for (const int dimension : {2, 3})
    for (const bool unequal : {false, true})
      for (const int n : {1, 2, 7}) {
        SCOPED_TRACE(std::to_string(n) + " bonds, " + std::to_string(dimension) + "D" + (unequal ? ", unequal" : ""));
        Chain chain = Chain::equal(dimension, n, r);
        // Of each pair the smaller is 1 mm: a beam of one radius, whose parts are not halved by the contact points.
        if (unequal)
          for (std::size_t k = 0; k < chain.radii.size(); k += 2) chain.radii[k] = 1.7 * r;
        const double lambda = 0.8, L = chain.length();
        const BeamSection s(dimension, lambda * r);
        const double EI = modulus * s.bending, F = small_force(s, L);
        ProtocolRun run(chain.packing(), beam_bond(lambda), "beam_bond", 1e-6, "end_load",
                        cantilever(F * Vec3::UnitX(), Vec3::Zero()), dimension);
        run.go(1000000, 2000);
        expect_near(vector_result(run, "upper_load_displacement", "m"),
                    (F * L * L * L / (3 * EI) + F * L / (s.coefficient * shear_modulus * s.area)) * Vec3::UnitX(),
                    "deflection");
        expect_near(vector_result(run, "upper_load_rotation", "rad"), F * L * L / (2 * EI) * chain.bending_axis(),
                    "slope");
        if (n != 2) continue;
        ProtocolRun turned(chain.packing(), beam_bond(lambda), "beam_bond", 1e-6, "end_load",
                           cantilever(Vec3::Zero(), F * L * chain.bending_axis(), {{"rest", 2e-8}}), dimension);
        turned.go(1000000, 2000);
        expect_near(vector_result(turned, "upper_load_displacement", "m"), F * L * L * L / (2 * EI) * Vec3::UnitX(),
                    "deflection by a moment");
      }
}

/// Held at both ends, but free to turn there.
Json simple_supports() {
  return {{{"at", "lower"}, {"holds", {"translation", "rotation_z"}}}, {{"at", "upper"}, {"holds", {"x", "y"}}}};
}

TEST(Beams, ASimplySupportedBeamBendsAsItShould) {
  const Chain chain = Chain::equal(3, 6, r);
  const BeamSection s(3, r);
  const double L = chain.length(), F = small_force(s, L), EI = modulus * s.bending;
  Json config = cantilever(F * Vec3::UnitX(), Vec3::Zero());
  config["supports"] = simple_supports();
  config["loads"][0]["at"] = "middle";
  config["loads"][0]["depth"] = r;
  ProtocolRun run(chain.packing(), beam_bond(), "beam_bond", 1e-6, "end_load", config, 3);
  run.go(1000000, 2000);
  expect_near(vector_result(run, "middle_load_displacement", "m"),
              (F * L * L * L / (48 * EI) + F * L / (4 * s.coefficient * shear_modulus * s.area)) * Vec3::UnitX(),
              "deflection");
  expect_near(vector_result(run, "lower_support_reaction_force", "N"), -0.5 * F * Vec3::UnitX(), "half each");
  expect_near(vector_result(run, "upper_support_rotation", "rad"), -F * L * L / (16 * EI) * Vec3::UnitY(), "slope");
}

constexpr double mass = 2650 * 4.0 / 3.0 * pi * r * r * r;  // of a sphere [kg]

/// Lowest angular frequency of a chain of textbook beams from centre to centre, with the masses and the rotary inertia
/// of the spheres at the nodes. Of node k the deflection is component 2 k and the slope 2 k + 1; `held` do not move.
double lowest_frequency(int beams, double L, const std::vector<int>& held) {
  const BeamSection s(3, r);
  const double EI = modulus * s.bending, phi = 12 * EI / (s.coefficient * shear_modulus * s.area * L * L);
  Eigen::Matrix4d beam;
  beam << 12, 6 * L, -12, 6 * L, 6 * L, (4 + phi) * L * L, -6 * L, (2 - phi) * L * L, -12, -6 * L, 12, -6 * L, 6 * L,
      (2 - phi) * L * L, -6 * L, (4 + phi) * L * L;
  beam *= EI / (L * L * L * (1 + phi));
  const int n = 2 * (beams + 1);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n), inertia = stiffness;
  for (int b = 0; b < beams; ++b) stiffness.block<4, 4>(2 * b, 2 * b) += beam;
  for (int k = 0; k < n; k += 2) {
    inertia(k, k) = mass;
    inertia(k + 1, k + 1) = 0.4 * mass * r * r;
  }
  for (const int k : held) stiffness(k, k) *= 1e9;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, inertia, Eigen::EigenvaluesOnly);
  return std::sqrt(modes.eigenvalues()[0]);
}

/// Angular frequency with which a chain swings that was bent by a load on all of it but its ends and let go.
double measured_frequency(const Chain& chain, const Json& supports, double expected, bool tip) {
  const double period = 2 * pi / expected;
  const BeamSection s(3, r);
  Json config = cantilever(small_force(s, chain.length()) * Vec3::UnitX(), Vec3::Zero(),
                           {{"ramp_time", 3 * period}, {"release_after", 0.0}, {"duration", 15 * period}});
  config["supports"] = supports;
  config.erase("rest");
  config["rest"] = 1e-4;
  if (!tip) {
    config["loads"][0]["at"] = "middle";
    config["loads"][0]["depth"] = chain.length() - r;
  }
  ProtocolRun run(chain.packing(), beam_bond(), "beam_bond", chain.gap / d + 1e-6, "end_load", config, 3, 1, 0.0);
  const std::string curve = tip ? "upper_load_displacement_x" : "middle_load_displacement_x";
  std::vector<double> zeros;
  double before = 0, time_before = 0;
  run.go(
      2000000,
      [&](Simulation& sim) {
        const double x = run.rows.last(curve), t = sim.time();
        if (run.rows.last("load_factor") == 0 && time_before > 3 * period && x * before < 0)
          zeros.push_back(time_before + (t - time_before) * before / (before - x));
        before = x;
        time_before = t;
      },
      20);
  EXPECT_EQ(run.summary.at("stopped_by"), "duration");
  if (zeros.size() < 20) return 0;
  return pi * double(zeros.size() - 1) / (zeros.back() - zeros.front());
}

// Higher modes have less than a fiftieth of the amplitude: over fifteen periods they shift the zeros by less than
// 1/1000.
TEST(Beams, SwingWithTheFrequencyOfTextbookBeamsWithMassesAtTheirNodes) {
  double off[2];  // from Euler and Bernoulli's beam with the mass spread evenly
  for (const int n : {8, 16}) {
    const Chain chain = Chain::equal(3, n, r);
    const double L = chain.length(), known = lowest_frequency(n, d, {0, 2 * n});
    const double measured = measured_frequency(chain, simple_supports(), known, false);
    EXPECT_NEAR(measured, known, 1e-3 * known) << n;
    const BeamSection s(3, r);
    off[n == 16] = 1 - measured / (pi * pi / (L * L) * std::sqrt(modulus * s.bending / (mass / d)));
  }
  // Shear and rotary inertia, and the lumps, all go with (d/L)^2.
  EXPECT_GT(off[0], 0);
  EXPECT_NEAR(off[0] / off[1], 4, 0.5);
}

/// The fibre of Guo et al. (2018): spheres of 1 mm, 4 mm apart.
TEST(Beams, AFibreSwingsAsACantilever) {
  const int n = 10;
  const Chain chain = Chain::equal(3, n, r, d);
  const double known = lowest_frequency(n, 2 * d, {0, 1});
  EXPECT_NEAR(measured_frequency(chain, {{{"at", "lower"}, {"holds", {"all"}}}}, known, true), known, 2e-3 * known);
}

}  // namespace
}  // namespace breccia::testing
