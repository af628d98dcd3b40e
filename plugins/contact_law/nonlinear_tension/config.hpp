// SPDX-License-Identifier: BSD-3-Clause
/// What a workflow says of the law.
#pragma once

#include <numbers>

#include "breccia/contact_law.hpp"

namespace breccia::nonlinear_tension {

/// Which radius of a pair its k_n goes with, and whose k_n its k_m.
enum class StiffnessRadius { none, smaller, harmonic, mean };
enum class BendingOf { bond, table };

struct Config {
  std::optional<double> normal_stiffness, bond_modulus;
  StiffnessRadius stiffness_radius;
  BendingOf bending_of;
  double shear_stiffness_ratio;
  std::optional<double> bending_stiffness, bending_ratio, reference_radius, torsion_ratio;
  double tensile_strain_limit, tension_shape, bond_width;
  double shear_strain_ratio, shear_strain_cap_ratio, internal_friction_angle, friction_angle;
};

inline void check_reference(const Config& c, Issues& issues) {
  if (c.reference_radius && !c.bending_ratio && c.stiffness_radius == StiffnessRadius::none)
    issues.push_back(
        {"reference_radius", "belongs to `bending_ratio` and `stiffness_radius`; `bending_stiffness` does not use it"});
}

inline void check_reading(const Config& c, Issues& issues) {
  if (c.stiffness_radius != StiffnessRadius::none && !c.normal_stiffness)
    issues.push_back({"stiffness_radius",
                      "belongs to `normal_stiffness`: with `bond_modulus` a bond is already as stiff as the smaller "
                      "particle is wide; leave one of the two out"});
  if (c.bending_of == BendingOf::bond) return;
  if (!c.bending_ratio)
    issues.push_back(
        {"bending_of", "belongs to `bending_ratio`: `bending_stiffness` is the same for all bonds anyhow"});
  else if (!c.normal_stiffness)
    issues.push_back({"bending_of",
                      "`table` needs `normal_stiffness`: with `bond_modulus` there is no k_n that all bonds share; "
                      "write `bond`"});
}

inline void check_cap(const Config& c, Issues& issues) {
  if (c.shear_strain_cap_ratio < c.shear_strain_ratio)
    issues.push_back({"shear_strain_cap_ratio",
                      "must not be below `shear_strain_ratio`: the upper bound would lie "
                      "below the limit in pure shear"});
}

inline void describe(Schema<Config>& s) {
  s.summary("NET-BPM: exponential tension, bending, strain limits that know of the bond's width, Coulomb friction")
      .source(
          "Ouyang, Yang & Chen (2017), Appl. Sci. 7(7), 686, Eqs. 1-9, in two dimensions; the form for spheres is "
          "derived in the law's README")
      .details(
          "e_n = (d - d0)/d0. F_n = k_n b e_n0 (1 - exp(-e_n/(b e_n0))) in tension, k_n e_n in compression; F_s = k_s "
          "e_s; M = k_m theta, theta the rotation of one particle relative to the other across the line of centres; "
          "spheres also resist twisting. A bond breaks in tension when e_n + a theta > e_n0 with a = w r_min/(r_i + "
          "r_j), in shear when e_s + a |twist| > min(e_s0 - e_n tan(phi), e_smax). Afterwards, or never bonded: F_n = "
          "k_n e_n <= 0 from the length min(d0, r_i + r_j), |F_s| <= tan(phi_f) |F_n|, no moment. In two dimensions "
          "stiffnesses are those of 1 m thickness. `stiffness_radius` and `bending_of` are readings of the paper's "
          "tables that the paper does not print.");
  s.exactly_one_of({"normal_stiffness", "bond_modulus"});
  s.exactly_one_of({"bending_stiffness", "bending_ratio"});
  s.param("normal_stiffness", &Config::normal_stiffness)
      .unit("N")
      .above(0)
      .example("30 MN")
      .doc("force per unit of strain, of all bonds or as `stiffness_radius` says; in two dimensions for 1 m thickness")
      .source("k_n, Table 2");
  s.param("stiffness_radius", &Config::stiffness_radius)
      .choice("none", StiffnessRadius::none, "all bonds have `normal_stiffness`, as the paper prints it")
      .choice("smaller", StiffnessRadius::smaller, "x is the smaller radius of the pair")
      .choice("harmonic", StiffnessRadius::harmonic, "x is the harmonic mean of the two, 2 r_i r_j/(r_i + r_j)")
      .choice("mean", StiffnessRadius::mean, "x is the arithmetic mean of the two")
      .fallback("none")
      .doc(
          "`normal_stiffness` times x/R, R the reference radius: a bond of larger particles is stiffer; not in the "
          "paper");
  s.param("bond_modulus", &Config::bond_modulus)
      .unit("Pa")
      .above(0)
      .example("28 GPa")
      .doc(
          "modulus of the bar that stands for a bond: k_n = modulus times 2 r_min thickness (discs), 4 r_min^2 "
          "(spheres), r_min the smaller radius; not in the paper");
  s.param("shear_stiffness_ratio", &Config::shear_stiffness_ratio)
      .above(0)
      .example("0.5")
      .doc("shear over normal stiffness")
      .source("k_s/k_n, Table 2");
  s.param("bending_stiffness", &Config::bending_stiffness)
      .unit("N m/rad")
      .at_least(0)
      .example("6.9 kN m/rad")
      .doc("moment per relative rotation, the same for all bonds; in two dimensions for 1 m thickness")
      .source("k_m, Eq. 2");
  s.param("bending_ratio", &Config::bending_ratio)
      .at_least(0)
      .example("0.256")
      .doc("bending stiffness over k_n times the reference radius")
      .source("k_m/(k_n R), Table 2");
  s.param("bending_of", &Config::bending_of)
      .choice("bond", BendingOf::bond, "the bond's own k_n")
      .choice("table", BendingOf::table, "`normal_stiffness`: all bonds have the same bending stiffness")
      .fallback("bond")
      .doc("the k_n of `bending_ratio`; makes a difference only with `stiffness_radius`");
  s.param("reference_radius", &Config::reference_radius)
      .unit("m")
      .above(0)
      .example("0.9 mm")
      .doc("R of `bending_ratio` and `stiffness_radius`; if absent the largest radius of the specimen")
      .source("section 2.3: R = R_max");
  s.param("torsion_ratio", &Config::torsion_ratio)
      .at_least(0)
      .example("1")
      .doc(
          "torsional over bending stiffness; if absent 2 k_s/k_n, which follows from the same beams; discs do not "
          "twist");
  s.param("tensile_strain_limit", &Config::tensile_strain_limit)
      .above(0)
      .example("4e-3")
      .doc("strain at which a bond breaks in pure tension")
      .source("e_n0, Table 2");
  s.param("tension_shape", &Config::tension_shape)
      .above(0)
      .example("0.2")
      .doc("of the curve of tension: small values bend it early, large ones make it straight")
      .source("b, Eq. 3, Fig. 2");
  s.param("bond_width", &Config::bond_width)
      .at_least(0)
      .at_most(1)
      .example("0.8")
      .doc("half width (radius, between spheres) of the bond over the smaller radius")
      .source("w, Fig. 3");
  s.param("shear_strain_ratio", &Config::shear_strain_ratio)
      .above(0)
      .example("3.5")
      .doc("strain at which a bond breaks in pure shear, over the tensile one")
      .source("e_s0/e_n0, Table 2");
  s.param("shear_strain_cap_ratio", &Config::shear_strain_cap_ratio)
      .above(0)
      .example("10")
      .doc("upper bound of the shear strain under pressure, over the tensile limit")
      .source("e_smax/e_n0, Table 2");
  s.param("internal_friction_angle", &Config::internal_friction_angle)
      .unit("rad")
      .at_least(0)
      .below(0.5 * std::numbers::pi)
      .example("45 deg")
      .doc("by which compression raises the shear limit")
      .source("phi, Fig. 4");
  s.param("friction_angle", &Config::friction_angle)
      .unit("rad")
      .at_least(0)
      .below(0.5 * std::numbers::pi)
      .example("39 deg")
      .doc("of broken and never bonded contacts")
      .source("phi_f, Table 2");
  s.check(check_reference).check(check_reading).check(check_cap);
}

}  // namespace breccia::nonlinear_tension
