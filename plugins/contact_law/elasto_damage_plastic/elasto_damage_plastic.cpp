// SPDX-License-Identifier: BSD-3-Clause
/// Bonds that soften linearly in tension and shear and harden plastically in compression; Coulomb friction afterwards.
/// Source: Oñate, Zárate, Miquel, Santasusana, Celigueta, Arrufat, Gandikota, Valiullin, Ring (2015), A local
/// constitutive model for the discrete element method, Comput. Part. Mech. 2, 301-314, sections 5, 7 and 8.
#include <numbers>

#include "config.hpp"
#include "hardening.hpp"

namespace breccia::elasto_damage_plastic {

struct Law {
  using Config = elasto_damage_plastic::Config;
  static void describe(Schema<Config>& s) { elasto_damage_plastic::describe(s); }

  struct State {
    double spring_x, spring_y, spring_z, tension_damage, shear_damage, plastic_strain, viscous_force, regime;
  };
  static constexpr std::array columns{StateColumn<State>{&State::spring_x, "shear_spring_x", "m"},
                                      StateColumn<State>{&State::spring_y, "shear_spring_y", "m"},
                                      StateColumn<State>{&State::spring_z, "shear_spring_z", "m"},
                                      StateColumn<State>{&State::tension_damage, "tension_damage", "1"},
                                      StateColumn<State>{&State::shear_damage, "shear_damage", "1"},
                                      StateColumn<State>{&State::plastic_strain, "plastic_strain", "1"},
                                      StateColumn<State>{&State::viscous_force, "viscous_force", "N"},
                                      StateColumn<State>{&State::regime, "regime", "1"}};
  static constexpr bool needs_mass = true;
  static constexpr bool respects_protection = true;
  static constexpr auto per_bond() {
    return std::array{PerBond<Law>{"tensile_strength", &Law::inverse_limit_strain, true},
                      PerBond<Law>{"shear_strength", &Law::shear_strength}};
  }

