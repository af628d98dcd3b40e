// SPDX-License-Identifier: BSD-3-Clause
/// What a workflow says of the law.
#pragma once

#include <cstdio>
#include <numbers>

#include "breccia/contact_law.hpp"

namespace breccia::soft_bond {

struct Config {
  std::optional<double> bond_modulus, normal_stiffness;
  double stiffness_ratio, tensile_strength;
  std::optional<double> fracture_energy, softening_factor;
  double cohesion, internal_friction_angle, friction, radius_multiplier, moment_contribution;
};

/// What a bond of this stiffness per area has stored per area when it reaches its strength [J/m2].
inline double stored_at_strength(const Config& c, double stiffness) {
  return 0.5 * c.tensile_strength * c.tensile_strength / stiffness;
}
inline std::string energy_text(double energy) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g J/m2", energy);
  return text;
}
/// Why a fracture energy is too little. With less than what is stored the force would have to fall while the bond gets
/// shorter, which a path of growing length cannot follow.
inline std::string too_little(double given, double least, const std::string& of) {
  return energy_text(given) + " is too little: " + of + " stores " + energy_text(least) +
         " up to its strength; give more than that, or a `softening_factor` (0: brittle)";
}

inline void check_softening(const Config& c, Issues& issues) {
  if (!c.fracture_energy || !c.normal_stiffness) return;  // what radii decide is looked at when they are known
  const double least = stored_at_strength(c, *c.normal_stiffness);
  if (*c.fracture_energy < least)
    issues.push_back({"fracture_energy", too_little(*c.fracture_energy, least, "a bond")});
}

inline void describe(Schema<Config>& s) {
  s.summary("Bonds of cement whose tension falls linearly to zero, with a fracture energy; Coulomb friction afterwards")
      .source(
          "Ma, Huang (2018), Int. J. Rock Mech. Min. Sci. 104, 9-19 (softening); Jiang, Shen, Wang (2015), Comput. "
          "Geotech. 65, 147-163 (bond with moments); Potyondy, Cundall (2004), Eqs. 13-17 (section)")
      .details(
          "A disc of radius lambda min(r_i, r_j), in two dimensions a strip, of springs k_n and k_s per area. Its "
          "opening at the rim is w = u_n + beta R_b |theta_b|. Beyond w_c = sigma_t/k_n the stress falls linearly to "
          "zero at w_f = 2 G_f/sigma_t (or (1 + softening_factor) w_c): one damage, which never heals, lowers tension, "
          "bending, shear and twisting along the secant; pressure is carried whole. It breaks in shear at once when "
          "|tau| > (1 - D) c - sigma tan(phi). Broken, or never bonded: no tension, no moment, |F_s| <= mu |F_n|.");
  s.exactly_one_of({"bond_modulus", "normal_stiffness"});
  s.exactly_one_of({"fracture_energy", "softening_factor"});
  s.param("bond_modulus", &Config::bond_modulus)
      .unit("Pa")
      .above(0)
      .example("20 GPa")
      .doc("E of the cement: k_n = E/(r_i + r_j)");
  s.param("normal_stiffness", &Config::normal_stiffness)
      .unit("Pa/m")
      .above(0)
      .example("20e12 Pa/m")
      .doc("k_n, per area, the same for all bonds");
  s.param("stiffness_ratio", &Config::stiffness_ratio)
      .above(0)
      .example("2.5")
      .doc("normal over shear stiffness, k_n/k_s");
  s.param("tensile_strength", &Config::tensile_strength)
      .unit("Pa")
      .above(0)
      .example("10 MPa")
      .doc("largest normal stress, at the rim, sigma_t");
  s.param("fracture_energy", &Config::fracture_energy)
      .unit("J/m2")
      .above(0)
      .example("50 J/m2")
      .doc("G_f, of a bond that is pulled apart: the area below its stress over its opening")
      .source("Ma & Huang (2018), there by the slope");
  s.param("softening_factor", &Config::softening_factor)
      .at_least(0)
      .example("5")
      .doc("opening over which the stress falls to zero, over that at the strength; 0: brittle")
      .source("Ma & Huang (2018)");
  s.param("cohesion", &Config::cohesion)
      .unit("Pa")
      .above(0)
      .example("20 MPa")
      .doc("largest shear stress, at the rim, of a bond without normal force, c");
  s.param("internal_friction_angle", &Config::internal_friction_angle)
      .unit("rad")
      .at_least(0)
      .below(0.5 * std::numbers::pi)
      .fallback(0.0)
      .doc("phi, by which pressure raises the shear strength, and tension lowers it");
  s.param("friction", &Config::friction)
      .at_least(0)
      .example("0.5")
      .doc("Coulomb coefficient of broken and never bonded contacts, mu");
  s.param("radius_multiplier", &Config::radius_multiplier)
      .above(0)
      .fallback(1.0)
      .doc("radius of the disc over the smaller of the two, lambda");
  s.param("moment_contribution", &Config::moment_contribution)
      .at_least(0)
      .at_most(1)
      .fallback(1.0)
      .doc("share of bending and twisting in what softens and breaks, beta");
  s.check(check_softening);
}

}  // namespace breccia::soft_bond
