// SPDX-License-Identifier: BSD-3-Clause
/// Hertz normal contact, Mindlin no-slip tangential stiffness, Coulomb limit; no cohesion.
/// Sources: Johnson (1985), Contact Mechanics, chapters 4 and 7; Thornton, Cummins & Cleary (2013), Powder Technology
/// 233, 30-46 (tangential force when the normal force changes).
#include "breccia/contact_law.hpp"

struct MyHertz {
  struct Config {
    double youngs_modulus, poisson_ratio, friction, design_overlap;
  };

  static void describe(breccia::Schema<Config>& s) {
    s.summary("Hertz-Mindlin contact of elastic spheres with Coulomb friction")
        .source("Johnson (1985), chapters 4 and 7; Thornton et al. (2013)")
        .details(
            "F_n = -4/3 E* sqrt(R*) u^(3/2) with the overlap u; the tangential force grows by K_s du_s with "
            "K_s = 8 G* sqrt(R* u), shrinks with K_s when the overlap does, and is limited to mu |F_n|. Energy that "
            "the change of K_s takes from the tangential spring counts as contact dissipation.");
    s.param("youngs_modulus", &Config::youngs_modulus).unit("Pa").above(0).example("70 GPa").doc("of the grains");
    s.param("poisson_ratio", &Config::poisson_ratio).above(-1).at_most(0.5).example("0.2").doc("of the grains");
    s.param("friction", &Config::friction).at_least(0).example("0.5").doc("Coulomb coefficient");
    s.param("design_overlap", &Config::design_overlap)
        .above(0)
        .below(1)
        .fallback(0.01)
        .doc("overlap over R* for which the time step is chosen; deeper contacts that exist then count as they are");
  }

  struct State {
    double shear_x, shear_y, shear_z, overlap;
  };
  static constexpr std::array columns{breccia::StateColumn<State>{&State::shear_x, "shear_force_x", "N"},
                                      breccia::StateColumn<State>{&State::shear_y, "shear_force_y", "N"},
                                      breccia::StateColumn<State>{&State::shear_z, "shear_force_z", "N"},
                                      breccia::StateColumn<State>{&State::overlap, "overlap", "m"}};

  MyHertz(const Config& c, const breccia::Assembly&)
      : effective_modulus(c.youngs_modulus / (2 * (1 - c.poisson_ratio * c.poisson_ratio))),
        effective_shear_modulus(c.youngs_modulus / (4 * (1 + c.poisson_ratio) * (2 - c.poisson_ratio))),
        friction(c.friction),
        design_overlap(c.design_overlap) {}

  BRECCIA_KERNEL State initial(const breccia::Contact& c) const { return {0, 0, 0, overlap(c)}; }

  BRECCIA_KERNEL breccia::ContactForce operator()(const breccia::Contact& c, State& s) const {
    const double u = overlap(c), pressed = normal_force(c, u);
    const double k = shear_stiffness(c, u), old_k = shear_stiffness(c, s.overlap);
    // A spring that softens must shed force, or it would hold more energy than was put in.
    const double softened = k < old_k ? k / old_k : 1.0;
    const breccia::PlaneVector old = breccia::follow_plane(c, s.shear_x, s.shear_y, s.shear_z);
    const double old_square = old.x * old.x + old.y * old.y + old.z * old.z;
    const double shed = stored(old_square, old_k) - stored(old_square * softened * softened, k);

    const double tx = softened * old.x + k * c.shear_x;
    const double ty = softened * old.y + k * c.shear_y;
    const double tz = softened * old.z + k * c.shear_z;
    const double trial = std::sqrt(tx * tx + ty * ty + tz * tz), limit = friction * pressed;
    const bool slides = trial > limit;
    const double keep = slides ? limit / trial : 1.0;
    s = {keep * tx, keep * ty, keep * tz, u};

    breccia::ContactForce f;
    f.normal = -pressed;
    f.shear_x = s.shear_x;
    f.shear_y = s.shear_y;
    f.shear_z = s.shear_z;
    f.friction_work = slides ? limit * (trial - limit) / k : 0.0;  // no sliding without k: trial = 0 then
    f.contact_work = shed;
    return f;
  }

  BRECCIA_KERNEL double energy(const breccia::Contact& c, const State& s) const {
    const double u = overlap(c), square = s.shear_x * s.shear_x + s.shear_y * s.shear_y + s.shear_z * s.shear_z;
    return 0.4 * normal_force(c, u) * u + stored(square, shear_stiffness(c, u));
  }

  BRECCIA_KERNEL breccia::ContactStiffness stiffness(const breccia::Contact& c) const {
    const double least = design_overlap * reduced_radius(c), now = overlap(c), u = now > least ? now : least;
    return {2 * effective_modulus * std::sqrt(reduced_radius(c) * u), shear_stiffness(c, u), 0, 0};
  }

 private:
  BRECCIA_KERNEL static double reduced_radius(const breccia::Contact& c) {
    return c.radius_i * c.radius_j / (c.radius_i + c.radius_j);
  }
  /// Spheres that the packing left overlapping are free of force at that distance.
  BRECCIA_KERNEL static double overlap(const breccia::Contact& c) {
    const double touching = c.radius_i + c.radius_j, free = c.rest_length < touching ? c.rest_length : touching;
    return c.distance < free ? free - c.distance : 0.0;
  }
  BRECCIA_KERNEL double normal_force(const breccia::Contact& c, double u) const {
    return 4.0 / 3.0 * effective_modulus * u * std::sqrt(reduced_radius(c) * u);
  }
  BRECCIA_KERNEL double shear_stiffness(const breccia::Contact& c, double u) const {
    return 8 * effective_shear_modulus * std::sqrt(reduced_radius(c) * u);
  }
  /// Energy of a spring that carries a force, given its square; none where there is no contact and no spring.
  BRECCIA_KERNEL static double stored(double square, double k) { return k > 0 ? 0.5 * square / k : 0.0; }

  double effective_modulus, effective_shear_modulus;  // E*, G* [Pa], of two grains of one material
  double friction, design_overlap;
};

BRECCIA_CONTACT_LAW(MyHertz, "my_hertz")
