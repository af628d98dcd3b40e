// SPDX-License-Identifier: BSD-3-Clause
/// Brittle bonds with a Mohr-Coulomb limit in shear and friction afterwards, and smooth joints.
/// Sources: Scholtes, Donze (2012), Int. J. Rock Mech. Min. Sci. 52, 18-30; (2013), J. Mech. Phys. Solids 61, 352-369;
/// Mas Ivars et al. (2011), Int. J. Rock Mech. Min. Sci. 48, 219-244 (smooth joint). README.md has the equations.
#include "../../shared/bond_section.hpp"
#include "config.hpp"
#include "motion.hpp"

namespace breccia::jcfpm {

struct Law {
  using Config = jcfpm::Config;
  static void describe(Schema<Config>& s) { jcfpm::describe(s); }

  struct State {
    double spring_x, spring_y, spring_z;
    double opening,
        side;  ///< of a smooth joint: along its normal; which way that points from i: 1, -1, 0 without contact
  };
  static constexpr std::array columns{StateColumn<State>{&State::spring_x, "shear_spring_x", "m"},
                                      StateColumn<State>{&State::spring_y, "shear_spring_y", "m"},
                                      StateColumn<State>{&State::spring_z, "shear_spring_z", "m"},
                                      StateColumn<State>{&State::opening, "joint_opening", "m"},
                                      StateColumn<State>{&State::side, "joint_side", "1"}};
  static constexpr bool respects_protection = true;
  static constexpr auto per_bond() {
    return std::array{
        PerBond<Law>{"bond_modulus", &Law::modulus}, PerBond<Law>{"normal_stiffness", &Law::stiffness_per_area},
        PerBond<Law>{"tensile_strength", &Law::tensile_strength}, PerBond<Law>{"cohesion", &Law::cohesion}};
  }

  Law(const Config& c, const Assembly& a)
      : modulus(a.dimension == 2 ? 0 : c.bond_modulus.value_or(0)),
        breadth_modulus(a.dimension == 2 ? c.bond_modulus.value_or(0) * a.thickness : 0),
        stiffness_per_area(c.normal_stiffness.value_or(0)),
        inverse_ratio(1 / c.stiffness_ratio),
        tensile_strength(c.tensile_strength),
        cohesion(c.cohesion),
        internal_friction(std::tan(c.internal_friction_angle)),
        friction(c.friction),
        dilation(std::tan(c.dilation_angle)),
        smooth(c.smooth_joint ? 1 : 0),
        section(1, a) {
    if (!c.smooth_joint) return;
    const Vec3 normal = c.joint_normal->normalized();
    if (a.dimension == 2 && std::abs(normal.z()) > 1e-6)
      throw UserError("contact_law jcfpm: in two dimensions the third component of `joint_normal` must be 0");
    joint_x = normal.x(), joint_y = normal.y(), joint_z = normal.z();
  }

  BRECCIA_KERNEL State initial(const Contact& c) const {
    const double towards = c.nx * joint_x + c.ny * joint_y + c.nz * joint_z;
    State s;
    s.spring_x = s.spring_y = s.spring_z = s.opening = 0;
    s.side = (c.intact > 0.5 ? smooth : 0.0) * (towards < 0 ? -1.0 : 1.0);
    return s;
  }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double area = strength_area(c), kn = normal_stiffness(c, area), ks = kn * inverse_ratio;
    const bool was = c.intact > 0.5, breakable = c.breakable > 0.5;
    const double plain = 1 - smooth;  // numbers, not conditions: branches that agree for all pairs stop the vector loop

    // A joint's contact begins when the grains touch, whatever the height at which they meet, and ends when their
    // shadows on its plane part, or it gapes so far that they are strangers again.
    const double towards = c.nx * joint_x + c.ny * joint_y + c.nz * joint_z;
    const double sum = c.touching(), beside2 = c.distance * c.distance * (1 - towards * towards);
    const double known = s.side * s.side, side = s.side + (1 - known) * (towards < 0 ? -1.0 : 1.0);
    // Grains side by side in the joint's plane are on no sides of it.
    const double meets = (c.distance < c.rest_length) & (towards * towards > 1e-6) ? smooth * (1 - known) : 0.0;
    const double may_leave = was ? 0.0 : smooth * known;
    const double leaves = (beside2 >= sum * sum) | (s.opening >= sum) ? may_leave : 0.0;
    const double touches = plain + smooth * known - leaves;

    // Along the normal and in the plane of the contact: those of the line of centres, or of the joint.
    const double ax = side * joint_x + plain * c.nx, ay = side * joint_y + plain * c.ny,
                 az = side * joint_z + plain * c.nz;
    const PlaneVector moved = motion_of_contact(c), followed = follow_plane(c, s.spring_x, s.spring_y, s.spring_z);
    const double parts = moved.x * ax + moved.y * ay + moved.z * az;
    const double apart = c.distance - c.rest_length;
    const double before = s.opening + plain * (apart - c.normal_velocity * c.time_step),
                 opened = s.opening + smooth * parts + plain * apart;
    const double old_x = smooth * s.spring_x + plain * followed.x, old_y = smooth * s.spring_y + plain * followed.y,
                 old_z = smooth * s.spring_z + plain * followed.z;
    const double x = old_x + smooth * (moved.x - parts * ax) + plain * c.shear_x,
                 y = old_y + smooth * (moved.y - parts * ay) + plain * c.shear_y,
                 z = old_z + smooth * (moved.z - parts * az) + plain * c.shear_z;
    const double size = std::sqrt(x * x + y * y + z * z), along = old_x * x + old_y * y + old_z * z;

