// SPDX-License-Identifier: BSD-3-Clause
/// Bonds of cement that soften in tension and bending up to a fracture energy; Coulomb friction afterwards.
/// Sources: Ma, Huang (2018), Int. J. Rock Mech. Min. Sci. 104, 9-19 (linear softening in tension); Jiang, Shen, Wang
/// (2015), Comput. Geotech. 65, 147-163; Potyondy, Cundall (2004), Eqs. 13-17 (stresses at the rim). README.md has the
/// equations.
#include "../../shared/bond_section.hpp"
#include "../../shared/bond_turning.hpp"
#include "config.hpp"

namespace breccia::soft_bond {

struct Law {
  using Config = soft_bond::Config;
  static void describe(Schema<Config>& s) { soft_bond::describe(s); }

  struct State {
    double shear_x, shear_y, shear_z, bending_x, bending_y, bending_z, twist, damage;
  };
  static constexpr std::array columns{StateColumn<State>{&State::shear_x, "shear_spring_x", "m"},
                                      StateColumn<State>{&State::shear_y, "shear_spring_y", "m"},
                                      StateColumn<State>{&State::shear_z, "shear_spring_z", "m"},
                                      StateColumn<State>{&State::bending_x, "bending_x", "rad"},
                                      StateColumn<State>{&State::bending_y, "bending_y", "rad"},
                                      StateColumn<State>{&State::bending_z, "bending_z", "rad"},
                                      StateColumn<State>{&State::twist, "twist", "rad"},
                                      StateColumn<State>{&State::damage, "damage", "1"}};
  static constexpr bool has_moments = true;
  static constexpr bool respects_protection = true;
  static constexpr auto per_bond() {
    return std::array{PerBond<Law>{"tensile_strength", &Law::tensile_strength},
                      PerBond<Law>{"tensile_strength", &Law::final_opening, true},
                      PerBond<Law>{"fracture_energy", &Law::final_opening}, PerBond<Law>{"cohesion", &Law::cohesion}};
  }

  Law(const Config& c, const Assembly& a)
      : section(c.radius_multiplier, a),
        modulus(c.bond_modulus.value_or(0)),
        stiffness_per_area(c.normal_stiffness.value_or(0)),
        inverse_ratio(1 / c.stiffness_ratio),
        tensile_strength(c.tensile_strength),
        final_opening(2 * c.fracture_energy.value_or(0) / c.tensile_strength),
        final_stretch(c.softening_factor ? 1 + *c.softening_factor : 0),
        cohesion(c.cohesion),
        internal_friction(std::tan(c.internal_friction_angle)),
        friction(c.friction),
        contribution(c.moment_contribution) {
    if (c.fracture_energy && c.bond_modulus) refuse_snap_back(c, a);
  }

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0, 0, 0, 0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const BondSection::Of at = section.between(c.radius_i, c.radius_j);
    const double normal = per_area(c), shear = normal * inverse_ratio;
    const double kn = normal * at.area, ks = shear * at.area, km = normal * at.bending, kt = shear * at.torsion;
    const bool was = c.intact > 0.5, breakable = c.breakable > 0.5;

    const double opened = c.distance - c.rest_length, opened_before = opened - c.normal_velocity * c.time_step;
    const PlaneVector slid = follow_plane(c, s.shear_x, s.shear_y, s.shear_z);
    const double x = slid.x + c.shear_x, y = slid.y + c.shear_y, z = slid.z + c.shear_z;
    const BondTurning turning = bond_turning(c, s);
    const PlaneVector bent = turning.before;
    const double bx = turning.now.x, by = turning.now.y, bz = turning.now.z, twist = turning.twist;

    // The opening at the rim, over that at the strength, says how far the bond has softened.
    const double rim = contribution * at.radius, softening = softening_of(normal);
    const double opening = opened + rim * std::sqrt(bx * bx + by * by + bz * bz);
    const double reached = (opening * normal / tensile_strength - 1) / (softening + 1e-300);  // brittle: 0 or all
    const double at_most = reached < 1 ? reached : 1.0;
    const double damage = breakable & (at_most > s.damage) ? at_most : s.damage;
    const double left_before = secant(s.damage, softening), left = secant(damage, softening);
    const bool tension = breakable & (damage >= 1);

    const double size = std::sqrt(x * x + y * y + z * z), along = slid.x * x + slid.y * y + slid.z * z;
    const double sheared_stress = left * shear * (size + rim * section.twists() * std::abs(twist));
    const double mean_stress = normal * opened * (opened > 0 ? left : 1.0);
    const bool sheared =
        breakable & !tension & (sheared_stress > (1 - damage) * cohesion - internal_friction * mean_stress);
    const bool broke = tension | sheared, holds = was & !broke;

