// SPDX-License-Identifier: BSD-3-Clause
/// Moment that resists rolling (and twisting) of particles that are pressed together, to be added to other laws.
/// Source: Iwashita, Oda (1998), J. Eng. Mech. 124, 285-292; Ai, Chen, Rotter, Ooi (2011), Powder Technology 206,
/// 269-282 (type C, elastic-plastic spring with dashpot).
#include "breccia/contact_law.hpp"

namespace breccia {

struct RollingResistance {
  struct Config {
    double rolling_friction, twisting_friction, rolling_modulus, rolling_damping;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Rolling and twisting resistance of pressed contacts; adds to the laws before it")
        .source(
            "Iwashita, Oda (1998), J. Eng. Mech. 124, 285-292; Ai, Chen, Rotter, Ooi (2011), Powder Technology 206, "
            "269-282, type C")
        .details(
            "Rolling: a spring M = k theta about the relative rotation in the contact plane that slides at mu_r R "
            "|F|, with the push F of the laws before it and R = r_i r_j/(r_i + r_j). Twisting: the same about the "
            "normal with mu_t. k = E_r R^3 (in two dimensions E_r R^2 t). While rolling does not slide a dashpot "
            "resists it, too, with c = 2 eta sqrt(I k), I the reduced moment of inertia of the two about the "
            "contact point. Bonds in tension and particles apart feel none of it.");
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
    s.param("rolling_damping", &Config::rolling_damping)
        .at_least(0)
        .at_most(1)
        .fallback(0.0)
        .doc("share of the critical damping of the rolling spring, eta; acts while that does not slide")
        .source("eta_r, Ai et al. (2011), type C with f = 0");
  }

  struct State {
    double roll_x, roll_y, roll_z, twist;    // [rad]
    double viscous_x, viscous_y, viscous_z;  // moment of the dashpot in the step before [N m]
  };
  static constexpr std::array columns{StateColumn<State>{&State::roll_x, "roll_x", "rad"},
                                      StateColumn<State>{&State::roll_y, "roll_y", "rad"},
                                      StateColumn<State>{&State::roll_z, "roll_z", "rad"},
                                      StateColumn<State>{&State::twist, "twist", "rad"},
                                      StateColumn<State>{&State::viscous_x, "viscous_x", "N m"},
                                      StateColumn<State>{&State::viscous_y, "viscous_y", "N m"},
                                      StateColumn<State>{&State::viscous_z, "viscous_z", "N m"}};
  static constexpr bool has_moments = true, makes_bonds = false, needs_mass = true, respects_protection = true;

  RollingResistance(const Config& c, const Assembly& a)
      : rolling_friction(c.rolling_friction),
        twisting_friction(c.twisting_friction),
        modulus(c.rolling_modulus),
        breadth(a.dimension == 2 ? a.thickness : 0),
        damping(2 * c.rolling_damping),
        stated(of_the_time_step(c.rolling_damping)) {}

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0, 0, 0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double radius = mean_radius(c), k = spring(radius);
    const double push = c.normal_force < 0 ? -c.normal_force * radius : 0.0;
    const PlaneVector old = follow_plane(c, s.roll_x, s.roll_y, s.roll_z);
    const double turned = c.turn_x * c.nx + c.turn_y * c.ny + c.turn_z * c.nz;
    const double rx = c.turn_x - turned * c.nx, ry = c.turn_y - turned * c.ny, rz = c.turn_z - turned * c.nz;
    const double x = old.x + rx, y = old.y + ry, z = old.z + rz, twist = s.twist + turned;
    const CoulombSlip rolls =
        coulomb_slip(k, std::sqrt(x * x + y * y + z * z), old.x * x + old.y * y + old.z * z, rolling_friction * push);
    const CoulombSlip twists = coulomb_slip(k, std::abs(twist), s.twist * twist, twisting_friction * push);
    s.roll_x = rolls.keep * x;
    s.roll_y = rolls.keep * y;
    s.roll_z = rolls.keep * z;
    s.twist = twists.keep * twist;
    const double critical = damping * std::sqrt(inertia(c) * k) / c.time_step, rate = rolls.slides ? 0.0 : critical;
    const double dx = rate * rx, dy = rate * ry, dz = rate * rz;
    ContactForce f;
    f.moment_x = k * (s.roll_x + s.twist * c.nx) + dx;
    f.moment_y = k * (s.roll_y + s.twist * c.ny) + dy;
    f.moment_z = k * (s.roll_z + s.twist * c.nz) + dz;
    f.friction_work = rolls.work + twists.work;
    const PlaneVector before = follow_plane(c, s.viscous_x, s.viscous_y, s.viscous_z);
    f.contact_work = 0.5 * ((before.x + dx) * rx + (before.y + dy) * ry + (before.z + dz) * rz);
    s.viscous_x = dx;
    s.viscous_y = dy;
    s.viscous_z = dz;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    return 0.5 * spring(mean_radius(c)) *
           (s.roll_x * s.roll_x + s.roll_y * s.roll_y + s.roll_z * s.roll_z + s.twist * s.twist);
  }

  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double k = spring(mean_radius(c));
    ContactStiffness total;
    total.bending = rolling_friction > 0 ? stated * k : 0.0;
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

  /// Reduced moment of inertia of the two about the contact point, I_i + m_i r_i^2 each, of two grains of one density.
  BRECCIA_KERNEL double inertia(const Contact& c) const {
    const double ratio = c.radius_i / c.radius_j, of_masses = ratio * ratio * (breadth > 0 ? 1.0 : ratio);
    const double i = c.reduced_mass * (1 + of_masses) * c.radius_i * c.radius_i,
                 j = c.reduced_mass * (1 + 1 / of_masses) * c.radius_j * c.radius_j;
    return (breadth > 0 ? 1.5 : 1.4) * i * j / (i + j);
  }
  /// What the spring is stated as, over what it is, so that the time step holds for the dashpot: `ContactStiffness` has
  /// no place for one that turns. A step dt is stable while dt^2/2 n k + dt n c < I_a, of a particle with n such
  /// neighbours that are held; c = 2 eta sqrt(I k) with I < 1.75 I_a (equal spheres; discs 1.5) and n = 12, as dense
  /// packings have at most: x^-2 + 2 b/x = 1 for the root x of the factor, 2 b = 2 eta sqrt(2 n I/I_a). Few small ones
  /// (I < 3.5 I_a) between large ones have fewer than half as many neighbours.
  static double of_the_time_step(double eta) {
    const double b = eta * std::sqrt(2 * 12 * 1.75), x = b + std::sqrt(b * b + 1);
    return x * x;
  }

  double rolling_friction, twisting_friction, modulus, breadth;  // [1], [1], [Pa], thickness of discs, or 0 [m]
  double damping, stated;                                        // 2 eta, factor on the spring for the time step
};

}  // namespace breccia

BRECCIA_CONTACT_LAW(breccia::RollingResistance, "rolling_resistance")
