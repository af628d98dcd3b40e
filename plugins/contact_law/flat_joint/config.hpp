// SPDX-License-Identifier: BSD-3-Clause
/// What a workflow says of the law.
#pragma once

#include <numbers>

#include "breccia/contact_law.hpp"

namespace breccia::flat_joint {

/// Into how many elements an interface is divided. It decides how much history a pair has, hence the type of the law.
enum class Elements { line_2, line_4, line_8, disc_1x3, disc_1x4, disc_2x4 };

struct Config {
  Elements elements;
  std::optional<double> bond_modulus, normal_stiffness;
  double stiffness_ratio, radius_multiplier;
  double tensile_strength, cohesion, internal_friction_angle, friction;
  double bonded_share, gapped_share, gap, lot;
};

inline void check_shares(const Config& c, Issues& issues) {
  if (c.bonded_share + c.gapped_share > 1 + 1e-12)
    issues.push_back({"gapped_share", "with `bonded_share` makes more than 100 %; what is left of that are slits"});
  if (c.gapped_share > 0 && c.gap == 0)
    issues.push_back({"gap", "must be above zero where contacts are gapped (`gapped_share`)"});
}

inline void describe(Schema<Config>& s) {
  s.summary(
       "Flat joint: an interface of elements that fail one by one and go on carrying pressure, friction and moments")
      .source("Potyondy (2012), ISRM ARMS7, Seoul; Potyondy (2018), A flat-jointed bonded-particle model for rock")
      .details(
          "Two notional faces of radius R = lambda min(r_i, r_j) (discs: a line 2 R long) meet half-way. Each of their "
          "elements has the stress sigma = k_n g of the gap g at its centroid, faces being rigid, and a shear spring "
          "k_s. Bonded, it breaks when sigma >= sigma_t (tension) or |tau| >= c - sigma tan(phi) (shear). Unbonded, "
          "sigma <= 0 and |tau| <= mu |sigma|. Forces and moments are the sums. k_n = E/(r_i + r_j) per area. When no "
          "element is bonded and the faces have parted by their diameter, and between particles never bonded, a point "
          "contact of k_n A, k_s A and mu is left.");
  s.exactly_one_of({"bond_modulus", "normal_stiffness"});
  s.param("elements", &Config::elements)
      .choice("line_2", Elements::line_2, "discs: 2 along the line")
      .choice("line_4", Elements::line_4, "discs: 4")
      .choice("line_8", Elements::line_8, "discs: 8")
      .choice("disc_1x3", Elements::disc_1x3, "spheres: 3 sectors")
      .choice("disc_1x4", Elements::disc_1x4, "spheres: 4 sectors")
      .choice("disc_2x4", Elements::disc_2x4, "spheres: 2 rings of 4")
      .doc("of equal area into which an interface is divided; in two dimensions one of the lines")
      .source("fj_nr, fj_nal")
      .fallback("disc_1x4");
  s.param("bond_modulus", &Config::bond_modulus)
      .unit("Pa")
      .above(0)
      .example("10 GPa")
      .doc("E of the material between the centres: k_n = E/(r_i + r_j), bonded or not")
      .source("fj_emod");
  s.param("normal_stiffness", &Config::normal_stiffness)
      .unit("Pa/m")
      .above(0)
      .example("5 TPa/m")
      .doc("k_n, stress per gap, the same for all contacts")
      .source("fj_kn");
  s.param("stiffness_ratio", &Config::stiffness_ratio)
      .above(0)
      .example("2.5")
      .doc("normal over shear stiffness, k_n/k_s")
      .source("fj_krat");
  s.param("radius_multiplier", &Config::radius_multiplier)
      .above(0)
      .at_most(1)
      .fallback(1.0)
      .doc("lambda, radius of the faces over the smaller particle's")
      .source("fj_rmul");
  s.param("tensile_strength", &Config::tensile_strength)
      .unit("Pa")
      .above(0)
      .example("40 MPa")
      .doc("sigma_t of a bonded element")
      .source("fj_ten");
  s.param("cohesion", &Config::cohesion)
      .unit("Pa")
      .above(0)
      .example("80 MPa")
      .doc("c of a bonded element")
      .source("fj_coh");
  s.param("internal_friction_angle", &Config::internal_friction_angle)
      .unit("rad")
      .at_least(0)
      .below(0.5 * std::numbers::pi)
      .fallback(0.0)
      .doc("phi, by which pressure raises the shear strength of a bonded element")
      .source("fj_fa");
  s.param("friction", &Config::friction)
      .at_least(0)
      .example("0.5")
      .doc("Coulomb coefficient of unbonded elements and of point contacts")
      .source("fj_fric");
  s.param("bonded_share", &Config::bonded_share)
      .at_least(0)
      .at_most(1)
      .fallback(1.0)
      .doc("of the contacts that are made with the specimen; their elements are all bonded");
  s.param("gapped_share", &Config::gapped_share)
      .at_least(0)
      .at_most(1)
      .fallback(0.0)
      .doc("of them that are unbonded and apart by `gap`; the rest are slits: unbonded, faces meeting");
  s.param("gap", &Config::gap)
      .unit("m")
      .at_least(0)
      .fallback(0.0)
      .doc("between the faces of gapped contacts")
      .source("fj_gap0");
  s.param("lot", &Config::lot)
      .at_least(0)
      .at_most(1)
      .doc(
          "what a contact draws to learn whether it is bonded (up to `bonded_share`), gapped (up to both shares) or a "
          "slit; a number instead of the distribution makes all contacts alike")
      .fallback(Json{{"mean", 0.5}, {"distribution", "uniform"}, {"standard_deviation", 0.28867513459481287}});
  s.mark_per_bond("lot");
  s.check(check_shares);
}

}  // namespace breccia::flat_joint
