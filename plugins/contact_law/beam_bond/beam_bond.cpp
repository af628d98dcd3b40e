// SPDX-License-Identifier: BSD-3-Clause
/// Bonds that are Timoshenko beams from centre to centre; they break by the stresses at their ends.
/// Source: Brown, Chen, Ooi (2014), Granular Matter 16, 299-311; Przemieniecki (1968) for the beam. README.md has the
/// equations, and why a spring in the middle of the beam is the whole beam.
#include <numbers>

#include "../../shared/bond_section.hpp"
#include "../../shared/spring_bond.hpp"

namespace breccia {

struct BeamBond {
  struct Config {
    double bond_modulus;
    std::optional<double> poisson_ratio, shear_modulus, shear_coefficient;
    double radius_multiplier, tensile_strength, compressive_strength, shear_strength;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Timoshenko beams from centre to centre that break by the stresses at their ends")
        .source("Brown, Chen, Ooi (2014), Granular Matter 16, 299-311, 10.1007/s10035-014-0494-4")
        .details(
            "A round beam of radius r = lambda min(r_i, r_j), in two dimensions a rectangular one 2 r high and as "
            "thick "
            "as the specimen, joins the centres, which are L apart when it is made. Its end forces and moments are "
            "those of a Timoshenko beam with E, G and the shear coefficient kappa, for any sizes of the two particles. "
            "It breaks in tension or by compression when N/A + |M| r/I at an end exceeds the tensile strength, or the "
            "compressive one with -N; in shear when 4/3 |V|/A + |T| r/J (two dimensions: 3/2 |V|/A) exceeds the shear "
            "strength. A broken bond carries nothing: a law of contact may stand before this one in a list.");
    s.exactly_one_of({"poisson_ratio", "shear_modulus"});
    s.param("bond_modulus", &Config::bond_modulus).unit("Pa").above(0).example("30 GPa").doc("E of the beam");
    s.param("poisson_ratio", &Config::poisson_ratio)
        .above(-1)
        .at_most(0.5)
        .example("0.2")
        .doc("nu of the beam: G = E/(2 (1 + nu))");
    s.param("shear_modulus", &Config::shear_modulus).unit("Pa").above(0).example("12 GPa").doc("G itself");
    s.param("shear_coefficient", &Config::shear_coefficient)
        .above(0)
        .at_most(1)
        .example("0.9")
        .doc(
            "kappa, the share of the section that resists shear: if absent 0.9 for round beams, 5/6 for rectangular "
            "ones in two dimensions");
    s.param("radius_multiplier", &Config::radius_multiplier)
        .above(0)
        .fallback(1.0)
        .doc("radius of the beam over the smaller of the two, lambda");
    s.param("tensile_strength", &Config::tensile_strength)
        .unit("Pa")
        .above(0)
        .example("30 MPa")
        .doc("largest tensile stress in the beam, bending included");
    s.param("compressive_strength", &Config::compressive_strength)
        .unit("Pa")
        .above(0)
        .example("300 MPa")
        .doc("largest compressive stress in the beam, bending included");
    s.param("shear_strength", &Config::shear_strength)
        .unit("Pa")
        .above(0)
        .example("60 MPa")
        .doc("largest shear stress in the beam, torsion included");
  }

  using State = SpringBond;
  static constexpr auto columns = spring_bond_columns;
  static constexpr bool has_moments = true, respects_protection = true;
  static constexpr auto per_bond() {
    return std::array{PerBond<BeamBond>{"tensile_strength", &BeamBond::tensile_strength},
                      PerBond<BeamBond>{"compressive_strength", &BeamBond::compressive_strength},
                      PerBond<BeamBond>{"shear_strength", &BeamBond::shear_strength}};
  }

  BeamBond(const Config& c, const Assembly& a)
      : section(c.radius_multiplier, a),
        modulus(c.bond_modulus),
        shear_modulus(c.shear_modulus ? *c.shear_modulus : 0.5 * c.bond_modulus / (1 + c.poisson_ratio.value_or(0))),
        tensile_strength(c.tensile_strength),
        compressive_strength(c.compressive_strength),
        shear_strength(c.shear_strength),
        peak_of_shear(a.dimension == 2 ? 1.5 : 4.0 / 3.0) {
    softness = 12 * modulus / (c.shear_coefficient.value_or(a.dimension == 2 ? 5.0 / 6.0 : 0.9) * shear_modulus);
  }

