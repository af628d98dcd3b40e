// SPDX-License-Identifier: BSD-3-Clause
/// The law itself, for one layout of elements.
/// Sources: Potyondy (2012), A flat-jointed bonded-particle material for hard rock, ISRM ARMS7, Seoul; Potyondy
/// (2018), A flat-jointed bonded-particle model for rock. README.md has the equations and what is our own.
#pragma once

#include "config.hpp"
#include "state.hpp"

namespace breccia::flat_joint {

/// Of the face of j relative to that of i, by the axes of the interface.
struct FaceMotion {
  double opening, shear_1 = 0, shear_2 = 0, bending_1 = 0, bending_2 = 0, twist = 0;
};

/// Two axes in the plane of an interface.
struct Axes {
  double x1, y1, z1, x2, y2, z2;
  bool known;  ///< laid down for good; before, the pair has only been moved in ways that look the same along any axes
};

/// What the elements add up to, per area of one; moments over the lever as well.
struct Sum {
  double normal = 0, shear_1 = 0, shear_2 = 0, moment_1 = 0, moment_2 = 0, torsion = 0;
  double friction = 0, fracture = 0;
  double still_to_tell, bonded_elements = 0, bonded = 0, torn = 0, pressing = 0;
};

template <class Layout>
struct Law {
  using Config = flat_joint::Config;
  static void describe(Schema<Config>& s) { flat_joint::describe(s); }
  using State = History<Layout>;
  static constexpr int count = Layout::count;
  static constexpr bool space = Layout::dimension == 3;
  static constexpr auto columns = history_columns<Layout>(std::make_index_sequence<std::size_t(count)>{});
  static constexpr bool has_moments = true;
  static constexpr bool respects_protection = true;
  static constexpr auto per_bond() {
    return std::array{PerBond<Law>{"bond_modulus", &Law::modulus}, PerBond<Law>{"tensile_strength", &Law::strength},
                      PerBond<Law>{"cohesion", &Law::cohesion}};
  }

  Law(const Config& c, const Assembly& a)
      : modulus(c.bond_modulus.value_or(0)),
        stiffness_constant(c.normal_stiffness.value_or(0)),
        inverse_ratio(1 / c.stiffness_ratio),
        multiplier(c.radius_multiplier),
        strength(c.tensile_strength),
        cohesion(c.cohesion),
        internal_friction(std::tan(c.internal_friction_angle)),
        friction(c.friction),
        breadth(2 * a.thickness) {
    if (a.dimension == Layout::dimension) return;
    throw UserError(space ? "contact_law flat_joint: `elements: disc_...` is how faces of spheres are divided; in two "
                            "dimensions write `line_4`, or line_2, line_8"
                          : "contact_law flat_joint: `elements: line_...` is how faces of discs are divided, in two "
                            "dimensions; between spheres write `disc_1x4`, or disc_1x3, disc_2x4");
  }

  BRECCIA_KERNEL State initial(const Contact& c) const {
    State s{};
    const double has_faces = c.intact > 0.5 ? 1.0 : 0.0;
    s.bonded_elements = has_faces * double((1 << count) - 1);
    s.bonded_share = s.faces = has_faces;
    return s;
  }

  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    const double radius = face_radius(c), lever = radius * s.faces;
    const double kn = normal_stiffness(c), ks = kn * inverse_ratio;
    const bool has_faces = s.faces > 0.5;
    const Axes axes = axes_of(c, s, radius);
    const FaceMotion before = motion(s, opening(c, s) - c.normal_velocity * c.time_step);
    const FaceMotion now = moved(c, s, axes, before);

    Sum sum;
    const double bonded_before = s.bonded_elements * c.intact;
    sum.still_to_tell = bonded_before;
    const bool breakable = c.breakable > 0.5;
    for_each([&](auto k) __attribute__((always_inline)) { element<k>(s, now, before, lever, kn, ks, breakable, sum); });

    const bool none = sum.bonded < 0.5;
    // Faces that have parted by their diameter are none any more: what is left is a point contact, as between particles
    // that were never bonded, and one that is free of force then.
    const double way_2 = now.shear_1 * now.shear_1 + now.shear_2 * now.shear_2 +
                         (c.distance - c.rest_length) * (c.distance - c.rest_length);
    const bool parted = !has_faces | (way_2 > 4 * radius * radius);
    const bool anew = none & parted & (sum.pressing < 0.5) & (c.distance >= c.free_length());
    s.bonded_elements = sum.bonded_elements;
    s.bonded_share = sum.bonded * (1.0 / count);
    s.faces = anew ? 0.0 : s.faces;
    s.gap = anew ? 0.0 : s.gap;
    keep(s, now, axes, anew);

