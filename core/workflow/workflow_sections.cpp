// SPDX-License-Identifier: BSD-3-Clause
// Sections of a workflow that are the core's own.
#include "workflow/workflow.hpp"

namespace breccia {

void PluginPath::describe(Schema<PluginPath>& s) {
  s.param("path", &PluginPath::path).doc("a plugin's shared library, or a folder of them");
}

void BondingConfig::describe(Schema<BondingConfig>& s) {
  s.param("tolerance", &BondingConfig::tolerance)
      .above(-1)
      .at_most(4)
      .example("0.1")
      .doc("bonds are made between all pairs whose centres are within (1 + tolerance) times the sum of their radii");
  s.param("gap", &BondingConfig::gap)
      .unit("m")
      .example("0.1 mm")
      .doc("bonds are made between all pairs whose surfaces are at most this far apart; below zero: that much overlap");
  s.param("coordination_number", &BondingConfig::coordination_number)
      .above(0)
      .at_most(60)
      .example("11.89")
      .doc(
          "mean number of bonds per particle, 2 bonds/particles: the tolerance (or gap) that gives it is found and "
          "reported");
  s.param("nearest_by", &BondingConfig::nearest_by)
      .choice("relative_gap", GapMeasure::relative, "gap over the sum of the radii: large particles reach farther")
      .choice("gap", GapMeasure::absolute,
              "distance of the surfaces: small particles get more bonds than by the relative gap")
      .fallback("relative_gap")
      .doc("with a coordination_number: by what the nearest pairs are chosen");
  s.exactly_one_of({"tolerance", "gap", "coordination_number"});
}

BondingRule BondingConfig::rule() const {
  if (coordination_number) return {nearest_by, std::nullopt, coordination_number};
  if (gap) return {GapMeasure::absolute, gap, std::nullopt};
  return {GapMeasure::relative, tolerance, std::nullopt};
}

void DampingConfig::describe(Schema<DampingConfig>& s) {
  s.param("translational", &DampingConfig::translational)
      .at_least(0)
      .below(1)
      .fallback(0.0)
      .doc("non-viscous damping: force -alpha |F| v/|v| on the undamped resultant F")
      .source("Rojek et al. (2012), Eq. 5");
  s.param("rotational", &DampingConfig::rotational)
      .at_least(0)
      .below(1)
      .fallback(0.0)
      .doc("the same for the torque")
      .source("Rojek et al. (2012), Eq. 6");
}

void EngineConfig::describe(Schema<EngineConfig>& s) {
  s.param("time_step", &EngineConfig::time_step)
      .choice("spectral", TimeStep::spectral,
              "of the fastest mode of all particles, contacts and walls together: the longest stable one")
      .choice("bound", TimeStep::bound,
              "of the stiffest single particle with its neighbours held: shorter, needs no estimate")
      .fallback("spectral")
      .doc("how the critical time step is found, from the linearised stiffness of the contacts");
  s.param("time_step_safety", &EngineConfig::time_step_safety)
      .above(0)
      .at_most(1)
      .fallback(0.8)
      .doc(
          "time step as a share of the critical one; with `spectral` and non-viscous damping alpha at most "
          "0.95/sqrt(1 + alpha), since damping stiffens the fastest mode");
  s.param("added_mass", &EngineConfig::added_mass)
      .at_least(0)
      .at_most(0.1)
      .fallback(0.0)
      .doc(
          "selective mass scaling, for quasi-static tests only: this share of the total mass is added to the particles "
          "that ask for the shortest time step");
  s.param("skin", &EngineConfig::skin)
      .above(0)
      .at_most(2)
      .fallback(0.3)
      .doc("neighbours this far apart (in mean radii) are followed; larger: longer lists, rebuilt less often");
  s.param("energy_error_warning", &EngineConfig::energy_error_warning)
      .above(0)
      .fallback(0.01)
      .doc("warns when this share of the work is unaccounted for in the energy balance");
  s.param("energy_error_limit", &EngineConfig::energy_error_limit)
      .above(0)
      .fallback(0.1)
      .doc(
          "ends the run when this share of the work is unaccounted for; of the largest of boundary work, stored and "
          "initial energy so far, and of no less than what a strain of 1e-4 would store in the bonds. Very large: "
          "never");
}

}  // namespace breccia