    // A bond that has softened leaves the contact what force it had, within what friction allows.
    const double pressed = opened < 0 ? kn * opened : 0.0;
    const double passed = was ? left_before : 1.0;
    const CoulombSlip slip = coulomb_slip(ks, passed * size, passed * passed * along, friction * -pressed, !holds);
    const double keep = holds ? 1.0 : passed * slip.keep, hold = holds ? 1.0 : 0.0;
    s.shear_x = keep * x;
    s.shear_y = keep * y;
    s.shear_z = keep * z;
    s.bending_x = hold * bx;
    s.bending_y = hold * by;
    s.bending_z = hold * bz;
    s.twist = hold * twist;
    s.damage = was ? (holds ? damage : 1.0) : s.damage;

    const double grip = holds ? left : 0.0, shear_grip = holds ? left : 1.0, twisting = grip * kt * s.twist;
    ContactForce f;
    f.normal = opened > 0 ? grip * kn * opened : pressed;
    f.shear_x = shear_grip * ks * s.shear_x;
    f.shear_y = shear_grip * ks * s.shear_y;
    f.shear_z = shear_grip * ks * s.shear_z;
    f.moment_x = grip * km * s.bending_x + twisting * c.nx;
    f.moment_y = grip * km * s.bending_y + twisting * c.ny;
    f.moment_z = grip * km * s.bending_z + twisting * c.nz;
    f.breaks = tension ? double(BondState::broken_tension) : sheared ? double(BondState::broken_shear) : 0.0;
    // A spring that loses stiffness in a step loses half of that times its lengths before and after, by the work that
    // leapfrog has done on it: the way times the mean of the forces. Over a whole softening this adds up to the area
    // below the curve. The shear spring of a broken bond is cut back besides, which is a slide.
    const double lost = (was ? left_before : 0.0) - grip;
    const double pulled = (opened > 0 ? opened : 0.0) * (opened_before > 0 ? opened_before : 0.0);
    const double cut = holds ? (left_before - left) * along : (passed - keep) * along + keep * (1 - keep) * size * size;
    const double fractured =
        lost * (kn * pulled + km * (bent.x * bx + bent.y * by + bent.z * bz) + kt * turning.twist_before * twist) +
        ks * cut;
    f.fracture_energy = was ? 0.5 * fractured : 0.0;
    f.friction_work = was ? 0.0 : slip.work;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    const BondSection::Of at = section.between(c.radius_i, c.radius_j);
    const double normal = per_area(c), shear = normal * inverse_ratio;
    const bool intact = c.intact > 0.5;
    const double left = secant(s.damage, softening_of(normal)), grip = intact ? left : 0.0;
    const double opened = c.distance - c.rest_length;
    const double shear2 = s.shear_x * s.shear_x + s.shear_y * s.shear_y + s.shear_z * s.shear_z;
    const double bending2 = s.bending_x * s.bending_x + s.bending_y * s.bending_y + s.bending_z * s.bending_z;
    return 0.5 * (normal * (at.area * opened * opened * (opened > 0 ? grip : 1.0) + grip * at.bending * bending2) +
                  shear * (at.area * shear2 * (intact ? left : 1.0) + grip * at.torsion * s.twist * s.twist));
  }

  /// Of a bond without damage, and of the contact that is left of it.
  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const BondSection::Of at = section.between(c.radius_i, c.radius_j);
    const double normal = per_area(c), shear = normal * inverse_ratio, hold = c.intact > 0.5 ? 1.0 : 0.0;
    return {normal * at.area, shear * at.area, hold * normal * at.bending, hold * shear * at.torsion};
  }

 private:
  BRECCIA_KERNEL double per_area(const Contact& c) const {
    return stiffness_per_area + modulus / (c.radius_i + c.radius_j);
  }
  /// w_f/w_c - 1; a bond that drew so high a strength that its fracture energy is spent before it is brittle.
  BRECCIA_KERNEL double softening_of(double normal) const {
    const double beyond = final_opening * normal / tensile_strength + final_stretch - 1;
    return beyond > 0 ? beyond : 0.0;
  }
  /// Stiffness of the secant over the initial one.
  BRECCIA_KERNEL static double secant(double damage, double softening) {
    return (1 - damage) / (1 + softening * damage);
  }

  static void refuse_snap_back(const Config& c, const Assembly& a) {
    double longest = 0;
    for (std::size_t k = 0; k < a.bond_i.size(); ++k)
      longest = std::max(longest, a.radius[a.bond_i[k]] + a.radius[a.bond_j[k]]);
    longest = a.max(longest);
    if (!(longest > 0)) return;
    const double least = stored_at_strength(c, *c.bond_modulus / longest);
    if (*c.fracture_energy < least)
      throw UserError("contact_law soft_bond: fracture_energy: " +
                      too_little(*c.fracture_energy, least, "the bond of the two largest"));
  }

  BondSection section;
  double modulus, stiffness_per_area, inverse_ratio;  // E [Pa] or k_n [Pa/m]: the other is 0; k_s/k_n
  double tensile_strength;                            // sigma_t [Pa]
  double final_opening, final_stretch;                // w_f [m], or w_f/w_c: the other is 0
  double cohesion, internal_friction, friction;       // c [Pa], tan(phi), mu
  double contribution;                                // beta
};

}  // namespace breccia::soft_bond

BRECCIA_CONTACT_LAW(breccia::soft_bond::Law, "soft_bond")
