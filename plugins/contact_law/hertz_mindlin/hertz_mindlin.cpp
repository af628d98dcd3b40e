// SPDX-License-Identifier: BSD-3-Clause
/// Elastic spheres: Hertz's normal contact, Mindlin's tangential stiffness, Coulomb friction, and a dashpot that makes
/// the coefficient of restitution of a normal impact the one that was asked for.
/// Sources: Johnson (1985), Contact Mechanics, chapters 4 and 7; Tsuji, Tanaka, Ishida (1992), Powder Technology 71,
/// 239-250 (dashpot); Thornton, Cummins, Cleary (2013), Powder Technology 233, 30-46 (tangential force when the normal
/// force changes); README.md has the equations and what is this law's own.
#include "breccia/contact_law.hpp"
#include "restitution.hpp"

namespace breccia {

struct HertzMindlin {
  struct Config {
    double youngs_modulus, poisson_ratio, friction, restitution, design_overlap;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Hertz-Mindlin contact of elastic spheres with Coulomb friction and restitution; makes no bonds")
        .source(
            "Johnson (1985), chapters 4 and 7; Tsuji, Tanaka, Ishida (1992), Powder Technology 71, 239-250; Thornton, "
            "Cummins, Cleary (2013), Powder Technology 233, 30-46")
        .details(
            "F_n = -4/3 E* sqrt(R*) u^(3/2) with the overlap u; the tangential force grows by K_s du_s, K_s = 8 G* "
            "sqrt(R* u), shrinks with K_s when the overlap does, and is limited to mu |F_n|. Dashpots c = 2 "
            "sqrt(5/6) beta sqrt(S m) along the normal (S = 2 E* sqrt(R* u)) and, while the contact sticks, across "
            "it (S = K_s); the pair never pulls, and beta is such that a normal impact then has the coefficient of "
            "restitution e. For spheres: discs in two dimensions have no such law.");
    s.param("youngs_modulus", &Config::youngs_modulus).unit("Pa").above(0).example("70 GPa").doc("of the grains, E");
    s.param("poisson_ratio", &Config::poisson_ratio).above(-1).at_most(0.5).example("0.2").doc("of the grains, nu");
    s.param("friction", &Config::friction).at_least(0).example("0.5").doc("Coulomb coefficient, mu");
    s.param("restitution", &Config::restitution)
        .at_least(hertz_mindlin::least_restitution)
        .at_most(1)
        .example("0.9")
        .doc("coefficient of restitution of a normal impact, e; 1: elastic, no dashpots");
    s.param("design_overlap", &Config::design_overlap)
        .above(0)
        .below(1)
        .fallback(0.01)
        .doc(
            "overlap over R* for which the time step is chosen; deeper contacts that exist then count as they are. "
            "Smaller, and the step is longer: quasi-static tests of stiff grains need no more than they reach");
  }

  struct State {
    double shear_x, shear_y, shear_z, overlap;        // force of the tangential spring [N], [m]
    double viscous, viscous_x, viscous_y, viscous_z;  // of the dashpots in the step before [N]
  };
  static constexpr std::array columns{StateColumn<State>{&State::shear_x, "shear_force_x", "N"},
                                      StateColumn<State>{&State::shear_y, "shear_force_y", "N"},
                                      StateColumn<State>{&State::shear_z, "shear_force_z", "N"},
                                      StateColumn<State>{&State::overlap, "overlap", "m"},
                                      StateColumn<State>{&State::viscous, "viscous_normal", "N"},
                                      StateColumn<State>{&State::viscous_x, "viscous_shear_x", "N"},
                                      StateColumn<State>{&State::viscous_y, "viscous_shear_y", "N"},
                                      StateColumn<State>{&State::viscous_z, "viscous_shear_z", "N"}};
  static constexpr bool makes_bonds = false, needs_mass = true, respects_protection = true;

  HertzMindlin(const Config& c, const Assembly& a)
      : effective_modulus(c.youngs_modulus / (2 * (1 - c.poisson_ratio * c.poisson_ratio))),
        effective_shear_modulus(c.youngs_modulus / (4 * (1 + c.poisson_ratio) * (2 - c.poisson_ratio))),
        friction(c.friction),
        damping(2 * std::sqrt(5.0 / 6.0) * hertz_mindlin::damping_ratio(c.restitution)),
        design_overlap(c.design_overlap) {
    if (a.dimension == 2)
      throw UserError("contact_law: `hertz_mindlin` is a law of spheres; in two dimensions write `linear`");
  }

