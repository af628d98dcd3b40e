// SPDX-License-Identifier: BSD-3-Clause
/// What tests along one axis can be told: direction, stages, when they end.
#pragma once

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "breccia/protocol_tools/platens.hpp"
#include "breccia/protocol_tools/stages.hpp"

namespace breccia {

enum class LoadingAxis { specimen, x, y, z };

template <class Config>
void describe_loading_axis(Schema<Config>& s) {
  s.param("axis", &Config::axis)
      .choice("specimen", LoadingAxis::specimen, "the axis of the packing")
      .choice("x", LoadingAxis::x, "for a box")
      .choice("y", LoadingAxis::y, "for a box")
      .choice("z", LoadingAxis::z, "for a box")
      .fallback("specimen")
      .doc("direction of the loading");
}

/// The specimen as seen along that direction. UserError for a direction that it cannot be loaded in.
inline SpecimenShape specimen_along(LoadingAxis wanted, const SimulationView& view, LoadControl& control) {
  if (wanted == LoadingAxis::specimen) return view.specimen;
  const Vec3 axis = Vec3::Unit(int(wanted) - 1);
  if (view.specimen.outline == SpecimenShape::Outline::cylinder && std::abs(axis.dot(view.specimen.axis)) < 0.999)
    throw UserError("protocol: a cylinder is loaded along its own axis: leave `axis` out");
  if (view.dimension == 2 && wanted == LoadingAxis::z)
    throw UserError("protocol: in two dimensions the axis is x or y");
  return control.set_specimen_axis(axis);
}

/// Strain at which a specimen of its bonds' modulus is surely loaded, and not just touched by a platen.
constexpr double strain_of_touch = 1e-4;

/// UserError for a pressure all round that a specimen of such bonds cannot be led to: it is led at the rate of the
/// test, and a run would go on for hours toward what is a slip of a unit.
inline void refuse_pressure_out_of_reach(double pressure, const BondStiffness& bonds) {
  if (!(pressure > 0)) return;
  if (!(bonds.modulus > 0))
    throw UserError(
        "protocol: without bonds there is no stiffness by which a pressure could be led: bond the particles first");
  constexpr double most = 0.5;  // strain: over the bonds' modulus all of the specimen would be overlap
  if (pressure <= most * bonds.modulus) return;
  char text[220];
  std::snprintf(text, sizeof text,
                "protocol: a pressure of %.4g Pa is %.3g times the modulus of the bonds (%.4g Pa): no specimen carries "
                "it; check its unit, and that of the modulus",
                pressure, pressure / bonds.modulus, bonds.modulus);
  throw UserError(text);
}

template <class Config>
void describe_failure_stress(Schema<Config>& s) {
  s.param("failure_stress", &Config::failure_stress)
      .unit("Pa")
      .at_least(0)
      .example("5 MPa")
      .doc(
          "a stress drop counts as failure only if the peak was above this; if it is not given, the stress of a strain "
          "of 1e-4 at the modulus of the bonds");
}

/// A drop of the stress that lasts, and is no wave passing by: to a share of the peak, for a while.
class StressDrop {
 public:
  /// Each step; `low`: the stress is below that share now [s].
  bool lasts(bool low, double time, double while_) {
    if (!low) since_ = -1;
    else if (since_ < 0) since_ = time;
    return low && time - since_ >= while_;
  }

 private:
  double since_ = -1;
};

/// To be inherited by a protocol's configuration.
struct AxialConfig : PlatenConfig {
  LoadingAxis axis;
  std::optional<double> max_strain;
  double stop_stress_ratio;
  std::optional<double> failure_stress;
  std::optional<std::vector<Stage>> stages;
};

/// `stop_stress_ratio` is the default of that parameter.
template <class Config>
void describe_axial(Schema<Config>& s, double stop_stress_ratio) {
  describe_platens(s);
  describe_loading_axis(s);
  s.param("max_strain", &Config::max_strain)
      .above(0)
      .below(1)
      .example("2 %")
      .doc(
          "platen strain at which the test ends at the latest, also when a stage in stress is not reached by then; if "
          "it is not given 5 %, past the largest strain among the stages");
  s.param("stop_stress_ratio", &Config::stop_stress_ratio)
      .at_least(0)
      .below(1)
      .fallback(stop_stress_ratio)
      .doc(
          "the test ends once the deviatoric platen stress, at a strain not reached before, has fallen to this share "
          "of its peak and stayed there for a tenth of a wave's travel from end to end; 0: never for this reason");
  describe_failure_stress(s);
  s.param("stages", &Config::stages)
      .items(1, 64)
      .example("[{axial_strain: 0.5 %}, {axial_stress: 1 MPa}, {axial_strain: 1 %}]")
      .doc("targets, one after the other, instead of max_strain: loading, unloading, cycles");
}

/// Refuses stages that ask for a confining pressure, where there is none to lead.
inline void refuse_confining_stages(const AxialConfig& c, const char* why, Issues& issues) {
  if (!c.stages) return;
  for (std::size_t k = 0; k < c.stages->size(); ++k)
    if ((*c.stages)[k].confining_pressure)
      issues.push_back({"stages[" + std::to_string(k) + "].confining_pressure", why});
}

}  // namespace breccia
