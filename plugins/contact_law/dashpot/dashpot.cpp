// SPDX-License-Identifier: BSD-3-Clause
/// Viscous forces between particles, to be added to a law that has the springs.
/// Source: Cundall, Strack (1979), Geotechnique 29, 47-65 (dashpots at contacts, as shares of the critical damping).
#include "breccia/contact_law.hpp"

namespace breccia {

struct Dashpot {
  struct Config {
    double normal_ratio, shear_ratio, stiffness_modulus;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Dashpots along and across the normal; adds to the laws before it")
        .source("Cundall, Strack (1979), Geotechnique 29, 47-65")
        .details(
            "f_n = c_n v_n and f_s = c_s v_s with the velocities of the second particle relative to the first at the "
            "contact point, c = 2 beta sqrt(k m), m the reduced mass and k = E (r_i + r_j), in two dimensions E t: the "
            "stiffness that `elastic_brittle` has for the same modulus. Acts on intact bonds and on particles that are "
            "pressed together by the laws before it, where it cannot turn their push into a pull. Forces are those of "
            "the velocity half a step ago.");
    s.param("normal_ratio", &Config::normal_ratio)
        .at_least(0)
        .below(1)
        .example("0.1")
        .doc("share of the critical damping along the normal, beta_n");
    s.param("shear_ratio", &Config::shear_ratio)
        .at_least(0)
        .below(1)
        .fallback(0.0)
        .doc("the same across the normal, beta_s");
    s.param("stiffness_modulus", &Config::stiffness_modulus)
        .unit("Pa")
        .above(0)
        .example("10 GPa")
        .doc("modulus E of the stiffness that the shares refer to: that of the bonds");
  }

  struct State {
    double normal, shear_x, shear_y, shear_z;  // viscous force of the step before [N]
  };
  static constexpr std::array columns{StateColumn<State>{&State::normal, "viscous_normal", "N"},
                                      StateColumn<State>{&State::shear_x, "viscous_shear_x", "N"},
                                      StateColumn<State>{&State::shear_y, "viscous_shear_y", "N"},
                                      StateColumn<State>{&State::shear_z, "viscous_shear_z", "N"}};
  static constexpr bool makes_bonds = false, needs_mass = true, respects_protection = true;

  Dashpot(const Config& c, const Assembly& a) : normal_ratio(c.normal_ratio), shear_ratio(c.shear_ratio) {
    const bool discs = a.dimension == 2;
    stiffness_of_pair = discs ? c.stiffness_modulus * a.thickness : 0;
    stiffness_of_radii = discs ? 0 : c.stiffness_modulus;
  }

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double critical = critical_damping(c), inverse_dt = 1 / c.time_step;
    const bool bonded = c.intact > 0.5, acts = bonded | (c.normal_force < 0);
    const double cn = acts ? normal_ratio * critical : 0.0, cs = acts ? shear_ratio * critical : 0.0;
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
    k.damping = critical * normal_ratio;
    k.shear_damping = critical * shear_ratio;
    return k;
  }

 private:
  BRECCIA_KERNEL double critical_damping(const Contact& c) const {
    const double k = stiffness_of_pair + stiffness_of_radii * (c.radius_i + c.radius_j);
    return 2 * std::sqrt(k * c.reduced_mass);
  }

  double normal_ratio, shear_ratio, stiffness_of_pair = 0, stiffness_of_radii = 0;
};

}  // namespace breccia

BRECCIA_CONTACT_LAW(breccia::Dashpot, "dashpot")