  BRECCIA_KERNEL State initial(const Contact& c) const { return {0, 0, 0, overlap(c), 0, 0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double u = overlap(c), elastic = normal_force(c, u), root = std::sqrt(reduced_radius(c) * u);
    const double wanted = damping * std::sqrt(2 * effective_modulus * root * c.reduced_mass) * c.normal_velocity;
    const double viscous = wanted < elastic ? wanted : elastic;  // tension positive: at most the push is taken away
    const double pressed = elastic - viscous, limit = friction * pressed;

    // A spring that softens sheds force, or it would hold more energy than was put in.
    const double k = 8 * effective_shear_modulus * root,
                 old_k = 8 * effective_shear_modulus * std::sqrt(reduced_radius(c) * s.overlap),
                 softened = k < old_k ? k / old_k : 1.0, inverse_k = k > 0 ? 1 / k : 0.0;
    const PlaneVector before = follow_plane(c, s.shear_x, s.shear_y, s.shear_z);
    const double ox = softened * before.x, oy = softened * before.y, oz = softened * before.z;
    const double tx = ox + k * c.shear_x, ty = oy + k * c.shear_y, tz = oz + k * c.shear_z;
    const CoulombSlip slip = coulomb_slip(k, std::sqrt(tx * tx + ty * ty + tz * tz) * inverse_k,
                                          (ox * tx + oy * ty + oz * tz) * inverse_k * inverse_k, limit);
    const double x = slip.keep * tx, y = slip.keep * ty, z = slip.keep * tz;

    // The tangential dashpot takes what friction leaves to it: nothing once the contact slides.
    const double rate = damping * std::sqrt(k * c.reduced_mass) / c.time_step;
    const double room = limit - std::sqrt(x * x + y * y + z * z),
                 drag = rate * std::sqrt(c.shear_x * c.shear_x + c.shear_y * c.shear_y + c.shear_z * c.shear_z);
    const double share = drag <= room ? 1.0 : room > 0 ? room / drag : 0.0;
    const double dx = share * rate * c.shear_x, dy = share * rate * c.shear_y, dz = share * rate * c.shear_z;

    ContactForce f;
    f.normal = -pressed;
    f.shear_x = x + dx;
    f.shear_y = y + dy;
    f.shear_z = z + dz;
    f.friction_work = slip.work;
    // Of the dashpots the way times the mean of the forces before and after; of the spring what it stored more at its
    // old stiffness, and what the part that it shed did in half of the step.
    const double square = before.x * before.x + before.y * before.y + before.z * before.z;
    const double shed = stored(square, old_k) - stored(softened * softened * square, k) +
                        0.5 * (1 - softened) * (before.x * c.shear_x + before.y * c.shear_y + before.z * c.shear_z);
    const PlaneVector drag_before = follow_plane(c, s.viscous_x, s.viscous_y, s.viscous_z);
    f.contact_work =
        shed + 0.5 * ((s.viscous + viscous) * c.normal_velocity * c.time_step + (drag_before.x + dx) * c.shear_x +
                      (drag_before.y + dy) * c.shear_y + (drag_before.z + dz) * c.shear_z);
    s.shear_x = x;
    s.shear_y = y;
    s.shear_z = z;
    s.overlap = u;
    s.viscous = viscous;
    s.viscous_x = dx;
    s.viscous_y = dy;
    s.viscous_z = dz;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    const double u = overlap(c), square = s.shear_x * s.shear_x + s.shear_y * s.shear_y + s.shear_z * s.shear_z;
    return 0.4 * normal_force(c, u) * u +
           stored(square, 8 * effective_shear_modulus * std::sqrt(reduced_radius(c) * u));
  }

  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double least = design_overlap * reduced_radius(c), now = overlap(c), u = now > least ? now : least;
    const double root = std::sqrt(reduced_radius(c) * u), kn = 2 * effective_modulus * root,
                 ks = 8 * effective_shear_modulus * root;
    return {kn, ks, 0, 0, damping * std::sqrt(kn * c.reduced_mass), damping * std::sqrt(ks * c.reduced_mass)};
  }

 private:
  BRECCIA_KERNEL static double reduced_radius(const Contact& c) {
    return c.radius_i * c.radius_j / (c.radius_i + c.radius_j);
  }
  BRECCIA_KERNEL static double overlap(const Contact& c) {
    const double u = c.free_length() - c.distance;
    return u > 0 ? u : 0.0;
  }
  BRECCIA_KERNEL double normal_force(const Contact& c, double u) const {
    return 4.0 / 3.0 * effective_modulus * u * std::sqrt(reduced_radius(c) * u);
  }
  /// Energy of a spring that carries a force, given its square; none where there is no spring.
  BRECCIA_KERNEL static double stored(double square, double k) { return k > 0 ? 0.5 * square / k : 0.0; }

  double effective_modulus, effective_shear_modulus;  // E*, G* [Pa], of two grains of one material
  double friction, damping, design_overlap;           // damping: 2 sqrt(5/6) beta
};

}  // namespace breccia

BRECCIA_CONTACT_LAW(breccia::HertzMindlin, "hertz_mindlin")