    const double area = element_area(radius), arm = area * lever;
    ContactForce f;
    f.normal = area * sum.normal;
    f.shear_x = area * (sum.shear_1 * axes.x1 + sum.shear_2 * axes.x2);
    f.shear_y = area * (sum.shear_1 * axes.y1 + sum.shear_2 * axes.y2);
    f.shear_z = area * (sum.shear_1 * axes.z1 + sum.shear_2 * axes.z2);
    f.moment_x = arm * (sum.moment_1 * axes.x1 + sum.moment_2 * axes.x2 + sum.torsion * c.nx);
    f.moment_y = arm * (sum.moment_1 * axes.y1 + sum.moment_2 * axes.y2 + sum.torsion * c.ny);
    f.moment_z = arm * (sum.moment_1 * axes.z1 + sum.moment_2 * axes.z2 + sum.torsion * c.nz);
    const double torn = sum.torn > 0.5 ? double(BondState::broken_tension) : double(BondState::broken_shear);
    const double ended = bonded_before > 0.5 ? torn : 0.0;
    f.breaks = sum.bonded < 0.5 ? ended : 0.0;
    f.friction_work = area * sum.friction;
    f.fracture_energy = area * sum.fracture;
    return f;
  }

  BRECCIA_KERNEL double energy(const Contact& c, const State& s) const {
    const double radius = face_radius(c), lever = radius * s.faces, kn = normal_stiffness(c);
    const FaceMotion now = motion(s, opening(c, s));
    double left = s.bonded_elements * c.intact, sum = 0;
    for_each([&](auto k) __attribute__((always_inline)) {
      const bool bonded = told<k>(left);
      const double g = gap<k>(now, lever), t1 = slide_1<k>(now, lever) - slid_1<k>(s),
                   t2 = slide_2<k>(now, lever) - slid_2<k>(s);
      sum += (bonded | (g < 0) ? g * g : 0.0) + inverse_ratio * (t1 * t1 + t2 * t2);
    });
    return 0.5 * kn * element_area(radius) * sum;
  }

  /// That of whole faces, which nothing of them exceeds.
  BRECCIA_KERNEL ContactStiffness stiffness(const Contact& c) const {
    const double radius = face_radius(c), normal = normal_stiffness(c) * count * element_area(radius);
    const double bending = normal * radius * radius * mean_square<Layout>();
    return {normal, normal * inverse_ratio, bending, space ? 2 * bending * inverse_ratio : 0.0};
  }

 private:
  template <class F>
  BRECCIA_KERNEL static void for_each(F&& f) {
    downwards(f, std::make_index_sequence<std::size_t(count)>{});
  }
  /// From the last to the first, as binary digits are told.
  template <class F, std::size_t... k>
  BRECCIA_KERNEL static void downwards(F&& f, std::index_sequence<k...>) {
    (f(std::integral_constant<int, count - 1 - int(k)>{}), ...);
  }
  template <int k>
  BRECCIA_KERNEL static bool told(double& left) {
    constexpr double digit = double(1 << k);
    const bool bonded = left >= digit;
    left -= bonded ? digit : 0.0;
    return bonded;
  }

  BRECCIA_KERNEL double face_radius(const Contact& c) const {
    return multiplier * (c.radius_i < c.radius_j ? c.radius_i : c.radius_j);
  }
  BRECCIA_KERNEL double element_area(double radius) const {
    if constexpr (space) return std::numbers::pi / count * radius * radius;
    else return breadth * radius * (1.0 / count);
  }
  BRECCIA_KERNEL double normal_stiffness(const Contact& c) const { return stiffness_constant + modulus / c.touching(); }
  BRECCIA_KERNEL static double opening(const Contact& c, const State& s) {
    return c.distance - (s.faces > 0.5 ? c.rest_length - s.gap : c.free_length());
  }