  BRECCIA_KERNEL State initial(const Contact&) const { return {0, 0, 0, 0, 0, 0, 0}; }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const Beam b = beam(c);
    const ContactStiffness& k = b.springs;
    const bool was = c.intact > 0.5, breakable = c.breakable > 0.5;
    // The motion across at the middle of the beam, which is `off` from the contact point toward j.
    const double off = 0.5 * (c.radius_j - c.radius_i);
    const SpringMotion m = spring_motion(
        c, s,
        {c.shear_x + off * (c.turn_y * c.nz - c.turn_z * c.ny), c.shear_y + off * (c.turn_z * c.nx - c.turn_x * c.nz),
         c.shear_z + off * (c.turn_x * c.ny - c.turn_y * c.nx)});

    // Stresses. Moments at the ends are those of the middle, and the shear force times half the length added or taken
    // away; the larger of the two is sought.
    const double vx = k.shear * m.across.x, vy = k.shear * m.across.y, vz = k.shear * m.across.z,
                 across2 = vx * vx + vy * vy + vz * vz;
    const PlaneVector& bent = m.turning.now;
    const double qx = k.bending * bent.x, qy = k.bending * bent.y, qz = k.bending * bent.z, half = 0.5 * c.rest_length;
    const double both = qx * (c.ny * vz - c.nz * vy) + qy * (c.nz * vx - c.nx * vz) + qz * (c.nx * vy - c.ny * vx);
    const double most = std::sqrt(qx * qx + qy * qy + qz * qz + half * (half * across2 + 2 * std::abs(both)));
    const double mean = k.normal * m.opened * b.inverse_area, rim = most * b.rim_over_inertia;
    const double shear =
        peak_of_shear * std::sqrt(across2) * b.inverse_area + k.torsion * std::abs(m.turning.twist) * b.rim_over_polar;
    const bool tension = breakable & (rim + mean > tensile_strength);
    const bool crushed = breakable & !tension & (rim - mean > compressive_strength);
    const bool sheared = breakable & !tension & !crushed & (shear > shear_strength);
    const bool broke = tension | crushed | sheared;

    ContactForce f = spring_force(c, k, m, was & !broke ? 1.0 : 0.0, s);
    // The shear force acts in the middle of the beam and not at the contact point: a couple makes up for that.
    f.moment_x += off * (c.ny * f.shear_z - c.nz * f.shear_y);
    f.moment_y += off * (c.nz * f.shear_x - c.nx * f.shear_z);
    f.moment_z += off * (c.nx * f.shear_y - c.ny * f.shear_x);
    f.breaks = tension   ? double(BondState::broken_tension)
               : crushed ? double(BondState::broken_combined)
               : sheared ? double(BondState::broken_shear)
                         : 0.0;
    f.fracture_energy = broke ? spring_loss(k, m) : 0.0;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const { return spring_energy(c, beam(c).springs, s); }

  /// Where the sizes differ, shear and rotation go together: k (u + e theta)^2 <= k (1 + s) u^2 + k (1 + 1/s) (e
  /// theta)^2 for any s, by which they are taken apart.
  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const ContactStiffness k = beam(c).springs;
    const double hold = c.intact > 0.5 ? 1.0 : 0.0, off = 0.5 * std::abs(c.radius_j - c.radius_i),
                 half = 0.5 * c.rest_length;
    return {hold * k.normal, hold * k.shear * (1 + off / half), hold * (k.bending + off * (off + half) * k.shear),
            hold * k.torsion};
  }

 private:
  struct Beam {
    ContactStiffness springs;  ///< E A/L [N/m], of the middle [N/m], E I/L, G J/L [N m/rad]
    double inverse_area, rim_over_inertia, rim_over_polar;  // [1/m2], [1/m3], [1/m3]
  };
  BRECCIA_KERNEL Beam beam(const Contact& c) const {
    const BondSection::Of at = section.between(c.radius_i, c.radius_j);
    const double inertia = at.bending, inverse_length = 1 / c.rest_length, inverse_area = 1 / at.area;
    Beam b;
    b.springs.normal = modulus * at.area * inverse_length;
    b.springs.bending = modulus * inertia * inverse_length;
    b.springs.torsion = shear_modulus * at.torsion * inverse_length;
    // 12 E I/(L^3 (1 + Phi)) with Phi = 12 E I/(kappa G A L^2).
    const double slender = inverse_length * inverse_length;
    b.springs.shear = 12 * b.springs.bending * slender / (1 + softness * inertia * inverse_area * slender);
    b.inverse_area = inverse_area;
    b.rim_over_inertia = at.radius / inertia;
    b.rim_over_polar = section.twists() * at.radius / (at.torsion > 0 ? at.torsion : 1.0);
    return b;
  }

  BondSection section;
  double modulus, shear_modulus;                                  // E, G [Pa]
  double tensile_strength, compressive_strength, shear_strength;  // [Pa]
  double peak_of_shear;                                           // largest over mean stress of a shear force
  double softness;                                                // 12 E/(kappa G)
};

}  // namespace breccia

BRECCIA_CONTACT_LAW(breccia::BeamBond, "beam_bond")
