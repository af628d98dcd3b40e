// SPDX-License-Identifier: BSD-3-Clause
/// What a workflow says of the law.
#pragma once

#include <numbers>

#include "breccia/contact_law.hpp"

namespace breccia::jcfpm {

struct Config {
  std::optional<double> bond_modulus, normal_stiffness;
  double stiffness_ratio, tensile_strength, cohesion, internal_friction_angle, friction;
  bool smooth_joint;
  std::optional<Vec3> joint_normal;
  double dilation_angle;
};

inline void check_joint(const Config& c, Issues& issues) {
  if (c.smooth_joint && !c.joint_normal)
    issues.push_back({"joint_normal", "is missing: `smooth_joint` needs it, such as [0, 0, 1]"});
  if (!c.smooth_joint && c.joint_normal)
    issues.push_back({"joint_normal", "has no meaning without `smooth_joint: true`"});
  if (c.joint_normal && !(c.joint_normal->norm() > 1e-6))
    issues.push_back({"joint_normal", "has no direction; write one of its two normals, such as [0, 0, 1]"});
  if (!c.smooth_joint && c.dilation_angle > 0)
    issues.push_back({"dilation_angle", "has no meaning without `smooth_joint: true`"});
  if (c.smooth_joint && std::tan(c.dilation_angle) > c.friction)
    issues.push_back({"dilation_angle",
                      "must not be above the angle of `friction`, atan(friction): to slide would bring more energy "
                      "than it takes"});
}

inline void describe(Schema<Config>& s) {
  s.summary("Brittle bonds with a Mohr-Coulomb limit in shear, friction afterwards; smooth joints (JCFpm)")
      .source(
          "Scholtes, Donze (2012), Int. J. Rock Mech. Min. Sci. 52, 18-30; (2013), J. Mech. Phys. Solids 61, 352-369")
      .details(
          "k_n = 2 E R1 R2/(R1 + R2) (two dimensions: E t), k_s = k_n/(k_n/k_s). A bond breaks in tension when F_n > "
          "sigma_t A, in shear when |F_s| > c A - F_n tan(phi), tension positive, with A = pi min(R1, R2)^2 (two "
          "dimensions: 2 min(R1, R2) t). Afterwards F_n <= 0 and |F_s| <= mu |F_n|. With `smooth_joint` the same holds "
          "along the normal of a joint and in its plane, whichever way the line of centres points: pairs slide "
          "past each other without riding up. `between` says for which pairs.");
  s.exactly_one_of({"bond_modulus", "normal_stiffness"});
  s.param("bond_modulus", &Config::bond_modulus)
      .unit("Pa")
      .above(0)
      .example("40 GPa")
      .doc("equivalent modulus of bonds and contacts, E")
      .source("Scholtes & Donze (2012), Y or E_eq");
  s.param("normal_stiffness", &Config::normal_stiffness)
      .unit("Pa/m")
      .above(0)
      .example("1e13 Pa/m")
      .doc("per area A, in place of a modulus: as the stiffness of joints is measured");
  s.param("stiffness_ratio", &Config::stiffness_ratio)
      .above(0)
      .example("4")
      .doc("normal over shear stiffness, k_n/k_s: one over the sources' P");
  s.param("tensile_strength", &Config::tensile_strength)
      .unit("Pa")
      .at_least(0)
      .example("10 MPa")
      .doc("sigma_t; 0: opens without resistance");
  s.param("cohesion", &Config::cohesion).unit("Pa").at_least(0).example("40 MPa").doc("c");
  s.param("internal_friction_angle", &Config::internal_friction_angle)
      .unit("rad")
      .at_least(0)
      .below(0.5 * std::numbers::pi)
      .example("30 deg")
      .doc("of bonds, phi");
  s.param("friction", &Config::friction)
      .at_least(0)
      .example("0.5")
      .doc("Coulomb coefficient of broken and never bonded contacts: tangent of the residual angle, mu");
  s.param("smooth_joint", &Config::smooth_joint)
      .fallback(false)
      .doc("pairs lie across a plane joint, and forces act along its normal and in its plane");
  s.param("joint_normal", &Config::joint_normal)
      .unit("1")
      .items(3, 3)
      .example("[0, 0, 1]")
      .doc("of the joint, in space; length and sign do not matter");
  s.param("dilation_angle", &Config::dilation_angle)
      .unit("rad")
      .at_least(0)
      .below(0.5 * std::numbers::pi)
      .fallback(0.0)
      .doc("by which a smooth joint opens as it slides, psi");
  s.check(check_joint);
}

}  // namespace breccia::jcfpm
