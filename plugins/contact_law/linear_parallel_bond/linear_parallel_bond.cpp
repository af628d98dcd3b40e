// SPDX-License-Identifier: BSD-3-Clause
/// Cement between two grains: a disc of elastic springs that carries force and moment, and breaks as a whole. It stands
/// beside the law of the grains themselves.
/// Source: Potyondy, Cundall (2004), Int. J. Rock Mech. Min. Sci. 41, 1329-1364, Eqs. 13-17; README.md has them.
#include <numbers>

#include "../../shared/bond_section.hpp"
#include "../../shared/spring_bond.hpp"

namespace breccia {

struct LinearParallelBond {
  struct Config {
    std::optional<double> bond_modulus, normal_stiffness;
    double stiffness_ratio, tensile_strength, cohesion, internal_friction_angle, radius_multiplier, moment_contribution;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Parallel bond: a disc of cement that carries force and moment; adds to the contact of the grains")
        .source("Potyondy, Cundall (2004), Int. J. Rock Mech. Min. Sci. 41, 1329-1364, Eqs. 13-17")
        .details(
            "A disc of radius R_b = lambda min(r_i, r_j), in two dimensions a strip 2 R_b broad and as thick as the "
            "specimen, of springs k_n and k_s per area. F_n = k_n A u_n, F_s = k_s A u_s, M = k_n I theta_b, M_t = k_s "
            "J theta_t. It breaks in tension when F_n/A + beta |M| R_b/I > sigma_t, in shear when |F_s|/A + beta |M_t| "
            "R_b/J > c - F_n/A tan(phi). A broken bond carries nothing: the grains' contact is a law of its own that "
            "stands before this one in the list.");
    s.exactly_one_of({"bond_modulus", "normal_stiffness"});
    s.param("bond_modulus", &Config::bond_modulus)
        .unit("Pa")
        .above(0)
        .example("62 GPa")
        .doc("E of the cement: k_n = E/(r_i + r_j)")
        .source("E_c of the parallel bond, section 3.1");
    s.param("normal_stiffness", &Config::normal_stiffness)
        .unit("Pa/m")
        .above(0)
        .example("60e12 Pa/m")
        .doc("k_n, per area, the same for all bonds");
    s.param("stiffness_ratio", &Config::stiffness_ratio)
        .above(0)
        .example("2.5")
        .doc("normal over shear stiffness, k_n/k_s");
    s.param("tensile_strength", &Config::tensile_strength)
        .unit("Pa")
        .above(0)
        .example("157 MPa")
        .doc("largest normal stress, at the rim")
        .source("Eq. 17");
    s.param("cohesion", &Config::cohesion)
        .unit("Pa")
        .above(0)
        .example("157 MPa")
        .doc("largest shear stress, at the rim, of a bond without normal force, c")
        .source("Eq. 17: the shear strength");
    s.param("internal_friction_angle", &Config::internal_friction_angle)
        .unit("rad")
        .at_least(0)
        .below(0.5 * std::numbers::pi)
        .fallback(0.0)
        .doc("phi, by which pressure raises the shear strength; 0 is the law of 2004");
    s.param("radius_multiplier", &Config::radius_multiplier)
        .above(0)
        .fallback(1.0)
        .doc("radius of the disc over the smaller of the two, lambda");
    s.param("moment_contribution", &Config::moment_contribution)
        .at_least(0)
        .at_most(1)
        .fallback(1.0)
        .doc("share of bending and twisting in the stresses that break, beta; 1 is the law of 2004");
  }

  using State = SpringBond;
  static constexpr auto columns = spring_bond_columns;
  static constexpr bool has_moments = true, respects_protection = true;
  static constexpr auto per_bond() {
    return std::array{PerBond<LinearParallelBond>{"tensile_strength", &LinearParallelBond::tensile_strength},
                      PerBond<LinearParallelBond>{"cohesion", &LinearParallelBond::cohesion}};
  }

  LinearParallelBond(const Config& c, const Assembly& a)
      : section(c.radius_multiplier, a),
        modulus(c.bond_modulus.value_or(0)),
        stiffness_per_area(c.normal_stiffness.value_or(0)),
        inverse_ratio(1 / c.stiffness_ratio),
        tensile_strength(c.tensile_strength),
        cohesion(c.cohesion),
        friction(std::tan(c.internal_friction_angle)),
        contribution(c.moment_contribution) {}

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0, 0, 0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const Cement at = cement(c);
    const bool was = c.intact > 0.5, breakable = c.breakable > 0.5;
    const SpringMotion m = spring_motion(c, s, {c.shear_x, c.shear_y, c.shear_z});
    const PlaneVector &x = m.across, &b = m.turning.now;

    // The springs at the rim: M R/I = k_n theta R, M_t R/J = k_s theta_t R.
    const double rim = contribution * at.section.radius, mean = at.normal * m.opened;
    const double pull = mean + rim * at.normal * std::sqrt(b.x * b.x + b.y * b.y + b.z * b.z);
    const double shear =
        at.shear * (std::sqrt(x.x * x.x + x.y * x.y + x.z * x.z) + rim * section.twists() * std::abs(m.turning.twist));
    const bool tension = breakable & (pull > tensile_strength);
    const bool sheared = breakable & !tension & (shear > cohesion - friction * mean);
    const bool broke = tension | sheared;

    const ContactStiffness k = springs(at);
    ContactForce f = spring_force(c, k, m, was & !broke ? 1.0 : 0.0, s);
    f.breaks = tension ? double(BondState::broken_tension) : sheared ? double(BondState::broken_shear) : 0.0;
    f.fracture_energy = broke ? spring_loss(k, m) : 0.0;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    return spring_energy(c, springs(cement(c)), s);
  }

  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const ContactStiffness k = springs(cement(c));
    const double hold = c.intact > 0.5 ? 1.0 : 0.0;
    return {hold * k.normal, hold * k.shear, hold * k.bending, hold * k.torsion};
  }

 private:
  struct Cement {
    BondSection::Of section;
    double normal, shear;  ///< k_n, k_s [Pa/m]
  };
  BRECCIA_KERNEL Cement cement(const Contact& c) const {
    Cement at;
    at.section = section.between(c.radius_i, c.radius_j);
    at.normal = stiffness_per_area + modulus / (c.radius_i + c.radius_j);
    at.shear = at.normal * inverse_ratio;
    return at;
  }
  BRECCIA_KERNEL static ContactStiffness springs(const Cement& at) {
    return {at.normal * at.section.area, at.shear * at.section.area, at.normal * at.section.bending,
            at.shear * at.section.torsion};
  }

  BondSection section;
  double modulus, stiffness_per_area, inverse_ratio;  // E [Pa] or k_n [Pa/m]: the other is 0; k_s/k_n
  double tensile_strength, cohesion, friction;        // [Pa], [Pa], tan(phi)
  double contribution;                                // beta
};

}  // namespace breccia

BRECCIA_CONTACT_LAW(breccia::LinearParallelBond, "linear_parallel_bond")
