// SPDX-License-Identifier: BSD-3-Clause
/// What stands around a specimen while it is loaded along its axis.
#pragma once

#include "breccia/protocol_tools/lateral_pressure.hpp"
#include "breccia/protocol_tools/smooth_ramp.hpp"

namespace breccia {

/// Nothing, unless a derived one says otherwise. Heights are above the specimen's base as first measured [m].
class Confinement {
 public:
  virtual ~Confinement() = default;
  virtual bool any() const { return false; }
  virtual void setup(const SpecimenShape&, const SimulationView&, LoadControl&, double /*platen_stiffness*/) {}
  /// A confining stage begins at `time`.
  virtual void lead_to(double /*pressure*/, double /*time*/, double /*duration*/) {}
  /// Axial loading begins or goes on; `travel` is the time of a wave from end to end.
  virtual void begin_loading(double /*time*/, double /*travel*/) {}
  virtual void apply(LoadControl&, double /*time*/, double /*low*/, double /*high*/) {}
  virtual double target() const { return 0; }  ///< where the pressure is being led [Pa]
  virtual double asked(double /*time*/, double achieved) const { return achieved; }  ///< at this moment [Pa]
  /// Mean normal stress on the lateral surface, in the last step [Pa].
  virtual double achieved(const LoadControl&) const { return 0; }
  virtual void finish(const SimulationView&, Summary&) {}
  virtual void archive(Archive&) {}  ///< what changes while it runs
};

/// UserError where the specimen has no surface to be confined at.
inline void refuse_no_sides(const SimulationView& view) {
  if (view.cell.repeats())
    throw UserError(
        "protocol: where space repeats itself (`periodic`) a specimen has no sides to be confined at: use the protocol "
        "periodic_cell, which leads the stress of the whole");
}

/// A fluid's pressure, led to its value by confining stages; or, as a jacket, to a given value when loading begins.
class PressureConfinement final : public Confinement {
 public:
  explicit PressureConfinement(PressureArea rule, double jacket_pressure = 0) : rule_(rule), jacket_(jacket_pressure) {}
  bool any() const override { return true; }
  void setup(const SpecimenShape& shape, const SimulationView& view, LoadControl& control, double) override {
    refuse_no_sides(view);
    if (shape.outline != SpecimenShape::Outline::cylinder && shape.outline != SpecimenShape::Outline::box)
      throw UserError(
          "protocol: lateral pressure needs a cylinder, a box or a rectangle: choose such a container (with the "
          "packing "
          "from_file such an `outline`)");
    surface_.emplace(shape, control.particles(), view, rule_);
    if (surface_->particles() == 0)
      throw UserError("protocol: no particle is seen on the lateral surface of the specimen");
  }
  void lead_to(double pressure, double time, double duration) override { ramp_.lead_to(pressure, time, duration); }
  void begin_loading(double time, double travel) override {
    if (jacket_ > 0) ramp_.lead_to(jacket_, time, 10 * travel);
  }
  void apply(LoadControl& control, double time, double low, double high) override {
    surface_->apply(control, ramp_.at(time), low, high);
  }
  double target() const override { return ramp_.target(); }
  double asked(double time, double) const override { return ramp_.at(time); }
  double achieved(const LoadControl&) const override { return surface_->achieved(); }
  void finish(const SimulationView&, Summary& summary) override {
    summary.own("confined_particles", surface_->particles());
    summary.own({"lateral_surface_area", "m2"}, surface_->surface_area());
    summary.own("disc_area_over_lateral_surface", surface_->disc_area_ratio());
    summary.own({"confining_pressure_asked", "Pa"}, ramp_.target());
    summary.own({"confining_pressure_applied", "Pa"}, surface_->achieved());
  }
  void archive(Archive& archive) override {
    archive("ramp", ramp_);
    archive("surface", *surface_);
  }

 private:
  PressureArea rule_;
  double jacket_;
  std::optional<LateralPressure> surface_;
  SmoothRamp ramp_;
};

/// A rigid, frictionless cell that lets nothing out: a cylinder, or the sides of a box or rectangle.
class RigidConfinement final : public Confinement {
 public:
  explicit RigidConfinement(std::optional<double> stiffness) : stiffness_(stiffness) {}
  bool any() const override { return true; }
  void setup(const SpecimenShape& shape, const SimulationView& view, LoadControl& control,
             double platen_stiffness) override {
    refuse_no_sides(view);
    const double k = used_ = stiffness_.value_or(platen_stiffness);
    height_ = shape.height;
    if (shape.outline == SpecimenShape::Outline::cylinder) {
      radius_ = std::sqrt(shape.cross_section_area / std::numbers::pi);
      walls_.push_back(control.add_wall({"cell", shape.base, shape.axis, k, 0, 0, radius_}));
      width_ = 2 * std::numbers::pi * radius_;
      return;
    }
    if (shape.outline != SpecimenShape::Outline::box)
      throw UserError(
          "protocol: a rigid cell needs a cylinder, a box or a rectangle: choose such a container (with the packing "
          "from_file such an `outline`)");
    const Vec3 middle = shape.base + 0.5 * shape.height * shape.axis;
    for (int axis = 0; axis < view.dimension; ++axis) {
      const Vec3 out = Vec3::Unit(axis);
      if (std::abs(out.dot(shape.axis)) > 0.5) continue;
      const double half = 0.5 * shape.extent[axis];
      const char name = "xyz"[axis];
      walls_.push_back(control.add_wall({std::string("cell_low_") + name, middle - half * out, out, k, 0, 0}));
      walls_.push_back(control.add_wall({std::string("cell_high_") + name, middle + half * out, -out, k, 0, 0}));
      width_ += 2 * shape.cross_section_area / shape.extent[axis];
    }
  }
  void apply(LoadControl&, double, double low, double high) override { height_ = high - low; }
  double achieved(const LoadControl& control) const override {
    double force = 0;
    for (const std::size_t w : walls_) force += control.wall_normal_force(w);
    return force / (width_ * height_);
  }
  void finish(const SimulationView& view, Summary& summary) override {
    // How far the penalty springs let the surface out, as a strain: what "no lateral strain" came to.
    double force = 0;
    std::size_t contacts = 0;
    for (const std::size_t w : walls_) {
      force += view.walls[w].normal_force;
      contacts += view.walls[w].contacts;
    }
    summary.own({"cell_pressure_at_end", "Pa"}, force / (width_ * height_));
    summary.own("cell_contacts", contacts);
    if (contacts > 0) summary.own({"mean_overlap_with_cell", "m"}, force / double(contacts) / used_);
  }
  void archive(Archive& archive) override { archive("height", height_); }

 private:
  std::optional<double> stiffness_;
  double radius_ = 0, width_ = 0, height_ = 0, used_ = 0;
  std::vector<std::size_t> walls_;
};

}  // namespace breccia
