// SPDX-License-Identifier: BSD-3-Clause
/// What a workflow says of the law.
#pragma once

#include "breccia/contact_law.hpp"

namespace breccia::elasto_damage_plastic {

enum class Failure { uncoupled, coupled };

struct Config {
  double youngs_modulus, poisson_ratio;
  std::optional<double> area_factor;
  double contact_damping;
  double tensile_strength, shear_strength, internal_friction, friction;
  double softening_tension, softening_shear;
  Failure failure;
  std::optional<std::vector<double>> compressive_limits, compressive_slope_ratios;
};

inline void check_compression(const Config& c, Issues& issues) {
  if (c.compressive_limits.has_value() != c.compressive_slope_ratios.has_value()) {
    issues.push_back({c.compressive_limits ? "compressive_limits" : "compressive_slope_ratios",
                      "`compressive_limits` and `compressive_slope_ratios` belong together: give both, or none for "
                      "compression without yield"});
    return;
  }
  if (!c.compressive_limits) return;
  double before = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double limit = (*c.compressive_limits)[k];
    if (!(limit > before))
      issues.push_back({"compressive_limits[" + std::to_string(k) + "]",
                        k == 0 ? "must be above 0 Pa" : "must be above the limit before it: LCS1 < LCS2 < LCS3"});
    before = limit;
  }
}

inline void check_failure(const Config& c, Issues& issues) {
  if (c.failure == Failure::coupled && c.softening_tension != c.softening_shear)
    issues.push_back({"softening_shear",
                      "must equal `softening_tension` when `failure` is `coupled`: one damage then "
                      "softens both directions"});
}

inline void describe(Schema<Config>& s) {
  s.summary("Damage with linear softening in tension and shear, hardening plasticity in compression, Coulomb friction")
      .source("Oñate et al. (2015), Comput. Part. Mech. 2, 301-314, sections 5, 7 and 8")
      .details(
          "K_n = E A/d0, K_s = K_n/(2(1+nu)) with A = alpha pi min(r_i, r_j)^2. Strengths sigma_t A in tension and "
          "tau_f A + mu1 |F_n| in shear; beyond them the force falls linearly to zero at (1 + delta) times the "
          "displacement of the peak, and unloads along the secant. Pressed: a stress-strain line of slopes E, E/YRC1, "
          "E/YRC2, E/YRC3 that bends at LCS1, LCS2, LCS3 and unloads with E. Fully damaged, or never bonded: no "
          "tension, |F_s| <= mu2 |F_n|. `regime` in the history adds up what the last step did: 1 damage grew in "
          "tension, 2 in shear, 4 plastic flow, 8 sliding; 0: none of these.");
  s.param("youngs_modulus", &Config::youngs_modulus)
      .unit("Pa")
      .above(0)
      .example("28 GPa")
      .doc("of the material")
      .source("E, Eq. 23");
  s.param("poisson_ratio", &Config::poisson_ratio)
      .above(-1)
      .at_most(0.5)
      .example("0.2")
      .doc("of the material; gives the shear stiffness")
      .source("nu, Eq. 36");
  s.param("area_factor", &Config::area_factor)
      .above(0)
      .example("1")
      .doc(
          "effective over geometrical area of a contact; if absent 40 P/N_c with the porosity P and the mean number "
          "of bonds per particle N_c of the specimen, in three dimensions only")
      .source("alpha, Eqs. 21-22");
  s.param("contact_damping", &Config::contact_damping)
      .at_least(0)
      .at_most(1)
      .fallback(0.9)
      .doc(
          "viscous damping of the normal motion, as a fraction of the critical one of Eq. 27; a larger one needs a "
          "shorter time step")
      .source("xi, Eqs. 27-30");
  s.param("tensile_strength", &Config::tensile_strength)
      .unit("Pa")
      .above(0)
      .example("5 MPa")
      .doc("stress at which damage in tension begins")
      .source("sigma_t^f, Eq. 42");
  s.param("shear_strength", &Config::shear_strength)
      .unit("Pa")
      .above(0)
      .example("16 MPa")
      .doc("stress at which damage in shear begins, without pressure")
      .source("tau^f, Eq. 42");
  s.param("internal_friction", &Config::internal_friction)
      .at_least(0)
      .example("0.9")
      .doc("growth of a bond's shear strength with the pressure on it")
      .source("mu1, Eq. 42");
  s.param("friction", &Config::friction)
      .at_least(0)
      .example("0.25")
      .doc("Coulomb coefficient of broken and never bonded contacts")
      .source("mu2, Eq. 45");
  s.param("softening_tension", &Config::softening_tension)
      .above(0)
      .example("0.2")
      .doc("displacement over which the tensile force falls to zero, over the displacement at the peak")
      .source("delta_n, Eq. 47");
  s.param("softening_shear", &Config::softening_shear)
      .above(0)
      .example("0.2")
      .doc("the same in shear")
      .source("delta_s, Eq. 47");
  s.param("failure", &Config::failure)
      .choice("uncoupled", Failure::uncoupled, "tension and shear are damaged each by itself")
      .choice("coupled", Failure::coupled,
              "under tension a straight line joins the two strengths, and one damage "
              "softens both directions")
      .doc("how tension and shear act together")
      .source("Fig. 7")
      .fallback("uncoupled");
  s.param("compressive_limits", &Config::compressive_limits)
      .unit("Pa")
      .items(3, 3)
      .example("[20 MPa, 45 MPa, 70 MPa]")
      .doc("stresses at which the compressive line bends; if absent compression does not yield")
      .source("LCS1, LCS2, LCS3, Fig. 10");
  s.param("compressive_slope_ratios", &Config::compressive_slope_ratios)
      .at_least(1)
      .items(3, 3)
      .example("[3, 12, 22]")
      .doc("E over the slope of the line beyond each of the limits; 1: it does not bend")
      .source("YRC1, YRC2, YRC3, Tables 3-6");
  s.check(check_compression).check(check_failure);
}

}  // namespace breccia::elasto_damage_plastic
