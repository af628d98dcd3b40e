// SPDX-License-Identifier: BSD-3-Clause
/// Linear elastic, perfectly brittle bonds with Coulomb friction after breakage.
/// Source: Rojek, Labra, Su, Oñate (2012), Int. J. Solids Struct. 49, 1497-1517, Eqs. 7-17 and 24-59.
#include "breccia/contact_law.hpp"

namespace breccia {

enum class StiffnessModel { model_1, model_2, model_3a, model_3b, model_3c };
enum class RestLength { initial_distance, touching };

struct ElasticBrittle {
  struct Config {
    StiffnessModel model;
    double bond_modulus, stiffness_ratio, tensile_strength, shear_strength, friction;
    RestLength broken_rest_length;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Linear elastic, perfectly brittle bonds; Coulomb friction after breakage (five parameter models)")
        .source("Rojek et al. (2012), Eqs. 7-17 (law), 24-59 (models)")
        .details(
            "F_n = K_n u_n, F_s = K_s u_s with u_n = d - d0. A bond breaks at once when F_n >= phi_n (tension) or "
            "|F_s| >= phi_s (shear). Afterwards F_n <= 0 and |F_s| <= mu |F_n|. K_n = 2 E_c R, phi_n = 4 sigma_c A, "
            "phi_s = 4 tau_c A, where the model says what the radius R and the squared radius A are. In two "
            "dimensions, "
            "which the paper does not have, the bar is 2 r broad and as thick as the specimen: K_n = E_c t, phi_n = 2 "
            "sigma_c r t, phi_s = 2 tau_c r t, with r in place of r^2 in what the model says of A.");
    s.param("model", &Config::model)
        .choice("model_1", StiffnessModel::model_1, "R and A from the pair's arithmetic mean radius")
        .choice("model_2", StiffnessModel::model_2, "R from the pair's harmonic mean, A from its smaller radius")
        .choice("model_3a", StiffnessModel::model_3a, "uniform: R = <r>, A = <r^2> over all particles")
        .choice("model_3b", StiffnessModel::model_3b, "uniform: averages over all bonds of model 1's R and A")
        .choice("model_3c", StiffnessModel::model_3c, "uniform: averages over all bonds of model 2's R and A")
        .doc("how bond stiffness and strength follow from the particle radii")
        .source("Rojek et al. (2012), section 4")
        .fallback("model_1");
    s.param("bond_modulus", &Config::bond_modulus)
        .unit("Pa")
        .above(0)
        .example("10 GPa")
        .doc("Young's modulus of the bar that stands for a bond")
        .source("E_c, Eq. 19");
    s.param("stiffness_ratio", &Config::stiffness_ratio)
        .above(0)
        .example("3.7")
        .doc("normal over shear stiffness, K_n/K_s")
        .source("Table 1");
    s.param("tensile_strength", &Config::tensile_strength)
        .unit("Pa")
        .above(0)
        .example("40 MPa")
        .doc("tensile strength of the bond material")
        .source("sigma_c, Eq. 25");
    s.param("shear_strength", &Config::shear_strength)
        .unit("Pa")
        .above(0)
        .example("40 MPa")
        .doc("shear strength of the bond material")
        .source("tau_c, Eq. 26");
    s.param("friction", &Config::friction)
        .at_least(0)
        .example("0.5")
        .doc("Coulomb coefficient of broken and never bonded contacts")
        .source("mu, Eq. 17");
    s.param("broken_rest_length", &Config::broken_rest_length)
        .choice("initial_distance", RestLength::initial_distance,
                "the distance when the bond was made: breaking in shear leaves the normal force as it is")
        .choice("touching", RestLength::touching,
                "the smaller of that distance and the sum of the radii: a bond that spanned a gap carries no "
                "compression after breakage until the particles touch")
        .doc("centre distance without normal force after breakage; the paper does not say")
        .fallback("initial_distance");
  }