  Law(const Config& c, const Assembly& assembly)
      : area_factor(c.area_factor ? *c.area_factor : optimal_area_factor(assembly)),
        area_square(assembly.dimension == 2 ? 0.0 : area_factor * std::numbers::pi),
        area_linear(assembly.dimension == 2 ? area_factor * 2 * assembly.thickness : 0.0),
        modulus(c.youngs_modulus),
        shear_ratio(0.5 / (1 + c.poisson_ratio)),
        damping(2 * c.contact_damping),
        inverse_limit_strain(c.youngs_modulus / c.tensile_strength),
        shear_strength(c.shear_strength),
        internal_friction(c.internal_friction),
        friction(c.friction),
        soft_n(c.softening_tension),
        soft_s(c.softening_shear),
        inverse_soft_n(1 / c.softening_tension),
        inverse_soft_s(1 / c.softening_shear),
        coupling(c.failure == Failure::coupled ? 1.0 : 0.0) {
    if (c.compressive_limits) hardening = Hardening(modulus, *c.compressive_limits, *c.compressive_slope_ratios);
  }

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0, 0, 0, 0, 0, 0}; }

  /// Divisions are most of the cost of a vector loop, so they are few: one denominator serves several quotients.
  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double inverse_rest = 1 / c.rest_length, area = contact_area(c);
    const double ea = modulus * area, kn = ea * inverse_rest, ks = kn * shear_ratio;
    const bool intact = c.intact > 0.5, damageable = c.breakable > 0.5;

    const double strain = (c.distance - c.rest_length) * inverse_rest;
    const double reached = hardening.plastic_strain(-strain);
    const double plastic = reached > s.plastic_strain ? reached : s.plastic_strain;
    const double elastic = strain + plastic, pulled = elastic > 0 ? elastic : 0.0,
                 pressed = elastic < 0 ? -elastic * ea : 0.0;

    const PlaneVector old = follow_plane(c, s.spring_x, s.spring_y, s.spring_z);
    const double ux = old.x + c.shear_x, uy = old.y + c.shear_y, uz = old.z + c.shear_z;
    const double spring = std::sqrt(ux * ux + uy * uy + uz * uz), trial = ks * spring;
    const double strength_s = shear_strength * area + internal_friction * pressed;
    const double over_zero = trial > 1e-100 ? trial : 1.0, inverse_s = 1 / (strength_s * over_zero);

    // Displacement over that at the strength; coupled, the two add up to the distance from the joint failure line.
    const double share_n = pulled * inverse_limit_strain, share_s = trial * over_zero * inverse_s;
    const double load_n = share_n + coupling * share_s, load_s = share_s + coupling * share_n;
    const double dn = grown(s.tension_damage, (load_n - 1) * inverse_soft_n, damageable);
    const double ds = grown(s.shear_damage, (load_s - 1) * inverse_soft_s, damageable);
    const bool holds = intact & (dn < 1) & (ds < 1), broke = intact & !holds;
    const double over_n = 1 + soft_n * dn, over_s = 1 + soft_s * ds;
    const double beyond_n = load_n > 1 ? load_n : 1.0, beyond_s = load_s > 1 ? load_s : 1.0;
    const double over = over_n * over_s, beyond = beyond_n * beyond_s, inverse = 1 / (over * beyond);
    const double keep_n = (1 - dn) * over_s * beyond * inverse, keep_s = (1 - ds) * over_n * beyond * inverse;

    const double limit = friction * pressed;
    const CoulombSlip slip = coulomb_slip(ks, spring, old.x * ux + old.y * uy + old.z * uz, limit, !intact);
    // A bond breaks in shear when its force has come down to zero: friction takes up from there.
    const double keep = broke ? 0.0 : slip.keep;
    s.spring_x = keep * ux;
    s.spring_y = keep * uy;
    s.spring_z = keep * uz;
    const double shear_stiffness = holds ? keep_s * ks : ks;

    const double grip = elastic < 0 ? 1.0 : holds ? keep_n : 0.0;  // a gap has neither spring nor dashpot
    const double spring_force = grip * ea * elastic;
    const double both = spring_force + grip * dashpot(c, inverse_rest, kn) * c.normal_velocity;
    const double normal = holds | (both < 0) ? both : 0.0;  // without a bond the dashpot cannot pull
    const double viscous = normal - spring_force;

    ContactForce f;
    f.normal = normal;
    f.shear_x = shear_stiffness * s.spring_x;
    f.shear_y = shear_stiffness * s.spring_y;
    f.shear_z = shear_stiffness * s.spring_z;
    f.breaks = broke ? failure_mode(share_n, share_s, dn) : 0.0;
    // The triangle below peak and softening line, as far as the damage has gone, whatever the size of the step; and
    // what the direction that did not fail still holds when the bond goes.
    const double grown_n = dn - s.tension_damage, grown_s = ds - s.shear_damage;
    const double peak_n = pulled * beyond_s * over * inverse, peak_s = spring * beyond_n * over * inverse;
    const double softened =
        (1 + soft_n) * ea * c.rest_length * peak_n * peak_n * grown_n + (1 + soft_s) * ks * peak_s * peak_s * grown_s;
    const double left = keep_n * ea * c.rest_length * pulled * pulled + keep_s * ks * spring * spring;
    f.fracture_energy = 0.5 * (softened + (broke ? left : 0.0));
    f.friction_work = slip.work;
    f.contact_work =
        area * c.rest_length * (hardening.plastic_work(plastic) - hardening.plastic_work(s.plastic_strain)) +
        0.5 * (s.viscous_force + viscous) * c.normal_velocity * c.time_step;  // leapfrog's own work: the mean of two
    s.regime = (grown_n > 0 ? 1.0 : 0.0) + (grown_s > 0 ? 2.0 : 0.0) + (plastic > s.plastic_strain ? 4.0 : 0.0) +
               (slip.slides ? 8.0 : 0.0);
    s.tension_damage = dn;
    s.shear_damage = ds;
    s.plastic_strain = plastic;
    s.viscous_force = viscous;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    const double ea = modulus * contact_area(c), ks = ea / c.rest_length * shear_ratio;
    const bool intact = c.intact > 0.5;
    const double elastic = (c.distance - c.rest_length) / c.rest_length + s.plastic_strain;
    const double grip = elastic < 0 ? 1.0 : intact ? secant(s.tension_damage, soft_n) : 0.0;
    const double shear = ks * (intact ? secant(s.shear_damage, soft_s) : 1.0);
    const double spring2 = s.spring_x * s.spring_x + s.spring_y * s.spring_y + s.spring_z * s.spring_z;
    return 0.5 * (grip * ea * c.rest_length * elastic * elastic + shear * spring2);
  }

  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double area = contact_area(c), kn = modulus * area / c.rest_length;
    return {kn, kn * shear_ratio, 0, 0, dashpot(c, 1 / c.rest_length, kn)};
  }

  Results derived() const { return {{"area_factor", area_factor}}; }

 private:
  BRECCIA_KERNEL double contact_area(const Contact& c) const {
    const double r = c.radius_i < c.radius_j ? c.radius_i : c.radius_j;
    return area_square * r * r + area_linear * r;
  }
  /// C_n of Eq. 30 [N s/m].
  BRECCIA_KERNEL double dashpot(const Contact& c, double inverse_rest, double kn) const {
    const double r = c.radius_i < c.radius_j ? c.radius_i : c.radius_j, area_over_r = area_square * r + area_linear;
    return damping * area_over_r * inverse_rest * std::sqrt(c.reduced_mass * kn);
  }
  BRECCIA_KERNEL static double grown(double damage, double reached, bool damageable) {
    const double at_most = reached < 1 ? reached : 1.0;
    return damageable & (at_most > damage) ? at_most : damage;
  }
  /// Stiffness of the secant over the initial one.
  BRECCIA_KERNEL static double secant(double damage, double softening) {
    return (1 - damage) / (1 + softening * damage);
  }

  BRECCIA_KERNEL double failure_mode(double share_n, double share_s, double dn) const {
    const bool tension = (dn >= 1) & (share_n > 0), mixed = tension & (coupling * share_s > 0);
    return mixed     ? double(BondState::broken_combined)
           : tension ? double(BondState::broken_tension)
                     : double(BondState::broken_shear);
  }

  static double optimal_area_factor(const Assembly& a) {
    if (a.dimension == 2)
      throw UserError(
          "contact_law elasto_damage_plastic: give `area_factor`; its default 40 P/N_c is made for spheres, not for "
          "discs");
    if (!(a.coordination_number > 0))
      throw UserError(
          "contact_law elasto_damage_plastic: the area factor 40 P/N_c cannot be had, no bond was made; give "
          "`area_factor`, or bond more neighbours");
    if (!(a.porosity > 0))
      throw UserError(
          "contact_law elasto_damage_plastic: the area factor 40 P/N_c cannot be had, the spheres overlap so much "
          "that the porosity P is not above zero; give `area_factor`");
    return 40 * a.porosity / a.coordination_number;
  }

  double area_factor;               // alpha [1]
  double area_square, area_linear;  // alpha A = area_square r^2 + area_linear r; one of them is zero [1], [m]
  double modulus, shear_ratio;      // E [Pa], K_s/K_n
  double damping;                   // 2 xi [1]
  double inverse_limit_strain, shear_strength, internal_friction, friction;  // E/sigma_t, tau [Pa], mu1, mu2
  double soft_n, soft_s, inverse_soft_n, inverse_soft_s, coupling;           // delta_n, delta_s; 1 when coupled, else 0
  Hardening hardening;
};

}  // namespace breccia::elasto_damage_plastic

BRECCIA_CONTACT_LAW(breccia::elasto_damage_plastic::Law, "elasto_damage_plastic")
