// SPDX-License-Identifier: BSD-3-Clause
/// Two rigid planes that face each other along an axis and move toward or away from each other.
#pragma once

#include <optional>

#include "breccia/protocol.hpp"
#include "breccia/protocol_tools/smooth_ramp.hpp"

namespace breccia {

enum class MovingPlatens { both, upper };

/// To be inherited by a protocol's configuration.
struct PlatenConfig {
  double platen_velocity, platen_friction, stiffness_ratio, ramp_time;
  std::optional<double> platen_stiffness;
  MovingPlatens moving;
};

template <class Config>
void describe_platens(Schema<Config>& s) {
  s.param("platen_velocity", &Config::platen_velocity)
      .unit("m/s")
      .above(0)
      .example("0.2 m/s")
      .doc("of each moving platen, toward the other")
      .source("Rojek et al. (2012), section 5.2: 0.2 m/s");
  s.param("moving_platens", &Config::moving)
      .choice("both", MovingPlatens::both, "each at platen_velocity")
      .choice("upper", MovingPlatens::upper, "the lower one stands")
      .fallback("both")
      .doc("which platens move");
  s.param("platen_stiffness", &Config::platen_stiffness)
      .unit("N/m")
      .above(0)
      .example("15 MN/m")
      .doc(
          "penalty stiffness of the contact of a particle with a platen; if absent twice the mean normal stiffness of "
          "the bonds")
      .source("Rojek et al. (2012), section 5.2: 15 MN/m");
  s.param("platen_friction", &Config::platen_friction)
      .at_least(0)
      .fallback(0.0)
      .doc("Coulomb coefficient between particles and platens")
      .source("Rojek et al. (2012), section 5.2: frictionless");
  s.param("platen_stiffness_ratio", &Config::stiffness_ratio)
      .above(0)
      .fallback(1.0)
      .doc("normal over shear stiffness of a platen contact; matters only with friction");
  s.param("ramp_time", &Config::ramp_time)
      .unit("s")
      .at_least(0)
      .fallback(20e-6)
      .doc("time in which the platens reach their velocity, and in which they turn round");
}

/// Heights are above the specimen's base as first measured, forces and stresses are positive in compression.
class Platens {
 public:
  void setup(LoadControl& control, const PlatenConfig& c, const Vec3& lower, const Vec3& upper) {
    axis_ = (upper - lower).normalized();
    moving_ = c.moving;
    ramp_time_ = c.ramp_time;
    stiffness_ = c.platen_stiffness.value_or(2 * control.bond_stiffness().mean_normal);
    if (!(stiffness_ > 0)) throw UserError("protocol: give platen_stiffness; there are no bonds to take it from");
    const double shear = c.platen_friction > 0 ? stiffness_ / c.stiffness_ratio : 0;
    lower_ = control.add_wall({"lower_platen", lower, axis_, stiffness_, shear, c.platen_friction});
    upper_ = control.add_wall({"upper_platen", upper, -axis_, stiffness_, shear, c.platen_friction});
  }

  /// Speed of each moving platen, positive when they close, reached along a smooth ramp.
  void lead_to(double speed, double time) { speed_.lead_to(speed, time, ramp_time_); }
  /// Speed at once, for a servo.
  void set(double speed) { speed_.set(speed); }
  void move(LoadControl& control) {
    const double speed = speed_.at(control.time());
    control.set_wall_velocity(lower_, moving_ == MovingPlatens::both ? Vec3(speed * axis_) : Vec3::Zero());
    control.set_wall_velocity(upper_, -speed * axis_);
  }
  double closing_speed(double time) const { return platens() * speed_.at(time); }  // [m/s]

  double force_below(const LoadControl& c) const { return -c.wall_force(lower_).dot(axis_); }  // [N]
  double force_above(const LoadControl& c) const { return c.wall_force(upper_).dot(axis_); }
  double force(const LoadControl& c) const { return 0.5 * (force_below(c) + force_above(c)); }
  double lower_rise(const LoadControl& c) const { return c.wall_displacement(lower_).dot(axis_); }  // [m]
  double upper_fall(const LoadControl& c) const { return -c.wall_displacement(upper_).dot(axis_); }
  /// By which they have come closer since the start of loading [m].
  double approach(const LoadControl& c) const { return lower_rise(c) + upper_fall(c); }
  double platens() const { return moving_ == MovingPlatens::both ? 2 : 1; }  ///< that move
  double stiffness() const { return stiffness_; }                            // [N/m]
  SmoothRamp& speed() { return speed_; }
  void archive(Archive& archive) { archive("speed", speed_); }

 private:
  Vec3 axis_ = Vec3::UnitZ();
  std::size_t lower_ = 0, upper_ = 0;
  MovingPlatens moving_ = MovingPlatens::both;
  double ramp_time_ = 0, stiffness_ = 0;
  SmoothRamp speed_;
};

}  // namespace breccia
