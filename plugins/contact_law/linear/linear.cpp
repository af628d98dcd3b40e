// SPDX-License-Identifier: BSD-3-Clause
/// Grains that press on each other through linear springs and slide by Coulomb's law; no tension, no bonds.
/// Source: Cundall, Strack (1979), Geotechnique 29, 47-65; the stiffness from a modulus: effective_modulus.hpp.
#include "../../shared/effective_modulus.hpp"

namespace breccia {

struct Linear {
  struct Config {
    std::optional<double> normal_stiffness, contact_modulus, shear_stiffness, stiffness_ratio;
    ModulusOf modulus_of;
    double friction;
  };

  static void describe(Schema<Config>& s) {
    s.summary(
         "Linear springs and Coulomb friction of grains that touch; makes no bonds, may stand beside a law that does")
        .source("Cundall, Strack (1979), Geotechnique 29, 47-65; Itasca, PFC, linear contact model (effective modulus)")
        .details(
            "F_n = -k_n u with the overlap u beyond what the packing had, never in tension; the shear spring grows "
            "by k_s du_s and slides at mu |F_n|. k_n and k_s are given, or k_n = E A/(r_i + r_j) with A = pi "
            "r_min^2 (in two dimensions 2 r_min t). It acts on every pair that is pressed, bonded by another law of "
            "the list or not.");
    s.exactly_one_of({"normal_stiffness", "contact_modulus"});
    s.exactly_one_of({"shear_stiffness", "stiffness_ratio"});
    s.param("normal_stiffness", &Config::normal_stiffness)
        .unit("N/m")
        .above(0)
        .example("10 MN/m")
        .doc("k_n, the same for all contacts; in two dimensions that of the whole thickness");
    s.param("contact_modulus", &Config::contact_modulus)
        .unit("Pa")
        .above(0)
        .example("10 GPa")
        .doc("E of the bar that stands for a contact")
        .source("effective modulus, manual of Itasca's PFC; E_c of the grains, Potyondy, Cundall (2004)");
    s.param("modulus_of", &Config::modulus_of)
        .choice("contact", ModulusOf::contact, "one bar between the centres: A = pi r_min^2, of discs 2 r_min t")
        .choice(
            "grains", ModulusOf::grains,
            "the two grains in series, each k_n = 4 E r, of discs 2 E t: k_n = 4 E r_i r_j/(r_i + r_j), of discs E t")
        .doc("what the contact_modulus E is that of")
        .source("contact: PFC since version 5; grains: Potyondy, Cundall (2004), recalled")
        .fallback("contact");
    s.param("shear_stiffness", &Config::shear_stiffness)
        .unit("N/m")
        .at_least(0)
        .example("5 MN/m")
        .doc("k_s, the same for all contacts; in two dimensions that of the whole thickness");
    s.param("stiffness_ratio", &Config::stiffness_ratio)
        .above(0)
        .example("2.5")
        .doc("normal over shear stiffness, k_n/k_s");
    s.param("friction", &Config::friction).at_least(0).example("0.5").doc("Coulomb coefficient, mu");
  }

  struct State {
    double spring_x, spring_y, spring_z;
  };
  static constexpr std::array columns{StateColumn<State>{&State::spring_x, "shear_spring_x", "m"},
                                      StateColumn<State>{&State::spring_y, "shear_spring_y", "m"},
                                      StateColumn<State>{&State::spring_z, "shear_spring_z", "m"}};
  static constexpr bool makes_bonds = false, respects_protection = true;

  Linear(const Config& c, const Assembly& a)
      : normal_stiffness(c.contact_modulus, c.normal_stiffness, a, c.modulus_of),
        own_shear_stiffness(c.shear_stiffness.value_or(0)),
        inverse_ratio(c.stiffness_ratio ? 1 / *c.stiffness_ratio : 0),
        friction(c.friction) {}

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double kn = normal_stiffness(c), ks = shear_stiffness(kn), pressed = kn * overlap(c);
    const PlaneVector old = follow_plane(c, s.spring_x, s.spring_y, s.spring_z);
    const double x = old.x + c.shear_x, y = old.y + c.shear_y, z = old.z + c.shear_z;
    const CoulombSlip slip =
        coulomb_slip(ks, std::sqrt(x * x + y * y + z * z), old.x * x + old.y * y + old.z * z, friction * pressed);
    // A spring without stiffness would hold a length that nothing limits: apart, it begins anew.
    const double keep = pressed > 0 ? slip.keep : 0.0;
    s.spring_x = keep * x;
    s.spring_y = keep * y;
    s.spring_z = keep * z;
    ContactForce f;
    f.normal = -pressed;
    f.shear_x = ks * s.spring_x;
    f.shear_y = ks * s.spring_y;
    f.shear_z = ks * s.spring_z;
    f.friction_work = slip.work;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    const double kn = normal_stiffness(c), u = overlap(c);
    return 0.5 * (kn * u * u +
                  shear_stiffness(kn) * (s.spring_x * s.spring_x + s.spring_y * s.spring_y + s.spring_z * s.spring_z));
  }

  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double kn = normal_stiffness(c);
    return {kn, shear_stiffness(kn), 0, 0};
  }

 private:
  BRECCIA_KERNEL double shear_stiffness(double kn) const { return own_shear_stiffness + kn * inverse_ratio; }
  BRECCIA_KERNEL static double overlap(const Contact& c) {
    const double u = c.free_length() - c.distance;
    return u > 0 ? u : 0.0;
  }

  EffectiveModulus normal_stiffness;
  double own_shear_stiffness, inverse_ratio, friction;
};

}  // namespace breccia

BRECCIA_CONTACT_LAW(breccia::Linear, "linear")
