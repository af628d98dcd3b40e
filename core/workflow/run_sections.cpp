// SPDX-License-Identifier: BSD-3-Clause
// Sections of a workflow that say how its run goes, and of what it warns.
#include "workflow/workflow.hpp"

namespace breccia {

void SamplingConfig::describe(Schema<SamplingConfig>& s) {
  s.param("every_steps", &SamplingConfig::every_steps)
      .at_least(1)
      .fallback(50)
      .doc(
          "time steps between two rows of curves.csv; has no part in the test itself, which is decided after every "
          "step");
  s.param("load_change", &SamplingConfig::load_change)
      .at_least(0)
      .at_most(1)
      .fallback(0.02)
      .doc(
          "a row is added where the test's load has changed by this share of its largest since the last row, and at "
          "its peak, so that strength and moduli do not depend on every_steps; 0: no row is added");
}

void CurvesConfig::describe(Schema<CurvesConfig>& s) {
  s.param("hdf5", &CurvesConfig::hdf5)
      .fallback(false)
      .doc(
          "write the curves as curves.h5, too, when the run ends: an array each, with its unit and description. "
          "curves.csv is always there: pictures, comparisons and studies read it");
}

void CheckpointsConfig::describe(Schema<CheckpointsConfig>& s) {
  s.param("every", &CheckpointsConfig::every)
      .unit("s")
      .above(0)
      .fallback(600.0)
      .example("10 min")
      .doc(
          "time of the clock between two checkpoints, at least 1 s; whichever of `every`, `every_simulated`, "
          "`every_strain`, `every_steps` comes first");
  s.param("every_simulated", &CheckpointsConfig::every_simulated)
      .unit("s")
      .above(0)
      .example("0.1 ms")
      .doc("simulated time between two checkpoints");
  s.param("every_strain", &CheckpointsConfig::every_strain)
      .above(0)
      .example("0.1 %")
      .doc("axial strain between two checkpoints, as the rows of the curves give it");
  s.param("every_steps", &CheckpointsConfig::every_steps)
      .at_least(1)
      .example("10000")
      .doc("time steps between two checkpoints");
  s.param("keep", &CheckpointsConfig::keep)
      .at_least(0)
      .at_most(1000)
      .fallback(2)
      .doc("how many are kept, the newest ones; 0: none is written, and a run that was stopped cannot go on");
  s.param("at_end", &CheckpointsConfig::at_end)
      .fallback(false)
      .doc("one more before the last step of the test; a run that is stopped on request always leaves one");
}

void BranchConfig::describe(Schema<BranchConfig>& s) {
  s.param("checkpoint", &BranchConfig::checkpoint)
      .doc("a checkpoint of another run, or the folder of its results: the newest one there");
  s.param("protocol", &BranchConfig::protocol)
      .choice("continue", BranchProtocol::go_on, "the test goes on, with its walls and loads; the protocol is the same")
      .choice("new", BranchProtocol::begin,
              "another test begins on the specimen as it is: what loaded it is taken away, the clock stands at 0")
      .doc("default: continue where the protocol is of the same type, else new");
}

void ChecksConfig::describe(Schema<ChecksConfig>& s) {
  s.param("implausible_values", &ChecksConfig::implausible_values)
      .fallback(true)
      .doc(
          "warns of moduli, strengths, densities, velocities and coefficients of friction that are far from any rock "
          "or test, as when a unit was mistaken; `validate` says it, too");
  s.param("negative_porosity", &ChecksConfig::negative_porosity)
      .fallback(true)
      .doc("warns when the particles have more volume than the specimen, as when diameters are given for radii");
  s.param("deep_overlap", &ChecksConfig::deep_overlap)
      .above(0)
      .fallback(0.2)
      .doc("bonded pairs that overlap by more than this share of the sum of their radii are deep ones; 1: none is");
  s.param("wide_gap", &ChecksConfig::wide_gap)
      .above(0)
      .fallback(1.0)
      .doc(
          "bonds across gaps of more than this many times the sum of the two radii are wide ones; very large: none is");
  s.param("bond_share", &ChecksConfig::bond_share)
      .at_least(0)
      .at_most(1)
      .fallback(0.1)
      .doc("warns when more than this share of the bonds have deep overlaps, or wide gaps; 1: never");
  s.param("unbonded_share", &ChecksConfig::unbonded_share)
      .at_least(0)
      .at_most(1)
      .fallback(0.05)
      .doc("warns when more than this share of the particles have no bond to the largest bonded piece; 1: never");
  s.param("stray_growth", &ChecksConfig::stray_growth)
      .at_least(0)
      .fallback(0.02)
      .doc(
          "warns when particles without a bond to that piece make the specimen longer, in any direction, by more than "
          "this share of its length; very large: never");
  s.param("time_step_ratio", &ChecksConfig::time_step_ratio)
      .at_least(1)
      .fallback(3.0)
      .doc(
          "warns when one particle, or at most 1 % of them, makes the time step more than this many times shorter than "
          "it were without them; very large: never");
  s.param("wall_overlap", &ChecksConfig::wall_overlap)
      .above(0)
      .fallback(0.3)
      .doc("warns when a particle stands deeper in a wall than this share of its radius; very large: never");
  s.param("pair_overlap", &ChecksConfig::pair_overlap)
      .above(0)
      .fallback(0.5)
      .doc(
          "warns when two particles without an intact bond are pressed into each other by more than this share of the "
          "sum of their radii; 1: never");
  s.param("wall_speed", &ChecksConfig::wall_speed)
      .above(0)
      .fallback(0.01)
      .doc(
          "warns when a wall, or a particle that the test leads, moves faster than this share of the speed of waves in "
          "the bonded specimen; very large: never");
  s.param("unbalanced_force", &ChecksConfig::unbalanced_force)
      .above(0)
      .fallback(0.2)
      .doc(
          "warns when the unbalanced force ratio (mean resultant on a particle over mean contact force) exceeds this "
          "while the load rises from 10 to 90 % of its peak: the test is not quasi-static; very large: never");
  s.param("flown_off", &ChecksConfig::flown_off)
      .above(0)
      .fallback(1.0)
      .doc("warns when particles end farther outside the specimen than this many times its length; very large: never");
}

}  // namespace breccia
