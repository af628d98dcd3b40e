// SPDX-License-Identifier: BSD-3-Clause
// Triaxial, oedometric and cyclic compression: pressures are what was asked for, as measured from the particles;
// results do not depend on the threads, on how a test is cut into stages, or on the axis.

#include "protocols/protocol_run.hpp"
#include "support/same_bits.hpp"

namespace breccia::testing {
namespace {

/// Bonds that never break.
Json strong() { return elastic_brittle({{"tensile_strength", 1e12}, {"shear_strength", 1e12}}); }
PackedParticles block(unsigned seed = 7) { return random_block(6, 6, 10, 1e-3, seed); }

Json triaxial(const Json& changes) {
  Json c = {{"platen_velocity", 0.5}};
  for (const auto& [key, value] : changes.items()) c[key] = value;
  return c;
}

TEST(Triaxial, ConfinesABlockHydrostaticallyAsMeasuredFromItsParticles) {
  const PackedParticles lattice = simple_cubic(6, 5, 8, 1e-3);
  ProtocolRun run(lattice, strong(), "elastic_brittle", 1e-6, "triaxial_compression",
                  triaxial({{"stages", {{{"confining_pressure", 20e6}}, {{"hold_time", 20e-6}}}}}));
  run.go(200000);
  const Mat3 stress = mean_stress(run.simulation());
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(stress(k, k), -20e6, 0.01 * 20e6) << k;
  EXPECT_NEAR(run.rows.last("confining_pressure_applied"), 20e6, 1e-6 * 20e6);
  EXPECT_NEAR(run.rows.last("platen_stress"), 20e6, 0.01 * 20e6);
}

TEST(Triaxial, HoldsThePressureWhileAnIrregularBlockIsLoaded) {
  ProtocolRun run(block(), strong(), "elastic_brittle", 0.2, "triaxial_compression",
                  triaxial({{"confining_pressure", 10e6}, {"max_strain", 0.002}}));
  double most = 0, least = 1e300;
  run.go(200000, [&](Simulation& sim) {
    if (run.rows.last("stage") < 1) return;
    const Mat3 s = mean_stress(sim);
    const double lateral = -0.5 * (s(0, 0) + s(1, 1));
    most = std::max(most, lateral);
    least = std::min(least, lateral);
  });
  // The surface is rougher than the box that the volume is measured by: the mean lies a few per cent below the
  // pressure.
  EXPECT_LT(most, 1.03 * 10e6);
  EXPECT_GT(least, 0.9 * 10e6);
  EXPECT_GT(run.rows.last("deviatoric_platen_stress"), 4e6);
  EXPECT_NEAR(run.summary.at("stages")[1]["platen_strain"].get<double>(), 0.002, 2e-5);
}

TEST(Triaxial, DiscAreasAddUpToWhatTheSurfaceParticlesCover) {
  Json config = triaxial({{"pressure_area", "disc"}, {"stages", {{{"confining_pressure", 20e6}}}}});
  ProtocolRun run(simple_cubic(6, 5, 8, 1e-3), strong(), "elastic_brittle", 1e-6, "triaxial_compression", config);
  run.go(200000);
  const double before = 2 * (12e-3 + 10e-3) * 16e-3, now = run.summary.at("lateral_surface_area_m2").get<double>();
  EXPECT_LT(now, before) << "the pressure shrinks the specimen";
  EXPECT_GT(now, 0.99 * before);
  EXPECT_NEAR(run.rows.last("confining_pressure_applied"), std::numbers::pi / 4 * before / now * 20e6, 1e-9 * 20e6);
}

TEST(Triaxial, DoesNotDependOnTheCutIntoStagesNorOnThreads) {
  const Json whole = triaxial({{"stages", {{{"confining_pressure", 5e6}}, {{"axial_strain", 0.03}}}}});
  const Json cut = triaxial({{"stages",
                              {{{"confining_pressure", 5e6}},
                               {{"axial_strain", 0.004}},
                               {{"axial_strain", 0.011}},
                               {{"axial_strain", 0.03}}}}});
  ProtocolRun one(block(), elastic_brittle(), "elastic_brittle", 0.2, "triaxial_compression", whole);
  one.go(300000);
  const Particles& p = one.simulation().state().particles;
  std::size_t broken = 0;
  for (const BondState s : one.simulation().state().bonds.state) broken += is_broken(s);
  ASSERT_GT(broken, 20u) << "the test must break something";
  for (const int threads : {1, 3}) {
    ProtocolRun other(block(), elastic_brittle(), "elastic_brittle", 0.2, "triaxial_compression",
                      threads == 1 ? cut : whole, 3, threads);
    other.go(300000);
    EXPECT_TRUE(same_bits(p.position(), other.simulation().state().particles.position())) << threads;
    EXPECT_TRUE(same_bits(p.velocity(), other.simulation().state().particles.velocity())) << threads;
  }
}

TEST(Triaxial, ALatticeIsAsStiffAlongEachAxis) {
  for (const std::string axis : {"x", "y", "z"}) {
    ProtocolRun run(simple_cubic(6, 6, 6, 1e-3), strong(), "elastic_brittle", 1e-6, "triaxial_compression",
                    triaxial({{"axis", axis}, {"confining_pressure", 2e6}, {"max_strain", 0.001}}));
    run.go(200000);
    // E = E_c = 10 GPa exactly in a simple cubic lattice; the platens' springs are twice as stiff as a bond and half as
    // long.
    EXPECT_NEAR(run.rows.last("deviatoric_platen_stress") / run.rows.last("platen_strain"), 10e9, 0.02 * 10e9) << axis;
  }
}

TEST(Cycles, UnloadWithTheSlopeOfLoadingWhileElastic) {
  const Json stages = {
      {{"axial_strain", 0.002}}, {{"axial_stress", 2e6}}, {{"axial_strain", 0.003}}, {{"axial_stress", 5e6}}};
  ProtocolRun run(simple_cubic(5, 5, 8, 1e-3), strong(), "elastic_brittle", 1e-6, "uniaxial_compression",
                  {{"platen_velocity", 0.3}, {"stages", stages}});
  run.go(200000);
  const auto ends = run.summary.at("stages");
  ASSERT_EQ(ends.size(), 4u);
  EXPECT_NEAR(ends[0]["platen_strain"].get<double>(), 0.002, 2e-5);
  EXPECT_NEAR(ends[1]["platen_stress_Pa"].get<double>(), 2e6, 0.3e6);
  EXPECT_NEAR(ends[2]["platen_strain"].get<double>(), 0.003, 2e-5);
  const double down = (ends[0]["platen_stress_Pa"].get<double>() - ends[1]["platen_stress_Pa"].get<double>()) /
                      (ends[0]["platen_strain"].get<double>() - ends[1]["platen_strain"].get<double>());
  EXPECT_NEAR(down, 10e9, 0.03 * 10e9);
  EXPECT_EQ(run.summary.at("stopped_by"), "last stage");
}

TEST(Cycles, PlasticBondsUnloadStifferThanTheyYield) {
  const Json law = {{"youngs_modulus", 10e9},
                    {"poisson_ratio", 0.2},
                    {"area_factor", 1.0},
                    {"contact_damping", 0.5},
                    {"tensile_strength", 1e12},
                    {"shear_strength", 1e12},
                    {"internal_friction", 0.5},
                    {"friction", 0.5},
                    {"softening_tension", 0.2},
                    {"softening_shear", 0.2},
                    {"failure", "uncoupled"},
                    {"compressive_limits", {20e6, 40e6, 60e6}},
                    {"compressive_slope_ratios", {5, 5, 5}}};
  const Json stages = {{{"axial_strain", 0.008}}, {{"axial_strain", 0.007}}};
  ProtocolRun run(simple_cubic(5, 5, 8, 1e-3), law, "elasto_damage_plastic", 1e-6, "uniaxial_compression",
                  {{"platen_velocity", 0.3}, {"stages", stages}});
  run.go(200000);
  const auto stress = run.rows.column("platen_stress"), strain = run.rows.column("platen_strain"),
             stage = run.rows.column("stage");
  const auto slope = [&](double of, double from, double to) {
    double s0 = 0, e0 = 0, s1 = 0, e1 = 0;
    bool begun = false;
    for (std::size_t k = 0; k < strain.size(); ++k) {
      if (stage[k] != of || strain[k] < std::min(from, to) || strain[k] > std::max(from, to)) continue;
      if (!begun) {
        s0 = stress[k];
        e0 = strain[k];
        begun = true;
      }
      s1 = stress[k];
      e1 = strain[k];
    }
    return (s1 - s0) / (e1 - e0);
  };
  const double first = slope(0, 0.0003, 0.0015), yielding = slope(0, 0.005, 0.0075), down = slope(1, 0.0077, 0.0072);
  EXPECT_NEAR(yielding / first, 0.2, 0.04);
  EXPECT_NEAR(down / first, 1, 0.05);
}

TEST(Oedometer, LetsNothingOutAndMeasuresThePressureOfItsCell) {
  for (const bool round : {false, true}) {
    PackedParticles p = block();
    if (round) {
      PackedParticles inside;
      for (std::size_t k = 0; k < p.position.size(); ++k)
        if (std::hypot(p.position[k].x() - 6e-3, p.position[k].y() - 6e-3) + p.radius[k] < 5.9e-3) {
          inside.position.push_back(p.position[k]);
          inside.radius.push_back(p.radius[k]);
        }
      inside.outline = SpecimenShape::Outline::cylinder;
      p = inside;
    }
    ProtocolRun run(p, strong(), "elastic_brittle", 0.25, "uniaxial_strain_compression",
                    {{"platen_velocity", 0.5}, {"max_strain", 0.004}, {"cell_stiffness", 1e9}});
    run.go(300000);
    const double axial = run.rows.last("platen_stress"), cell = run.rows.last("confining_pressure_applied");
    EXPECT_GT(cell, 0.005 * axial) << round;
    EXPECT_LT(cell, 0.6 * axial) << round;
    const Mat3 s = mean_stress(run.simulation());
    EXPECT_NEAR(-0.5 * (s(0, 0) + s(1, 1)), cell, 0.15 * cell)
        << round << ": only the outermost particles reach the cell";
    double farthest = 0;
    const Particles& q = run.simulation().state().particles;
    for (Index k = 0; k < q.size(); ++k)
      farthest = std::max(farthest, std::hypot(q.position()[k].x() - 6e-3, q.position()[k].y() - 6e-3) + q.radius()[k]);
    if (round) { EXPECT_LT(farthest, 5.9e-3 * 1.001); }
  }
}

TEST(Jacket, HoldsItsPressureFromTheStart) {
  ProtocolRun run(simple_cubic(6, 6, 8, 1e-3), strong(), "elastic_brittle", 1e-6, "uniaxial_compression",
                  {{"platen_velocity", 0.3}, {"jacket_pressure", 1e6}, {"max_strain", 0.003}});
  run.go(200000);
  EXPECT_NEAR(-mean_stress(run.simulation())(0, 0), 1e6, 0.02 * 1e6);
  EXPECT_NEAR(run.rows.last("confining_pressure_applied"), 1e6, 1);
}

TEST(Axial, ACylinderIsLoadedAlongItsOwnAxis) {
  PackedParticles p = simple_cubic(4, 4, 6, 1e-3);
  p.outline = SpecimenShape::Outline::cylinder;
  try {
    ProtocolRun run(p, strong(), "elastic_brittle", 1e-6, "triaxial_compression",
                    triaxial({{"axis", "x"}, {"confining_pressure", 1e6}}));
    FAIL() << "must be refused";
  } catch (const UserError& e) {
    EXPECT_STREQ(e.what(), "protocol: a cylinder is loaded along its own axis: leave `axis` out");
  }
}

TEST(Biaxial, IsTheSameTestInAPlane) {
  PackedParticles p = random_block(10, 16, 1, 1e-3, 21);
  for (Vec3& x : p.position) x.z() = 0;
  p.axis = Vec3::UnitY();
  ProtocolRun run(p, strong(), "elastic_brittle", 0.2, "triaxial_compression",
                  triaxial({{"stages", {{{"confining_pressure", 5e6}}, {{"hold_time", 30e-6}}}}}), 2);
  run.go(200000);
  const Mat3 s = mean_stress(run.simulation());
  EXPECT_NEAR(-s(1, 1), 5e6, 0.01 * 5e6);
  EXPECT_NEAR(-s(0, 0), 5e6, 0.06 * 5e6);
  EXPECT_EQ(s(2, 2), 0);
}

/// Seating, peak, stages and end are decided after every step: rows of curves only look on.
TEST(Sampling, HasNoPartInTheTest) {
  const Json to_failure = {{"platen_velocity", 0.5}, {"max_strain", 0.03}};
  const Json stages = {{"platen_velocity", 0.5},
                       {"stages", {{{"confining_pressure", 5e6}}, {{"axial_strain", 0.004}}, {{"axial_stress", 6e6}}}}};
  for (const auto& [protocol, config] :
       {std::pair("uniaxial_compression", to_failure), std::pair("triaxial_compression", stages)}) {
    std::map<std::string, Json> first;
    std::uint64_t steps = 0;
    for (const int every : {1, 20, 777, 1000000}) {
      ProtocolRun run(block(), elastic_brittle(), "elastic_brittle", 0.2, protocol, config);
      run.go(300000, every);
      run.summary.erase("unbalanced_force_ratio_max_before_peak");  // of the rows there are
      run.summary.erase("confining_pressure_applied_Pa");
      if (steps == 0) {
        first = run.summary;
        steps = run.simulation().state().step;
        EXPECT_GT(run.summary.at("peak_platen_stress_Pa").get<double>(), 1e6);
      }
      EXPECT_EQ(run.summary, first) << protocol << ", rows every " << every << " steps";
      EXPECT_EQ(run.simulation().state().step, steps) << protocol << ", rows every " << every << " steps";
    }
  }
}

/// However rarely rows are asked for, those that a fast change or a peak calls for show the peak and the way there.
TEST(Sampling, RowsAreAddedWhereTheLoadChanges) {
  for (const int every : {20, 1000000}) {
    ProtocolRun run(block(), elastic_brittle(), "elastic_brittle", 0.2, "uniaxial_compression",
                    {{"platen_velocity", 0.5}, {"max_strain", 0.03}});
    run.go(300000, every, 0.02);
    const auto stress = run.rows.column("platen_stress");
    const double peak = run.summary.at("peak_platen_stress_Pa").get<double>();
    EXPECT_LE(*std::max_element(stress.begin(), stress.end()), peak);
    EXPECT_GE(*std::max_element(stress.begin(), stress.end()), 0.995 * peak) << every;
    std::size_t between = 0;
    for (const double s : stress) between += s > 0.1 * peak && s < 0.4 * peak;
    EXPECT_GT(between, 20u) << every;
  }
}

/// Targets in stress that never come: platens cannot pull, and no specimen carries this.
TEST(Stages, OutOfReachEndTheTest) {
  ProtocolRun pull(simple_cubic(4, 4, 6, 1e-3), strong(), "elastic_brittle", 1e-6, "uniaxial_compression",
                   {{"platen_velocity", 0.2}, {"stages", {{{"axial_stress", 10e6}}, {{"axial_stress", -1e6}}}}});
  pull.go(200000);
  EXPECT_EQ(pull.summary.at("stopped_by"), "a stage that was not reached");
  EXPECT_EQ(pull.summary.at("stages").size(), 1u) << "the first was reached";

  ProtocolRun push(simple_cubic(4, 4, 6, 1e-3), strong(), "elastic_brittle", 1e-6, "uniaxial_compression",
                   {{"platen_velocity", 2}, {"max_strain", 0.01}, {"stages", {{{"axial_stress", 1e12}}}}});
  push.go(200000);
  EXPECT_EQ(push.summary.at("stopped_by"), "a stage that was not reached");
  EXPECT_NEAR(push.summary.at("final_platen_strain").get<double>(), 0.01, 0.002);
}

/// A limit ends a stage that loads, not one that unloads, or holds, from just past it.
TEST(Stages, UnloadingAndHoldingAtTheStrainLimitAreReached) {
  const Json stages = {{{"axial_strain", 0.01}}, {{"hold_time", 20e-6}}, {{"axial_stress", 1e6}}};
  ProtocolRun run(simple_cubic(4, 4, 6, 1e-3), strong(), "elastic_brittle", 1e-6, "uniaxial_compression",
                  {{"platen_velocity", 1}, {"max_strain", 0.01}, {"stages", stages}});
  run.go(200000);
  EXPECT_EQ(run.summary.at("stopped_by"), "last stage");
  EXPECT_EQ(run.summary.at("stages").size(), 3u);
}

TEST(Stages, PlatensThatPassEachOtherEndTheRun) {
  ProtocolRun run(simple_cubic(4, 4, 6, 1e-3), strong(), "elastic_brittle", 1e-6, "uniaxial_compression",
                  {{"platen_velocity", 20000}, {"ramp_time", 0.0}});
  EXPECT_THROW(run.go(200000, 100000), UserError) << "within a step";
}

}  // namespace
}  // namespace breccia::testing
