// SPDX-License-Identifier: BSD-3-Clause
/// Moment that resists rolling (and twisting) of particles that are pressed together, to be added to other laws.
/// Source: Iwashita, Oda (1998), J. Eng. Mech. 124, 285-292; Ai, Chen, Rotter, Ooi (2011), Powder Technology 206,
/// 269-282 (type C, elastic-plastic spring without viscous part).
#include "breccia/contact_law.hpp"

namespace breccia {

struct RollingResistance {
  struct Config {
    double rolling_friction, twisting_friction, rolling_modulus;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Rolling and twisting resistance of pressed contacts; adds to the laws before it")
        .source(
            "Iwashita, Oda (1998), J. Eng. Mech. 124, 285-292; Ai, Chen, Rotter, Ooi (2011), Powder Technology 206, "
            "269-282, type C")
        .details(
            "Rolling: a spring M = k theta about the relative rotation in the contact plane that slides at mu_r R |F|, "
            "with the push F of the laws before it and R = r_i r_j/(r_i + r_j). Twisting: the same about the normal "
            "with mu_t. k = E_r R^3 (in two dimensions E_r R^2 t). Bonds in tension and particles apart feel none of "
            "it.");
    s.param("rolling_friction", &Config::rolling_friction)
        .at_least(0)
        .example("0.1")
        .doc("coefficient of rolling friction, mu_r");
    s.param("twisting_friction", &Config::twisting_friction)
        .at_least(0)
        .fallback(0.0)
        .doc("coefficient of twisting friction, mu_t; no discs in a plane twist");
    s.param("rolling_modulus", &Config::rolling_modulus)
        .unit("Pa")
        .above(0)
        .example("10 GPa")
        .doc("E_r, of the spring before it slides");
  }

  struct State {
    double roll_x, roll_y, roll_z, twist;  // [rad]
  };
  static constexpr std::array columns{
      StateColumn<State>{&State::roll_x, "roll_x", "rad"}, StateColumn<State>{&State::roll_y, "roll_y", "rad"},
      StateColumn<State>{&State::roll_z, "roll_z", "rad"}, StateColumn<State>{&State::twist, "twist", "rad"}};
  static constexpr bool has_moments = true, makes_bonds = false, respects_protection = true;

  RollingResistance(const Config& c, const Assembly& a)
      : rolling_friction(c.rolling_friction),
        twisting_friction(c.twisting_friction),
        modulus(c.rolling_modulus),
        breadth(a.dimension == 2 ? a.thickness : 0) {}

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double radius = mean_radius(c), k = spring(radius);
    const double push = c.normal_force < 0 ? -c.normal_force * radius : 0.0;
    const PlaneVector old = follow_plane(c, s.roll_x, s.roll_y, s.roll_z);
    const double turned = c.turn_x * c.nx + c.turn_y * c.ny + c.turn_z * c.nz;
    const double x = old.x + (c.turn_x - turned * c.nx), y = old.y + (c.turn_y - turned * c.ny),
                 z = old.z + (c.turn_z - turned * c.nz), twist = s.twist + turned;
    const CoulombSlip rolls =
        coulomb_slip(k, std::sqrt(x * x + y * y + z * z), old.x * x + old.y * y + old.z * z, rolling_friction * push);
    const CoulombSlip twists = coulomb_slip(k, std::abs(twist), s.twist * twist, twisting_friction * push);
    s.roll_x = rolls.keep * x;
    s.roll_y = rolls.keep * y;
    s.roll_z = rolls.keep * z;
    s.twist = twists.keep * twist;
    ContactForce f;
    f.moment_x = k * (s.roll_x + s.twist * c.nx);
    f.moment_y = k * (s.roll_y + s.twist * c.ny);
    f.moment_z = k * (s.roll_z + s.twist * c.nz);
    f.friction_work = rolls.work + twists.work;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    return 0.5 * spring(mean_radius(c)) *
           (s.roll_x * s.roll_x + s.roll_y * s.roll_y + s.roll_z * s.roll_z + s.twist * s.twist);
  }

  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double k = spring(mean_radius(c));
    ContactStiffness total;
    total.bending = rolling_friction > 0 ? k : 0.0;
    total.torsion = twisting_friction > 0 ? k : 0.0;
    return total;
  }

 private:
  BRECCIA_KERNEL double mean_radius(const Contact& c) const {
    return c.radius_i * c.radius_j / (c.radius_i + c.radius_j);
  }
  BRECCIA_KERNEL double spring(double radius) const {
    return modulus * radius * radius * (breadth > 0 ? breadth : radius);
  }

  double rolling_friction, twisting_friction, modulus, breadth;  // [1], [1], [Pa], thickness of discs, or 0 [m]
};

}  // namespace breccia

BRECCIA_CONTACT_LAW(breccia::RollingResistance, "rolling_resistance")
