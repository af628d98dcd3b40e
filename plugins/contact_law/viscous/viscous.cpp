// SPDX-License-Identifier: BSD-3-Clause
/// Viscous forces between particles, to be added to a law that has the springs.
/// Source: Cundall, Strack (1979), Geotechnique 29, 47-65 (dashpots at contacts, as shares of the critical damping).
#include "../../shared/effective_modulus.hpp"

namespace breccia {

struct Viscous {
  struct Config {
    std::optional<double> normal_ratio, shear_ratio, normal_damping, shear_damping;
    std::optional<double> stiffness_modulus, contact_modulus, normal_stiffness;
    double stiffness_ratio;
  };

  /// What the shares are shares of.
  static void check_reference(const Config& c, Issues& issues) {
    const bool shares = c.normal_ratio || c.shear_ratio,
               refers = c.stiffness_modulus || c.contact_modulus || c.normal_stiffness;
    const char* name = c.stiffness_modulus ? "stiffness_modulus"
                       : c.contact_modulus ? "contact_modulus"
                                           : "normal_stiffness";
    if (shares && !refers)
      issues.push_back(
          {c.normal_ratio ? "normal_ratio" : "shear_ratio",
           "is a share of the critical damping of a stiffness: add `stiffness_modulus`, `contact_modulus` or "
           "`normal_stiffness`, as the law with the springs has it"});
    if (refers && !shares)
      issues.push_back({name, "belongs to `normal_ratio` and `shear_ratio`; constants that are given do not use it"});
  }

  static void describe(Schema<Config>& s) {
    s.summary("Dashpots along and across the normal; adds to the laws before it")
        .source("Cundall, Strack (1979), Geotechnique 29, 47-65")
        .details(
            "f_n = c_n v_n and f_s = c_s v_s with the velocities of the second particle relative to the first at "
            "the contact point. c is given, or c = 2 beta sqrt(k m), m the reduced mass and k the stiffness of the "
            "law with the springs: k = E (r_i + r_j), in two dimensions E t, as `elastic_brittle` has it "
            "(`stiffness_modulus`), k = E A/(r_i + r_j) as `linear` has it (`contact_modulus`), or the same for all "
            "contacts (`normal_stiffness`). Acts on intact bonds and on particles that are pressed together by the "
            "laws before it, where it cannot turn their push into a pull. Forces are those of the velocity half a "
            "step ago.");
    s.exactly_one_of({"normal_damping", "normal_ratio"});
    s.at_most_one_of({"shear_ratio", "shear_damping"});
    s.at_most_one_of({"stiffness_modulus", "contact_modulus", "normal_stiffness"});
    s.param("normal_ratio", &Config::normal_ratio)
        .at_least(0)
        .below(1)
        .example("0.1")
        .doc("share of the critical damping along the normal, beta_n");
    s.param("shear_ratio", &Config::shear_ratio)
        .at_least(0)
        .below(1)
        .example("0.1")
        .doc("the same across the normal, beta_s; if absent, with `shear_damping`, none");
    s.param("normal_damping", &Config::normal_damping)
        .unit("N s/m")
        .at_least(0)
        .example("10 N s/m")
        .doc("c_n itself, the same for all contacts; in two dimensions that of the whole thickness");
    s.param("shear_damping", &Config::shear_damping)
        .unit("N s/m")
        .at_least(0)
        .example("10 N s/m")
        .doc("c_s itself, likewise");
    s.param("stiffness_modulus", &Config::stiffness_modulus)
        .unit("Pa")
        .above(0)
        .example("10 GPa")
        .doc("modulus E of the stiffness that the shares refer to: `bond_modulus` of `elastic_brittle`");
    s.param("contact_modulus", &Config::contact_modulus)
        .unit("Pa")
        .above(0)
        .example("10 GPa")
        .doc("the same of `linear`");
    s.param("normal_stiffness", &Config::normal_stiffness)
        .unit("N/m")
        .above(0)
        .example("10 MN/m")
        .doc("that stiffness itself, the same for all contacts");
    s.param("stiffness_ratio", &Config::stiffness_ratio)
        .above(0)
        .fallback(1.0)
        .doc("of the springs, normal over shear: what `shear_ratio` refers to; 1: to the normal stiffness, too");
    s.check(check_reference);
  }

  struct State {
    double normal, shear_x, shear_y, shear_z;  // viscous force of the step before [N]
  };
  static constexpr std::array columns{StateColumn<State>{&State::normal, "viscous_normal", "N"},
                                      StateColumn<State>{&State::shear_x, "viscous_shear_x", "N"},
                                      StateColumn<State>{&State::shear_y, "viscous_shear_y", "N"},
                                      StateColumn<State>{&State::shear_z, "viscous_shear_z", "N"}};
  static constexpr bool makes_bonds = false, needs_mass = true, respects_protection = true;

  Viscous(const Config& c, const Assembly& a)
      : bar(c.contact_modulus, c.normal_stiffness, a),
        normal_ratio(c.normal_ratio.value_or(0)),
        shear_ratio(c.shear_ratio.value_or(0) / std::sqrt(c.stiffness_ratio)),
        normal_damping(c.normal_damping.value_or(0)),
        shear_damping(c.shear_damping.value_or(0)) {
    const bool discs = a.dimension == 2;
    const double modulus = c.stiffness_modulus.value_or(0);
    stiffness_of_pair = discs ? modulus * a.thickness : 0;
    stiffness_of_radii = discs ? 0 : modulus;
  }

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double critical = critical_damping(c), inverse_dt = 1 / c.time_step;
    const bool bonded = c.intact > 0.5, acts = bonded | (c.normal_force < 0);
    const double cn = acts ? normal_damping + normal_ratio * critical : 0.0,
                 cs = acts ? shear_damping + shear_ratio * critical : 0.0;
    const double wanted = cn * c.normal_velocity, pull = c.normal_force + wanted;
    const double normal = bonded | (pull < 0) ? wanted : -c.normal_force;
    ContactForce f;
    f.normal = acts ? normal : 0.0;
    f.shear_x = cs * inverse_dt * c.shear_x;
    f.shear_y = cs * inverse_dt * c.shear_y;
    f.shear_z = cs * inverse_dt * c.shear_z;
    const PlaneVector old = follow_plane(c, s.shear_x, s.shear_y, s.shear_z);
    f.contact_work = 0.5 * ((s.normal + f.normal) * c.normal_velocity * c.time_step + (old.x + f.shear_x) * c.shear_x +
                            (old.y + f.shear_y) * c.shear_y + (old.z + f.shear_z) * c.shear_z);
    s.normal = f.normal;
    s.shear_x = f.shear_x;
    s.shear_y = f.shear_y;
    s.shear_z = f.shear_z;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact&, const State&) const { return 0; }

  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double critical = critical_damping(c);
    ContactStiffness k;
    k.damping = normal_damping + critical * normal_ratio;
    k.shear_damping = shear_damping + critical * shear_ratio;
    return k;
  }

 private:
  BRECCIA_KERNEL double critical_damping(const Contact& c) const {
    const double k = stiffness_of_pair + stiffness_of_radii * (c.radius_i + c.radius_j) + bar(c);
    return 2 * std::sqrt(k * c.reduced_mass);
  }

  EffectiveModulus bar;                                             // no more than one of these stiffnesses is set
  double normal_ratio, shear_ratio, normal_damping, shear_damping;  // [1], [N s/m]
  double stiffness_of_pair = 0, stiffness_of_radii = 0;
};

}  // namespace breccia

BRECCIA_CONTACT_LAW(breccia::Viscous, "viscous")
