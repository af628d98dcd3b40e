// SPDX-License-Identifier: BSD-3-Clause
/// A fluid's pressure on the lateral surface: a force on each particle of the surface, normal to it.
#pragma once

#include <optional>

#include "breccia/protocol_tools/lateral_surface.hpp"

namespace breccia {

/// Which area a surface particle offers to the pressure.
enum class PressureArea { voronoi, disc };

template <class Config>
void describe_pressure_area(Schema<Config>& s, PressureArea Config::*member) {
  s.param("pressure_area", member)
      .choice("voronoi", PressureArea::voronoi,
              "Voronoi cell on the unrolled surface, weighted by the radii: the forces add up to pressure times "
              "surface")
      .choice("disc", PressureArea::disc,
              "pi r^2 (2 r times the thickness in two dimensions), as in Oñate et al. (2015); the "
              "forces add up to what the cross-sections of the surface particles happen to cover")
      .doc("area of a particle of the lateral surface on which the confining pressure acts")
      .source("Cheung, O'Sullivan (2008), Particuology 6, 483-500; Oñate et al. (2015), section 10.1.1")
      .fallback("voronoi");
}

class LateralPressure {
 public:
  LateralPressure(const SpecimenShape& shape, const ParticlesView& particles, const Space& space, PressureArea rule)
      : surface_(shape, particles, space.dimension, space.thickness), rule_(rule) {
    surface_.measure(particles, 0, shape.height);
  }

  /// Each step; heights of the two ends above the specimen's base [m]. The surface is measured every `interval` steps.
  void apply(LoadControl& control, double pressure, double low, double high) {
    if (steps_++ % interval == 0) {
      surface_.measure(control.particles(), low, high);
      stale_ = true;
    }
    if (pressure == pressure_ && !stale_) return;
    pressure_ = pressure;
    stale_ = false;
    const ParticlesView p = control.particles();
    // Who is no longer of the surface is left alone; a particle on an edge has a cell on both faces.
    for (Force& f : forces_) f = {f.particle, Vec3::Zero(), Mat3::Zero()};
    applied_ = 0;
    for (const SurfaceCell& c : surface_.cells()) {
      const double size = pressure * (rule_ == PressureArea::voronoi ? c.area : c.disc);
      applied_ += size;
      forces_.push_back({c.particle, size * c.inward, -p.radius[c.particle] * size * c.inward * c.inward.transpose()});
    }
    std::stable_sort(forces_.begin(), forces_.end(),
                     [](const Force& a, const Force& b) { return a.particle < b.particle; });
    std::size_t distinct = 0;
    for (std::size_t k = 0; k < forces_.size();) {
      Force sum = forces_[k];
      for (++k; k < forces_.size() && forces_[k].particle == sum.particle; ++k) {
        sum.force += forces_[k].force;
        sum.moment += forces_[k].moment;
      }
      control.set_applied_force(sum.particle, sum.force, Vec3::Zero(), sum.moment);
      if (!sum.force.isZero(0)) forces_[distinct++] = sum;
    }
    forces_.resize(distinct);
  }

  double surface_area() const { return surface_.area(); }  // [m2]
  /// Sum of the forces over the surface as it is now [Pa].
  double achieved() const { return surface_.area() > 0 ? applied_ / surface_.area() : 0.0; }
  double disc_area_ratio() const { return surface_.area() > 0 ? surface_.disc_area() / surface_.area() : 0.0; }
  std::size_t particles() const { return surface_.cells().size(); }
  void archive(Archive& archive) {
    archive("surface", surface_);
    archive.records("forces", forces_, std::pair("particle", &Force::particle), std::pair("force", &Force::force),
                    std::pair("moment", &Force::moment));
    archive("steps", steps_);
    archive("pressure", pressure_);
    archive("applied", applied_);
    archive("stale", stale_);
  }

 private:
  static constexpr std::size_t interval = 100;
  struct Force {
    Index particle;
    Vec3 force;
    Mat3 moment;
  };
  LateralSurface surface_;
  PressureArea rule_;
  std::vector<Force> forces_;
  std::size_t steps_ = 0;
  double pressure_ = 0, applied_ = 0;
  bool stale_ = true;
};

}  // namespace breccia
