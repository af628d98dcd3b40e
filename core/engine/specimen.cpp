// SPDX-License-Identifier: BSD-3-Clause
#include "engine/specimen.hpp"

#include <array>
#include <numbers>

namespace breccia {

SpecimenShape measure_specimen(Strided<const Vec3> position, Strided<const double> radius,
                               SpecimenShape::Outline outline, const Vec3& axis, const Space& space,
                               double container_volume, RankLink* link) {
  SpecimenShape s;
  s.outline = outline;
  s.axis = axis.normalized();
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  double bottom = 1e300, top = -1e300;
  for (std::size_t k = 0; k < radius.size(); ++k) {
    low = low.cwiseMin(position[k] - Vec3::Constant(radius[k]));
    high = high.cwiseMax(position[k] + Vec3::Constant(radius[k]));
    const double along = position[k].dot(s.axis);
    bottom = std::min(bottom, along - radius[k]);
    top = std::max(top, along + radius[k]);
  }
  if (link) {
    std::array<double, 8> most{-low.x(), -low.y(), -low.z(), high.x(), high.y(), high.z(), -bottom, top};
    link->largest(most);
    low = -Vec3(most[0], most[1], most[2]);
    high = Vec3(most[3], most[4], most[5]);
    bottom = -most[6];
    top = most[7];
  }
  const bool flat = space.dimension == 2;
  if (flat) {
    low.z() = -0.5 * space.thickness;
    high.z() = 0.5 * space.thickness;
  }
  for (int k = 0; k < 3; ++k) {
    if (!space.cell.repeats(k)) continue;
    const double centre = 0.5 * (low[k] + high[k]), half = 0.5 * space.cell.vectors()(k, k);
    low[k] = centre - half;
    high[k] = centre + half;
    if (std::abs(s.axis[k]) < 1) continue;  // else of a box along this direction
    bottom = s.axis[k] > 0 ? low[k] : -high[k];
    top = bottom + 2 * half;
  }
  s.extent = high - low;
  s.height = top - bottom;
  const Vec3 middle = 0.5 * (low + high);
  s.base = middle + (bottom - middle.dot(s.axis)) * s.axis;
  if (outline == SpecimenShape::Outline::cylinder) {
    double r = 0;
    for (std::size_t k = 0; k < radius.size(); ++k) {
      const Vec3 from_base = position[k] - s.base;
      r = std::max(r, (from_base - from_base.dot(s.axis) * s.axis).norm() + radius[k]);
    }
    if (link) r = link->largest_of(r);
    s.cross_section_area = std::numbers::pi * r * r;
  } else {
    // The axis is a coordinate direction for a box: the other two extents make its cross-section.
    s.cross_section_area = s.extent.prod() / s.extent.dot(s.axis.cwiseAbs());
  }
  s.volume = s.cross_section_area * s.height;
  if (outline == SpecimenShape::Outline::ellipsoid) {
    s.cross_section_area *= flat ? 1.0 : std::numbers::pi / 4;
    s.volume *= std::numbers::pi / (flat ? 4 : 6);
  } else if (outline == SpecimenShape::Outline::irregular && container_volume > 0) {
    s.volume = container_volume;
    s.cross_section_area = s.volume / s.height;
  }
  return s;
}

double solid_volume(Strided<const double> radius, const Space& space) {
  double sum = 0;
  for (const double r : radius) sum += space.dimension == 2 ? r * r * space.thickness : 4.0 / 3.0 * r * r * r;
  return std::numbers::pi * sum;
}

}  // namespace breccia
