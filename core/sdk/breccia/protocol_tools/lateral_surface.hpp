// SPDX-License-Identifier: BSD-3-Clause
/// The lateral surface of a specimen: which particles form it, and how much of it each of them stands for.
#pragma once

#include <numbers>

#include "breccia/protocol.hpp"
#include "breccia/protocol_tools/voronoi.hpp"

namespace breccia {

/// A particle's share of the surface. A particle on the edge of a box has one on each face.
struct SurfaceCell {
  Index particle;
  Vec3 inward = Vec3::Zero();  ///< unit normal
  double area =
      0;  ///< its Voronoi cell on the unrolled surface, weighted by the radii [m2]; see Cheung and O'Sullivan (2008)
  double disc = 0;  ///< pi r^2, in two dimensions 2 r times the thickness [m2]; see Oñate et al. (2015), 10.1.1
};

/// Faces of the specimen along its axis: the mantle of a cylinder, the four sides of a box, the two of a rectangle.
class LateralSurface {
 public:
  LateralSurface(const SpecimenShape& shape, const ParticlesView& particles, int dimension, double thickness)
      : dimension_(dimension), thickness_(thickness), axis_(shape.axis), base_(shape.base) {
    int least = 0;
    axis_.cwiseAbs().minCoeff(&least);
    const Vec3 e1 = dimension == 2 ? Vec3(-axis_.y(), axis_.x(), 0) : axis_.cross(Vec3::Unit(least)).normalized(),
               e2 = axis_.cross(e1);
    const bool round = dimension == 3 && shape.outline != SpecimenShape::Outline::box;
    if (round) {
      faces_.push_back({e1, e2, true, 0, std::sqrt(shape.cross_section_area / std::numbers::pi)});
    } else {
      const auto extent = [&](const Vec3& e) { return shape.extent.dot(e.cwiseAbs()); };
      for (const Vec3& out : {e1, Vec3(-e1), e2, Vec3(-e2)}) {
        if (dimension == 2 && out.z() != 0) continue;
        const Vec3 along = axis_.cross(out);
        faces_.push_back({out, along, false, dimension == 2 ? thickness : extent(along), 0.5 * extent(out)});
      }
    }
    for (const double r : particles.radius) pitch_ += 0.25 * r / double(particles.size());
  }

  /// The particles that are seen from outside, over at least half of their cross-section, and their cells, at the
  /// present positions between two heights above the specimen's base [m]. What has sunk behind others is no longer of
  /// the surface.
  void measure(const ParticlesView& p, double low, double high) {
    cells_.clear();
    area_ = 0;
    for (const Face& f : faces_) {
      const std::vector<Index> particles = seen(f, p, low, high);
      std::vector<Place> places;
      std::vector<double> radii;
      double radius = 0;
      for (const Index k : particles) {
        places.push_back(place(f, p.position[k]));
        radii.push_back(p.radius[k]);
        radius += (places.back().out + p.radius[k]) / double(particles.size());
      }
      const double width = f.round ? 2 * std::numbers::pi * radius : f.width;
      std::vector<SurfacePoint> points;
      for (const Place& at : places)
        points.emplace_back(f.round ? at.across * radius : std::clamp(at.across + 0.5 * width, 0.0, width),
                            at.along - low);
      const std::vector<double> areas = voronoi_areas(points, width, high - low, f.round, radii);
      for (std::size_t n = 0; n < places.size(); ++n) {
        const Index k = particles[n];
        const double r = p.radius[k],
                     bulge = f.round ? (places[n].out + r) / radius : 1.0;  // the mantle as wide as it is here
        cells_.push_back(
            {k, -places[n].outward, areas[n] * bulge, dimension_ == 2 ? 2 * r * thickness_ : std::numbers::pi * r * r});
        area_ += cells_.back().area;
      }
    }
  }

  const std::vector<SurfaceCell>& cells() const { return cells_; }
  double area() const { return area_; }  ///< of the surface as last measured [m2]
  void archive(Archive& archive) {
    archive.records("cells", cells_, std::pair("particle", &SurfaceCell::particle),
                    std::pair("inward", &SurfaceCell::inward), std::pair("area", &SurfaceCell::area),
                    std::pair("disc", &SurfaceCell::disc));
    archive("area", area_);
  }
  double disc_area() const {  ///< sum of the particles' cross-sections [m2]
    double sum = 0;
    for (const SurfaceCell& c : cells_) sum += c.disc;
    return sum;
  }

 private:
  struct Face {
    Vec3 e1, e2;  ///< round: any two across the axis; flat: outward, and along the face
    bool round;
    double width, out;  ///< of a flat face; of the surface from the axis, at the start [m]
  };
  struct Place {
    double across, along, out;  ///< angle or way along the face, height above the base, distance from the axis
    Vec3 outward;
  };

  Place place(const Face& f, const Vec3& x) const {
    const Vec3 from = x - base_;
    const double a = from.dot(f.e1), b = from.dot(f.e2), along = from.dot(axis_);
    if (!f.round) return {dimension_ == 2 ? 0.0 : b, along, a, f.e1};
    const double off = std::hypot(a, b);
    return {std::atan2(b, a), along, off, off > 0 ? Vec3((a * f.e1 + b * f.e2) / off) : f.e1};
  }

  /// A map of the surface, as an observer outside sees it: in each spot the particle that stands out farthest.
  std::vector<Index> seen(const Face& f, const ParticlesView& p, double low, double high) const {
    const double pitch = pitch_, width = f.round ? 2 * std::numbers::pi * f.out : f.width;
    const long across = dimension_ == 2 ? 1 : std::max(8L, std::lround(width / pitch)),
               up = std::max(1L, std::lround((high - low) / pitch));
    struct Spot {
      double out = -1e300;
      Index particle = 0;
    };
    std::vector<Spot> map(std::size_t(across * up));
    const auto paint = [&](Index k, auto&& spot) {
      const Place at = place(f, p.position[k]);
      const double r = p.radius[k],
                   x = dimension_ == 2 ? 0.5 : (f.round ? at.across * f.out : at.across + 0.5 * width) / pitch,
                   y = (at.along - low) / pitch, reach = r / pitch;
      for (long j = long(std::floor(y - reach)); j <= long(y + reach); ++j) {
        if (j < 0 || j >= up) continue;
        for (long i = dimension_ == 2 ? 0 : long(std::floor(x - reach)); i <= (dimension_ == 2 ? 0 : long(x + reach));
             ++i) {
          if (!f.round && (i < 0 || i >= across)) continue;
          const double dx = dimension_ == 2 ? 0.0 : (double(i) + 0.5 - x) * pitch, dy = (double(j) + 0.5 - y) * pitch,
                       left = r * r - dx * dx - dy * dy;
          if (left <= 0) continue;
          spot(map[std::size_t(j * across + ((i % across) + across) % across)], at.out + std::sqrt(left));
        }
      }
    };
    for (Index k = 0; k < p.size(); ++k)
      paint(k, [&](Spot& s, double out) {
        if (out > s.out) s = {out, k};
      });
    std::vector<Index> found;
    for (Index k = 0; k < p.size(); ++k) {
      long all = 0, mine = 0;
      paint(k, [&](const Spot& s, double) {
        ++all;
        mine += s.particle == k;
      });
      if (2 * mine >= all && mine > 0) found.push_back(k);
    }
    return found;
  }

  int dimension_;
  double thickness_;
  Vec3 axis_, base_;
  double pitch_ = 0;  ///< of the map of the surface [m]
  std::vector<Face> faces_;
  std::vector<SurfaceCell> cells_;
  double area_ = 0;
};

}  // namespace breccia
