// SPDX-License-Identifier: BSD-3-Clause
/// Linear elastic bonds that break in tension; Coulomb friction afterwards, and where there never was a bond.
/// Sources: name the paper and its equations here; README.md has the equations themselves.
#include "breccia/contact_law.hpp"

struct NewPluginName {
  /// What the workflow says, in SI units and within its range when it comes here.
  struct Config {
    double bond_modulus, stiffness_ratio, tensile_strength, friction;
  };

  /// One declaration for each parameter: messages, `breccia describe` and the editor's help are made from it.
  static void describe(breccia::Schema<Config>& s) {
    s.summary("Linear elastic bonds that break in tension, with Coulomb friction")
        .source("say where the law comes from")
        .details("A bond is a bar as broad as the two particles together: see README.md for the equations.");
    s.param("bond_modulus", &Config::bond_modulus).unit("Pa").above(0).example("10 GPa").doc("of the bar, E");
    s.param("stiffness_ratio", &Config::stiffness_ratio).above(0).fallback(3.0).doc("normal over shear stiffness");
    s.param("tensile_strength", &Config::tensile_strength).unit("Pa").above(0).example("40 MPa").doc("of the bar");
    s.param("friction", &Config::friction).at_least(0).fallback(0.5).doc("Coulomb coefficient, mu");
    // Rules between parameters: s.check([](const Config& c, breccia::Issues& issues) { ... });
  }

  /// The history of one pair, in doubles; each member stands in `columns`, or it is lost after the step.
  struct State {
    double spring_x, spring_y, spring_z;
  };
  static constexpr std::array columns{breccia::StateColumn<State>{&State::spring_x, "shear_spring_x", "m"},
                                      breccia::StateColumn<State>{&State::spring_y, "shear_spring_y", "m"},
                                      breccia::StateColumn<State>{&State::spring_z, "shear_spring_z", "m"}};

  /// Parameters of which each bond may draw its own value, with the constants below that are proportional to them.
  static constexpr auto per_bond() {
    return std::array{breccia::PerBond<NewPluginName>{"tensile_strength", &NewPluginName::tensile_strength}};
  }
  static constexpr bool respects_protection = true;  // it breaks only where `c.breakable` is 1
  // A law that fills moments says `has_moments = true`, one that only adds to others `makes_bonds = false`, one that
  // needs `c.reduced_mass` `needs_mass = true`.

  /// Constants are derived once, here; the loop over pairs sees nothing else.
  NewPluginName(const Config& c, const breccia::Assembly& assembly)
      : modulus(c.bond_modulus),
        inverse_ratio(1 / c.stiffness_ratio),
        tensile_strength(c.tensile_strength),
        friction(c.friction),
        thickness(assembly.dimension == 2 ? assembly.thickness : 0.0) {}

  /// The history of a pair that is new: a bond just made, or particles that have just come near.
  BRECCIA_KERNEL State initial(const breccia::Contact&) const { return {0, 0, 0}; }

  /// The force of one pair in one step. No `if`: both sides of ?: are computed, and the loop becomes vector code.
  BRECCIA_KERNEL breccia::ContactForce operator()(const breccia::Contact& c, State& s) const {
    const double kn = normal_stiffness(c), ks = kn * inverse_ratio;
    // The shear spring turns with the pair, then grows by this step's motion across the normal.
    const breccia::PlaneVector old = breccia::follow_plane(c, s.spring_x, s.spring_y, s.spring_z);
    const double x = old.x + c.shear_x, y = old.y + c.shear_y, z = old.z + c.shear_z;

    // Normal force: of the bond, or of particles that press on each other. Tension is positive.
    const double bonded = kn * (c.distance - c.rest_length);
    const double overlap = c.free_length() - c.distance;
    const double pressed = overlap > 0 ? -kn * overlap : 0.0;
    const bool breaks = (c.breakable > 0.5) & (bonded >= tensile_strength * section(c));
    const bool holds = (c.intact > 0.5) & !breaks;

    // Shear force: the spring slides where no bond holds it.
    const breccia::CoulombSlip slip = breccia::coulomb_slip(
        ks, std::sqrt(x * x + y * y + z * z), old.x * x + old.y * y + old.z * z, friction * -pressed, !holds);
    s = {slip.keep * x, slip.keep * y, slip.keep * z};

    breccia::ContactForce f;
    f.normal = holds ? bonded : pressed;
    f.shear_x = ks * s.spring_x;
    f.shear_y = ks * s.spring_y;
    f.shear_z = ks * s.spring_z;
    f.breaks = breaks ? double(breccia::BondState::broken_tension) : 0.0;
    // Where the energy went. A bond that breaks loses what it had stored, less the work that the force it lost did not
    // do in this step any more: half of that force times the way of the step.
    const double stored = 0.5 * bonded * (c.distance - c.rest_length) + 0.5 * pressed * overlap;
    const double not_done = 0.5 * (bonded - pressed) * c.normal_velocity * c.time_step;
    f.fracture_energy = breaks ? slip.work + stored - not_done : 0.0;
    f.friction_work = breaks ? 0.0 : slip.work;
    return f;
  }

  /// What the pair has stored and gives back [J]: the force above is its derivative.
  BRECCIA_KERNEL double energy(const breccia::Contact& c, const State& s) const {
    const double kn = normal_stiffness(c), overlap = c.free_length() - c.distance;
    const double pressed = overlap > 0 ? overlap : 0.0;
    const double stretch = c.intact > 0.5 ? c.distance - c.rest_length : pressed;
    const double spring = s.spring_x * s.spring_x + s.spring_y * s.spring_y + s.spring_z * s.spring_z;
    return 0.5 * kn * (stretch * stretch + inverse_ratio * spring);
  }

  /// The largest slope of the force, also where particles do not touch yet: it sets the time step.
  BRECCIA_KERNEL breccia::ContactStiffness stiffness(const breccia::Contact& c) const {
    const double kn = normal_stiffness(c);
    return {kn, kn * inverse_ratio, 0, 0};  // normal, shear, bending, torsion
  }

 private:
  // The bar is as long and as broad as r_i + r_j; as deep, too, or in two dimensions as the discs are thick.
  BRECCIA_KERNEL double depth(const breccia::Contact& c) const { return thickness > 0 ? thickness : c.touching(); }
  BRECCIA_KERNEL double section(const breccia::Contact& c) const { return c.touching() * depth(c); }      // [m2]
  BRECCIA_KERNEL double normal_stiffness(const breccia::Contact& c) const { return modulus * depth(c); }  // [N/m]

  double modulus, inverse_ratio, tensile_strength, friction;  // [Pa], [1], [Pa], [1]
  double thickness;                                           // of discs; 0: spheres [m]
};

BRECCIA_CONTACT_LAW(NewPluginName, "new_plugin_name")