  // How far the faces are apart at an element, and how far it is sheared [m].
  template <int k>
  BRECCIA_KERNEL static double gap(const FaceMotion& m, double lever) {
    constexpr Point at = Layout::at(k);
    if constexpr (space) return m.opening + lever * (m.bending_1 * at.y - m.bending_2 * at.x);
    else return m.opening - lever * m.bending_2 * at.x;
  }
  template <int k>
  BRECCIA_KERNEL static double slide_1(const FaceMotion& m, double lever) {
    if constexpr (space) return m.shear_1 - m.twist * (lever * Layout::at(k).y);
    else return m.shear_1;
  }
  template <int k>
  BRECCIA_KERNEL static double slide_2(const FaceMotion& m, double lever) {
    if constexpr (space) return m.shear_2 + m.twist * (lever * Layout::at(k).x);
    else return 0;
  }
  template <int k>
  BRECCIA_KERNEL static double slid_1(const State& s) {
    return static_cast<const Slid<Layout::dimension, k>&>(s).slid_1;
  }
  template <int k>
  BRECCIA_KERNEL static double slid_2(const State& s) {
    if constexpr (space) return static_cast<const Slid<3, k>&>(s).slid_2;
    else return 0;
  }

  template <int k>
  BRECCIA_KERNEL void element(State& s, const FaceMotion& now, const FaceMotion& before, double lever, double kn,
                              double ks, bool breakable, Sum& sum) const {
    constexpr Point at = Layout::at(k);
    const bool bonded = told<k>(sum.still_to_tell);
    const double g = gap<k>(now, lever), whole = kn * g, pressed = g < 0 ? whole : 0.0;
    const double at_1 = slide_1<k>(now, lever), at_2 = slide_2<k>(now, lever);
    const double x = at_1 - slid_1<k>(s), y = at_2 - slid_2<k>(s);
    const double old_x = slide_1<k>(before, lever) - slid_1<k>(s), old_y = slide_2<k>(before, lever) - slid_2<k>(s);
    double spring;
    if constexpr (space) spring = std::sqrt(x * x + y * y);
    else spring = std::abs(x);

    const bool torn = bonded & breakable & (whole >= strength);
    const bool sheared = bonded & breakable & !torn & (ks * spring >= cohesion - internal_friction * whole);
    const bool broke = torn | sheared, holds = bonded & !broke;
    const CoulombSlip slip = coulomb_slip(ks, spring, old_x * x + old_y * y, -friction * pressed, !holds);
    const double stress = holds ? whole : pressed, shear_1 = ks * (slip.keep * x), shear_2 = ks * (slip.keep * y);

    static_cast<Slid<Layout::dimension, k>&>(s).slid_1 = slip.slides ? at_1 - slip.keep * x : slid_1<k>(s);
    if constexpr (space) static_cast<Slid<3, k>&>(s).slid_2 = slip.slides ? at_2 - slip.keep * y : slid_2<k>(s);

    constexpr double digit = double(1 << k);
    sum.bonded_elements += holds ? digit : 0.0;
    sum.bonded += holds ? 1.0 : 0.0;
    sum.torn += torn ? 1.0 : 0.0;
    sum.pressing += stress < 0 ? 1.0 : 0.0;
    sum.normal += stress;
    sum.shear_1 += shear_1;
    sum.moment_2 -= stress * at.x;
    if constexpr (space) {
      sum.shear_2 += shear_2;
      sum.moment_1 += stress * at.y;
      sum.torsion += shear_2 * at.x - shear_1 * at.y;
    }
    // An element that breaks loses what it had stored, less what it goes on storing; and less the work that the stress
    // it lost did not do in this step any more, as leapfrog has it (the way times the mean of before and after).
    const double lost = 0.5 * (whole - pressed) * gap<k>(before, lever);
    sum.fracture += broke ? slip.work + lost : 0.0;
    sum.friction += broke ? 0.0 : slip.work;
  }