    const double bonded = kn * opened, trial = ks * size;
    const bool tension = breakable & (bonded > tensile_strength * area);
    const bool sheared = breakable & !tension & (trial > cohesion * area - internal_friction * bonded);
    const bool broke = tension | sheared, holds = was & !broke;

    // What slides on an open-mouthed joint wedges it open: by `tan(psi)` of the slide, which presses it more and so
    // stops the slide earlier.
    const double pushed = opened < 0 ? -bonded : 0.0;
    const double dilates = was ? 0.0 : dilation, wedge = opened < 0 ? dilates : 0.0;
    const double excess = trial - friction * pushed, slide = (excess > 0 ? excess : 0.0) / (ks + friction * kn * wedge);
    const double limit = friction * (pushed + kn * wedge * slide);
    const CoulombSlip slip = coulomb_slip(ks, size, along, limit, !holds);
    const double lifted = wedge * slide, rests = opened - lifted, keep = touches * slip.keep;
    const double stretch = holds | (rests < 0) ? touches * rests : 0.0;

    s.spring_x = keep * x;
    s.spring_y = keep * y;
    s.spring_z = keep * z;
    s.opening = smooth * touches * rests;
    s.side = (smooth * touches + meets) * side;

    const double push = kn * stretch, fx = push * ax + ks * s.spring_x, fy = push * ay + ks * s.spring_y,
                 fz = push * az + ks * s.spring_z;
    ContactForce f;
    f.normal = fx * c.nx + fy * c.ny + fz * c.nz;
    f.shear_x = fx - f.normal * c.nx;
    f.shear_y = fy - f.normal * c.ny;
    f.shear_z = fz - f.normal * c.nz;
    f.breaks = tension ? double(BondState::broken_tension) : sheared ? double(BondState::broken_shear) : 0.0;
    // By the work of leapfrog, the way times the mean of the forces: what the spring that tore had stored, what slides,
    // less what the wedge has pushed back, and what a joint's pair still held when it parted.
    const double pulled = (before > 0 ? before : 0.0) * (opened > 0 ? opened : 0.0);
    const double held = (before < 0 ? before : 0.0), presses = rests < 0 ? rests : 0.0;
    f.fracture_energy = broke ? slip.work + 0.5 * kn * pulled : 0.0;
    f.friction_work = was ? 0.0 : touches * (slip.work + 0.5 * kn * (held + presses) * lifted);
    f.contact_work = leaves * 0.5 * (kn * held * (opened < 0 ? opened : 0.0) + ks * along);
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    const double kn = normal_stiffness(c, strength_area(c));
    const double opened = smooth > 0.5 ? s.opening : c.distance - c.rest_length;
    const double stretch = (c.intact > 0.5) | (opened < 0) ? opened : 0.0;
    const double shear2 = s.spring_x * s.spring_x + s.spring_y * s.spring_y + s.spring_z * s.spring_z;
    return 0.5 * kn * (stretch * stretch + inverse_ratio * shear2);
  }

  /// A joint's stiff direction may lie any way to the line of centres.
  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double kn = normal_stiffness(c, strength_area(c)), ks = kn * inverse_ratio, most = kn > ks ? kn : ks;
    return {smooth > 0.5 ? most : kn, smooth > 0.5 ? most : ks, 0, 0};
  }

 private:
  BRECCIA_KERNEL double strength_area(const Contact& c) const { return section.between(c.radius_i, c.radius_j).area; }
  BRECCIA_KERNEL double normal_stiffness(const Contact& c, double area) const {
    const double harmonic = 2 * c.radius_i * c.radius_j / (c.radius_i + c.radius_j);
    return stiffness_per_area * area + modulus * harmonic + breadth_modulus;
  }

  // k_n = modulus x harmonic mean of the radii, or breadth_modulus in a plane, or stiffness_per_area A; the others are
  // 0.
  double modulus, breadth_modulus, stiffness_per_area;   // [Pa], [N/m], [Pa/m]
  double inverse_ratio;                                  // k_s/k_n
  double tensile_strength, cohesion, internal_friction;  // sigma_t, c [Pa], tan(phi)
  double friction, dilation;                             // mu, tan(psi)
  double smooth, joint_x = 0, joint_y = 0, joint_z = 0;  // 1 or 0; unit normal
  BondSection section;                                   // as broad as the smaller particle
};

}  // namespace breccia::jcfpm

BRECCIA_CONTACT_LAW(breccia::jcfpm::Law, "jcfpm")