  struct State {
    double spring_x, spring_y, spring_z;
  };
  static constexpr std::array columns{StateColumn<State>{&State::spring_x, "shear_spring_x", "m"},
                                      StateColumn<State>{&State::spring_y, "shear_spring_y", "m"},
                                      StateColumn<State>{&State::spring_z, "shear_spring_z", "m"}};

  static constexpr bool respects_protection = true;
  static constexpr auto per_bond() {
    using Scatters = PerBond<ElasticBrittle>;
    return std::array{Scatters{"tensile_strength", &ElasticBrittle::tensile_strength},
                      Scatters{"shear_strength", &ElasticBrittle::shear_strength},
                      Scatters{"bond_modulus", &ElasticBrittle::k_uniform},
                      Scatters{"bond_modulus", &ElasticBrittle::k_arithmetic},
                      Scatters{"bond_modulus", &ElasticBrittle::k_harmonic}};
  }

  ElasticBrittle(const Config& c, const Assembly& assembly)
      : inverse_ratio(1 / c.stiffness_ratio),
        friction(c.friction),
        keep_rest_length(c.broken_rest_length == RestLength::initial_distance ? 1.0 : 0.0) {
    const bool discs = assembly.dimension == 2;
    const double modulus = 2 * c.bond_modulus, area = 4, breadth = 2 * assembly.thickness;
    if (discs) k_uniform = c.bond_modulus * assembly.thickness;
    if (c.model == StiffnessModel::model_1) {
      if (discs) a_arithmetic_linear = breadth;
      else k_arithmetic = modulus, a_arithmetic = area;
    } else if (c.model == StiffnessModel::model_2) {
      if (discs) a_minimum_linear = breadth;
      else k_harmonic = modulus, a_minimum = area;
    } else {
      const MeanRadii mean = mean_radii(c.model, assembly);
      if (!discs) k_uniform = modulus * mean.stiffness;
      a_uniform = discs ? breadth * mean.strength : area * mean.strength_squared;
    }
    tensile_strength = c.tensile_strength;
    shear_strength = c.shear_strength;
  }

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double kn = normal_stiffness(c), ks = kn * inverse_ratio, area = strength_area(c);
    const PlaneVector old = follow_plane(c, s.spring_x, s.spring_y, s.spring_z);
    const double ux = old.x + c.shear_x, uy = old.y + c.shear_y, uz = old.z + c.shear_z;
    const double spring = std::sqrt(ux * ux + uy * uy + uz * uz), trial = ks * spring;

    const double bonded_normal = kn * (c.distance - c.rest_length);
    const bool intact = c.intact > 0.5, breakable = c.breakable > 0.5;
    const bool tension = breakable & (bonded_normal >= tensile_strength * area);
    const bool shear = breakable & !tension & (trial >= shear_strength * area);
    const bool holds = intact & !tension & !shear;

    const double free_normal = kn * (c.distance - free_length(c));
    const double pressed = free_normal < 0 ? free_normal : 0.0;
    const double limit = friction * -pressed;
    const CoulombSlip slip = coulomb_slip(ks, spring, old.x * ux + old.y * uy + old.z * uz, limit, !holds);
    const double keep = slip.keep;
    s.spring_x = ux * keep;
    s.spring_y = uy * keep;
    s.spring_z = uz * keep;

