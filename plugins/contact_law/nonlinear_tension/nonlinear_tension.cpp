// SPDX-License-Identifier: BSD-3-Clause
/// NET-BPM: bonds of exponential tension with bending (and torsion, between spheres) that break at limits of strain.
/// Source: Ouyang, Yang & Chen (2017), Bonded-particle model with nonlinear elastic tensile stiffness for rock-like
/// materials, Appl. Sci. 7(7), 686, Eqs. 1-9. Two dimensions; README.md derives the form for spheres.
#include "config.hpp"
#include "exponential.hpp"

namespace breccia::nonlinear_tension {

struct Law {
  using Config = nonlinear_tension::Config;
  static void describe(Schema<Config>& s) { nonlinear_tension::describe(s); }

  struct State {
    double shear_x, shear_y, shear_z, bending_x, bending_y, bending_z, torsion;
  };
  static constexpr std::array columns{StateColumn<State>{&State::shear_x, "shear_strain_x", "1"},
                                      StateColumn<State>{&State::shear_y, "shear_strain_y", "1"},
                                      StateColumn<State>{&State::shear_z, "shear_strain_z", "1"},
                                      StateColumn<State>{&State::bending_x, "bending_x", "rad"},
                                      StateColumn<State>{&State::bending_y, "bending_y", "rad"},
                                      StateColumn<State>{&State::bending_z, "bending_z", "rad"},
                                      StateColumn<State>{&State::torsion, "torsion", "rad"}};
  static constexpr bool has_moments = true;
  static constexpr bool respects_protection = true;
  /// All limits of strain go with that in tension.
  static constexpr auto per_bond() {
    return std::array{
        PerBond<Law>{"tensile_strain_limit", &Law::limit}, PerBond<Law>{"tensile_strain_limit", &Law::scale},
        PerBond<Law>{"tensile_strain_limit", &Law::inverse_scale, true},
        PerBond<Law>{"tensile_strain_limit", &Law::shear_limit}, PerBond<Law>{"tensile_strain_limit", &Law::shear_cap}};
  }

  Law(const Config& c, const Assembly& a)
      : shear_ratio(c.shear_stiffness_ratio),
        torsion_ratio(c.torsion_ratio.value_or(2 * c.shear_stiffness_ratio)),
        limit(c.tensile_strain_limit),
        scale(c.tension_shape * c.tensile_strain_limit),
        inverse_scale(1 / scale),
        width(c.bond_width),
        shear_limit(c.shear_strain_ratio * limit),
        shear_cap(c.shear_strain_cap_ratio * limit),
        internal_friction(std::tan(c.internal_friction_angle)),
        friction(std::tan(c.friction_angle)) {
    const bool discs = a.dimension == 2;
    const double thickness = discs ? a.thickness : 1;
    const bool same = c.stiffness_radius == StiffnessRadius::none;
    if (c.bending_ratio || !same) {
      for (const double r : a.radius) reference_radius = std::max(reference_radius, r);
      reference_radius = c.reference_radius.value_or(a.max(reference_radius));
    }
    const double given = c.normal_stiffness.value_or(0) * thickness;
    if (c.normal_stiffness) (same ? k_constant : k_linear) = same ? given : given / reference_radius;
    else if (discs) k_linear = 2 * *c.bond_modulus * thickness;
    else k_square = 4 * *c.bond_modulus;
    if (c.bending_stiffness) bending_constant = *c.bending_stiffness * thickness;
    else if (c.bending_of == BendingOf::table) bending_constant = *c.bending_ratio * reference_radius * given;
    else bending_length = *c.bending_ratio * reference_radius;
    of_smaller = same || c.stiffness_radius == StiffnessRadius::smaller;
    of_harmonic = c.stiffness_radius == StiffnessRadius::harmonic;
    of_mean = c.stiffness_radius == StiffnessRadius::mean;
  }

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0, 0, 0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double smaller = smaller_radius(c), touching = c.touching(), inverse_touching = 1 / touching;
    const double kn = normal_stiffness(c), ks = kn * shear_ratio, km = bending_stiffness(kn), kt = km * torsion_ratio;
    const double inverse_length = 1 / c.rest_length;
    const bool was = c.intact > 0.5, breakable = c.breakable > 0.5;

    const double strain = (c.distance - c.rest_length) * inverse_length;
    const PlaneVector slid = follow_plane(c, s.shear_x, s.shear_y, s.shear_z);
    const double sx = slid.x + c.shear_x * inverse_length, sy = slid.y + c.shear_y * inverse_length,
                 sz = slid.z + c.shear_z * inverse_length;
    const double shear = std::sqrt(sx * sx + sy * sy + sz * sz);
    const PlaneVector bent = follow_plane(c, s.bending_x, s.bending_y, s.bending_z);
    const double turned = c.turn_x * c.nx + c.turn_y * c.ny + c.turn_z * c.nz;
    const double bx = bent.x + (c.turn_x - turned * c.nx), by = bent.y + (c.turn_y - turned * c.ny),
                 bz = bent.z + (c.turn_z - turned * c.nz);
    const double bending2 = bx * bx + by * by + bz * bz, twist = s.torsion + turned;

    // The beam at the rim that is strained most, in tension and in shear.
    const double rim = width * smaller * inverse_touching;
    const bool tension = breakable & (strain + rim * std::sqrt(bending2) > limit);
    const double line = shear_limit - internal_friction * strain, allowed = line < shear_cap ? line : shear_cap;
    const bool sheared = breakable & !tension & (shear + rim * std::abs(twist) > allowed);
    const bool broke = tension | sheared, holds = was & !broke;

