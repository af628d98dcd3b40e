// SPDX-License-Identifier: BSD-3-Clause
/// The particles of a support or a load: which they are, and how they move as a whole.
#pragma once

#include "config.hpp"

namespace breccia::end_load {

/// Of a group: what of the forces on it is taken up by the hands that hold it.
struct Reaction {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // [N], about the middle of the group [N m]
};

/// Of all its particles, weighted as the load is shared.
struct Motion {
  Vec3 displacement, spin, middle;  // [m], [rad/s], [m]
};

class Group {
 public:
  /// `path`: where the workflow speaks of it. UserError when no particle lies there.
  Group(const Place& place, std::string name, const std::string& path, const SpecimenShape& shape,
        const SimulationView& view, Share share = Share::equal)
      : name_(std::move(name)) {
    const ParticlesView& p = view.particles;
    const Layer layer(place, shape, view);
    double nearest = 1e300;
    ExactSumOf<double> sum;
    for (const std::size_t k : view.own_particles()) {
      const double off = layer.off(p.position[k]);
      nearest = std::min(nearest, off);
      if (off > layer.tolerance || !in_ranges(place, p.position[k], layer.tolerance)) continue;
      rows_.push_back(view.row_in_whole(k));
      weight_.push_back(share == Share::mass ? p.mass[k] : 1.0);
      radius_.push_back(p.radius[k]);
      sum.add(weight_.back());
    }
    rows_ = view.all(rows_);
    weight_ = view.all(weight_);
    radius_ = view.all(radius_);
    nearest = -view.max(-nearest);
    if (rows_.empty()) throw UserError(nothing(path, layer, nearest));
    const double all = view.sum(sum);
    for (double& w : weight_) w /= all;
  }

  const std::string& name() const { return name_; }
  const std::vector<Index>& rows() const { return rows_; }  ///< of its particles in the whole, ascending
  double weight(std::size_t k) const { return weight_[k]; }
  double radius(std::size_t k) const { return radius_[k]; }  // [m]

  /// Nine numbers, of which the sums over all parts make a `Motion`.
  void add_motion(const SimulationView& view, std::span<ExactSum> to) const {
    const ParticlesView& p = view.particles;
    view.for_each_own(rows_, [&](std::size_t n, std::size_t k) {
      add(weight_[n] * (p.position[k] - p.initial_position[k]), to.subspan(0, 3));
      add(weight_[n] * p.angular_velocity[k], to.subspan(3, 3));
      add(weight_[n] * p.position[k], to.subspan(6, 3));
    });
  }
  /// Six numbers, likewise, of a `Reaction` on the specimen, by what holds the components `mask`.
  void add_reaction(const SimulationView& view, std::uint8_t mask, const Vec3& middle, std::span<ExactSum> to) const {
    const ParticlesView& p = view.particles;
    view.for_each_own(rows_, [&](std::size_t, std::size_t k) {
      Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
      for (int c = 0; c < 3; ++c) {
        if (mask >> c & 1) force[c] = -p.force[k][c];
        if (mask >> (c + 3) & 1) torque[c] = -p.torque[k][c];
      }
      add(force, to.subspan(0, 3));
      add(torque + Vec3(p.position[k] - middle).cross(force), to.subspan(3, 3));
    });
  }

 private:
  static void add(const Vec3& v, std::span<ExactSum> to) {
    for (std::size_t c = 0; c < 3; ++c) to[c].add(v[Eigen::Index(c)]);
  }

  /// A layer across the axis; without a height all of the specimen.
  struct Layer {
    Layer(const Place& place, const SpecimenShape& s, const SimulationView& view)
        : shape(s), tolerance(1e-9 * s.height) {
      double largest = 0;
      for (const std::size_t k : view.own_particles()) largest = std::max(largest, view.particles.radius[k]);
      largest = view.max(largest);
      const bool end = place.at && *place.at != At::middle;
      any = !place.at && !place.height;
      if (place.height) middle = *place.height;
      else if (place.at)
        middle = *place.at == At::lower ? 0 : *place.at == At::upper ? shape.height : 0.5 * shape.height;
      half = end ? place.depth.value_or(largest) : 0.5 * place.depth.value_or(2 * largest);
    }
    /// How far a centre lies outside of it, along the axis; 0 within [m].
    double off(const Vec3& x) const {
      return any ? 0 : std::max(0.0, std::abs((x - shape.base).dot(shape.axis) - middle) - half);
    }
    const SpecimenShape& shape;
    double middle = 0, half = 0, tolerance;  // [m]
    bool any = false;
  };

  static bool in_ranges(const Place& place, const Vec3& x, double tolerance) {
    int k = 0;
    for (const auto* range : {&place.x, &place.y, &place.z}) {
      if (*range && (x[k] < (**range)[0] - tolerance || x[k] > (**range)[1] + tolerance)) return false;
      ++k;
    }
    return true;
  }
  static std::string nothing(const std::string& path, const Layer& layer, double nearest) {
    char text[240];
    if (nearest > layer.tolerance)
      std::snprintf(text, sizeof text,
                    ": no centre of a particle lies there; the nearest is %.4g m outside of the layer: make `depth` "
                    "larger, or choose another place between 0 and %.4g m",
                    nearest, layer.shape.height);
    else
      std::snprintf(
          text, sizeof text,
          ": no centre of a particle lies there: make the ranges of `x`, `y` and `z` wider, or `depth` larger");
    return "protocol end_load: " + path + text;
  }

  std::string name_;
  std::vector<Index> rows_;
  std::vector<double> weight_;  ///< their sum is 1
  std::vector<double> radius_;
};

}  // namespace breccia::end_load