  BRECCIA_KERNEL static FaceMotion motion(const State& s, double opening) {
    FaceMotion m;
    m.opening = opening;
    m.shear_1 = s.shear_1;
    m.bending_2 = s.bending_2;
    if constexpr (space) {
      m.shear_2 = s.shear_2;
      m.bending_1 = s.bending_1;
      m.twist = s.twist;
    }
    return m;
  }
  /// By the step that led here. A point contact has nothing that bends or twists.
  BRECCIA_KERNEL static FaceMotion moved(const Contact& c, const State& s, const Axes& a, const FaceMotion& before) {
    const double bends = s.faces, known = a.known ? 1.0 : 0.0;
    FaceMotion m = before;
    m.opening = opening(c, s);
    m.shear_1 += known * (c.shear_x * a.x1 + c.shear_y * a.y1 + c.shear_z * a.z1);
    if constexpr (space) {
      m.shear_2 += known * (c.shear_x * a.x2 + c.shear_y * a.y2 + c.shear_z * a.z2);
      m.bending_1 += bends * known * (c.turn_x * a.x1 + c.turn_y * a.y1 + c.turn_z * a.z1);
      m.bending_2 += bends * known * (c.turn_x * a.x2 + c.turn_y * a.y2 + c.turn_z * a.z2);
      m.twist += bends * (c.turn_x * c.nx + c.turn_y * c.ny + c.turn_z * c.nz);
    } else {
      m.bending_2 += bends * c.turn_z;
    }
    return m;
  }
  BRECCIA_KERNEL static void keep(State& s, const FaceMotion& m, const Axes& a, bool anew) {
    s.shear_1 = anew ? 0.0 : m.shear_1;
    s.bending_2 = anew ? 0.0 : m.bending_2;
    if constexpr (space) {
      s.shear_2 = anew ? 0.0 : m.shear_2;
      s.bending_1 = anew ? 0.0 : m.bending_1;
      s.twist = anew ? 0.0 : m.twist;
      const bool keeps = a.known & !anew;
      s.axis_x = keeps ? a.x1 : 0.0;
      s.axis_y = keeps ? a.y1 : 0.0;
      s.axis_z = keeps ? a.z1 : 0.0;
    }
    for_each([&](auto k) __attribute__((always_inline)) {
      auto& slid = static_cast<Slid<Layout::dimension, k>&>(s);
      slid.slid_1 = anew ? 0.0 : slid.slid_1;
      if constexpr (space) slid.slid_2 = anew ? 0.0 : slid.slid_2;
    });
  }

  /// The first axis is laid down along the first bending or shear of the pair and follows it from there: no direction
  /// of space is preferred. What comes before it (opening, twist) is the same along any axes.
  BRECCIA_KERNEL static Axes axes_of(const Contact& c, const State& s, double radius) {
    if constexpr (!space) {
      return {-c.ny, c.nx, 0, 0, 0, 1, true};
    } else {
      const PlaneVector old = follow_plane(c, s.axis_x, s.axis_y, s.axis_z);
      const bool was = s.axis_x * s.axis_x + s.axis_y * s.axis_y + s.axis_z * s.axis_z > 0.25;
      const double turned = c.turn_x * c.nx + c.turn_y * c.ny + c.turn_z * c.nz;
      const double bx = radius * (c.turn_x - turned * c.nx), by = radius * (c.turn_y - turned * c.ny),
                   bz = radius * (c.turn_z - turned * c.nz);
      const double bent_2 = bx * bx + by * by + bz * bz,
                   sheared_2 = c.shear_x * c.shear_x + c.shear_y * c.shear_y + c.shear_z * c.shear_z;
      const bool bends = bent_2 > sheared_2;
      const double way = c.normal_velocity * c.time_step, twist = radius * turned;
      // More than the rounding of what else has moved.
      const bool starts = (bends ? bent_2 : sheared_2) > 1e-20 * (way * way + twist * twist);
      const bool along_x = std::abs(c.nx) < 0.6;  // any axis does as long as none is laid down
      const double any_x = along_x ? 1.0 : 0.0, any_y = along_x ? 0.0 : 1.0;
      double x = was ? old.x : starts ? (bends ? bx : c.shear_x) : any_x;
      double y = was ? old.y : starts ? (bends ? by : c.shear_y) : any_y;
      double z = was ? old.z : starts ? (bends ? bz : c.shear_z) : 0.0;
      const double off = x * c.nx + y * c.ny + z * c.nz;
      x -= off * c.nx;
      y -= off * c.ny;
      z -= off * c.nz;
      const bool known = was | starts;
      const double square = x * x + y * y + z * z, inverse = 1 / std::sqrt(square > 0 ? square : 1.0);
      x *= inverse;
      y *= inverse;
      z *= inverse;
      return {x, y, z, c.ny * z - c.nz * y, c.nz * x - c.nx * z, c.nx * y - c.ny * x, known};
    }
  }

  double modulus, stiffness_constant, inverse_ratio, multiplier;  // E [Pa], k_n [Pa/m], k_s/k_n, lambda
  double strength, cohesion, internal_friction, friction;         // sigma_t, c [Pa], tan(phi), mu
  double breadth;                                                 // 2 t, of discs [m]
};

}  // namespace breccia::flat_joint