    const double pulled = strain > 0 ? strain : 0.0, fall = decay(pulled * inverse_scale);
    const double bonded = strain > 0 ? -scale * fall : strain;
    const bool spanned = c.rest_length > touching;
    const double gap = spanned ? (c.distance - touching) * inverse_touching : strain, pressed = gap < 0 ? gap : 0.0;
    const double push = friction * kn * -pressed;
    const CoulombSlip slip = coulomb_slip(ks, shear, slid.x * sx + slid.y * sy + slid.z * sz, push, !holds);
    const double keep = slip.keep, hold = holds ? 1.0 : 0.0;
    s.shear_x = keep * sx;
    s.shear_y = keep * sy;
    s.shear_z = keep * sz;
    s.bending_x = hold * bx;
    s.bending_y = hold * by;
    s.bending_z = hold * bz;
    s.torsion = hold * twist;

    ContactForce f;
    f.normal = kn * (holds ? bonded : pressed);
    f.shear_x = ks * s.shear_x;
    f.shear_y = ks * s.shear_y;
    f.shear_z = ks * s.shear_z;
    const double twisting = kt * s.torsion;
    f.moment_x = km * s.bending_x + twisting * c.nx;
    f.moment_y = km * s.bending_y + twisting * c.ny;
    f.moment_z = km * s.bending_z + twisting * c.nz;
    f.breaks = tension ? double(BondState::broken_tension) : sheared ? double(BondState::broken_shear) : 0.0;
    // What the bond stored, less what the bare contact goes on storing; and less the work that the force and moment it
    // lost did not do in this step any more, as leapfrog has it (the way times the mean of before and after).
    const double stretch = strain > 0 ? scale * (strain + scale * fall) : 0.5 * strain * strain;
    const double left = 0.5 * kn * c.free_length() * pressed * pressed;
    const double not_done = 0.5 * kn * (bonded - pressed) * c.normal_velocity * c.time_step;
    const double bent_over = bent.x * bx + bent.y * by + bent.z * bz;
    const double lost = c.rest_length * (kn * stretch + slip.work) - left - not_done +
                        0.5 * (km * bent_over + kt * (twist - turned) * twist);
    f.fracture_energy = broke ? lost : 0.0;
    f.friction_work = broke ? 0.0 : c.rest_length * slip.work;  // springs are strains here
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    const double kn = normal_stiffness(c), km = bending_stiffness(kn);
    const bool intact = c.intact > 0.5;
    const double length = intact ? c.rest_length : c.free_length();
    const double strain = (c.distance - length) / length, pulled = strain > 0 ? strain : 0.0;
    const double stretch = strain < 0 ? 0.5 * strain * strain
                           : intact   ? scale * (pulled + scale * decay(pulled * inverse_scale))
                                      : 0.0;
    const double shear2 = s.shear_x * s.shear_x + s.shear_y * s.shear_y + s.shear_z * s.shear_z;
    const double bending2 = s.bending_x * s.bending_x + s.bending_y * s.bending_y + s.bending_z * s.bending_z;
    return kn * (length * stretch + 0.5 * shear_ratio * c.rest_length * shear2) +
           0.5 * km * (bending2 + torsion_ratio * s.torsion * s.torsion);
  }

  /// Tension is stiffest where it begins, and as stiff there as compression.
  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double kn = normal_stiffness(c);
    const double km = c.intact > 0.5 ? bending_stiffness(kn) : 0.0;
    return {kn / c.free_length(), kn * shear_ratio / c.rest_length, km, km * torsion_ratio};
  }

  /// Constants that are the same for all bonds, in two dimensions for the thickness of the specimen.
  Results derived() const {
    Results r;
    if (k_constant > 0) {
      r.push_back({{"normal_stiffness", "N"}, k_constant});
      r.push_back({{"shear_stiffness", "N"}, k_constant * shear_ratio});
    }
    if (reference_radius > 0) r.push_back({{"reference_radius", "m"}, reference_radius});
    if (k_constant > 0 || bending_length == 0)
      r.push_back({{"bending_stiffness", "N m/rad"}, bending_stiffness(k_constant)});
    return r;
  }

 private:
  BRECCIA_KERNEL static double smaller_radius(const Contact& c) {
    return c.radius_i < c.radius_j ? c.radius_i : c.radius_j;
  }
  /// One of the three shares is 1, the others are 0 and change no bit.
  BRECCIA_KERNEL double normal_stiffness(const Contact& c) const {
    const double sum = c.touching();
    const double x = of_smaller * smaller_radius(c) + of_harmonic * (2 * c.radius_i * c.radius_j * (1 / sum)) +
                     of_mean * (0.5 * sum);
    return k_constant + k_linear * x + k_square * x * x;
  }
  BRECCIA_KERNEL double bending_stiffness(double kn) const { return bending_constant + bending_length * kn; }

  // k_n = k_constant + k_linear x + k_square x^2, x a radius of the pair; k_m = bending_constant + bending_length k_n.
  // Of each one is not zero.
  double k_constant = 0, k_linear = 0, k_square = 0;    // [N], [N/m], [Pa]
  double of_smaller = 0, of_harmonic = 0, of_mean = 0;  // 1 of the radius that x is
  double bending_constant = 0, bending_length = 0;      // [N m/rad], [m]
  double reference_radius = 0;                          // [m]
  double shear_ratio, torsion_ratio;                    // k_s/k_n, k_t/k_m
  double limit, scale, inverse_scale, width;            // e_n0, b e_n0, w
  double shear_limit, shear_cap;                        // e_s0, e_smax
  double internal_friction, friction;                   // tan(phi), tan(phi_f)
};

}  // namespace breccia::nonlinear_tension

BRECCIA_CONTACT_LAW(breccia::nonlinear_tension::Law, "nonlinear_tension")