    ContactForce f;
    f.normal = holds ? bonded_normal : pressed;
    f.shear_x = ks * s.spring_x;
    f.shear_y = ks * s.spring_y;
    f.shear_z = ks * s.spring_z;
    f.breaks = tension ? double(BondState::broken_tension) : shear ? double(BondState::broken_shear) : 0.0;
    // What a bond loses in the step it breaks is fracture energy: stored before minus stored after, less the work that
    // the force it lost did not do in that step any more, as leapfrog has it (the way times the mean of the forces).
    const double free_stored = 0.5 * pressed * (c.distance - free_length(c));
    const double bonded_stored = 0.5 * bonded_normal * (c.distance - c.rest_length);
    const double not_done = 0.5 * (bonded_normal - pressed) * c.normal_velocity * c.time_step;
    const bool broke = tension | shear;
    f.fracture_energy = broke ? slip.work + bonded_stored - free_stored - not_done : 0.0;
    f.friction_work = broke ? 0.0 : slip.work;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    const double kn = normal_stiffness(c);
    const bool intact = c.intact > 0.5;
    const double un = c.distance - (intact ? c.rest_length : free_length(c));
    const double stretch = intact | (un < 0) ? un : 0.0;
    const double us2 = s.spring_x * s.spring_x + s.spring_y * s.spring_y + s.spring_z * s.spring_z;
    return 0.5 * kn * (stretch * stretch + inverse_ratio * us2);
  }

  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double kn = normal_stiffness(c);
    return {kn, kn * inverse_ratio, 0, 0};
  }

  /// Uniform constants in use, for the summary: K_n [N/m], phi_n, phi_s [N].
  Results derived() const {
    if (k_uniform == 0) return {};
    return {{{"normal_stiffness", "N/m"}, k_uniform},
            {{"bond_tensile_strength", "N"}, a_uniform * tensile_strength},
            {{"bond_shear_strength", "N"}, a_uniform * shear_strength}};
  }

 private:
  BRECCIA_KERNEL double normal_stiffness(const Contact& c) const {
    const double sum = c.radius_i + c.radius_j;
    return k_uniform + k_arithmetic * 0.5 * sum + k_harmonic * 2 * c.radius_i * c.radius_j / sum;
  }
  BRECCIA_KERNEL double strength_area(const Contact& c) const {
    const double mean = 0.5 * (c.radius_i + c.radius_j);
    const double low = c.radius_i < c.radius_j ? c.radius_i : c.radius_j;
    return a_uniform + (a_arithmetic * mean + a_arithmetic_linear) * mean + (a_minimum * low + a_minimum_linear) * low;
  }
  BRECCIA_KERNEL double free_length(const Contact& c) const {
    return keep_rest_length > 0.5 ? c.rest_length : c.free_length();
  }

  /// Averages over all particles (3a) or bonds (3b, 3c) of the radii that stiffness and strength go by.
  struct MeanRadii {
    double stiffness = 0, strength = 0, strength_squared = 0;  // [m], [m], [m2]
  };
  static MeanRadii mean_radii(StiffnessModel model, const Assembly& a) {
    ExactSumOf<double> stiffness, strength, strength_squared, count;
    const auto add = [&](double r_stiffness, double r_strength) {
      stiffness.add(r_stiffness);
      strength.add(r_strength);
      strength_squared.add(r_strength * r_strength);
    };
    const bool of_particles = model == StiffnessModel::model_3a;
    count.add(double(of_particles ? a.own_particles().size() : a.own_bonds().size()));
    if (of_particles)
      for (const std::size_t k : a.own_particles()) add(a.radius[k], a.radius[k]);
    else
      for (const std::size_t k : a.own_bonds()) {
        const double x = a.radius[a.bond_i[k]], y = a.radius[a.bond_j[k]], mean = 0.5 * (x + y);
        if (model == StiffnessModel::model_3b) add(mean, mean);
        else add(2 * x * y / (x + y), std::min(x, y));
      }
    const auto [r_stiffness, r_strength, r_squared, n] = a.sum(stiffness, strength, strength_squared, count);
    if (!(n > 0)) throw UserError("contact_law: models 3b and 3c average over bonds, and no bond was made");
    return {r_stiffness / n, r_strength / n, r_squared / n};
  }

  // K_n = k_uniform + k_arithmetic r_a + k_harmonic r_h; strength area likewise. One weight of each is set, the rest
  // are zero.
  double k_uniform = 0, k_arithmetic = 0, k_harmonic = 0;
  double a_uniform = 0, a_arithmetic = 0, a_arithmetic_linear = 0, a_minimum = 0, a_minimum_linear = 0;
  double tensile_strength = 0, shear_strength = 0, inverse_ratio = 0, friction = 0, keep_rest_length = 1;
};

}  // namespace breccia

BRECCIA_CONTACT_LAW(breccia::ElasticBrittle, "elastic_brittle")
