// SPDX-License-Identifier: BSD-3-Clause
/// The particles of a support or a load: which they are, and how they move as a whole.
#pragma once

#include "config.hpp"

namespace breccia::end_load {

/// Of a group: what of the forces on it is taken up by the hands that hold it.
struct Reaction {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // [N], about the middle of the group [N m]
};

class Group {
 public:
  /// `path`: where the workflow speaks of it. UserError when no particle lies there.
  Group(const Place& place, std::string name, const std::string& path, const SpecimenShape& shape,
        const ParticlesView& p, Share share = Share::equal)
      : name_(std::move(name)) {
    const Layer layer(place, shape, p);
    double nearest = 1e300, sum = 0;
    for (Index k = 0; k < p.size(); ++k) {
      const double off = layer.off(p.position[k]);
      nearest = std::min(nearest, off);
      if (off > layer.tolerance || !in_ranges(place, p.position[k], layer.tolerance)) continue;
      particles_.push_back(k);
      weight_.push_back(share == Share::mass ? p.mass[k] : 1.0);
      sum += weight_.back();
    }
    if (particles_.empty()) throw UserError(nothing(path, layer, nearest));
    for (double& w : weight_) w /= sum;
  }

  const std::string& name() const { return name_; }
  const std::vector<Index>& particles() const { return particles_; }
  double weight(std::size_t k) const { return weight_[k]; }

  Vec3 displacement(const ParticlesView& p) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < particles_.size(); ++k)
      sum += weight_[k] * (p.position[particles_[k]] - p.initial_position[particles_[k]]);
    return sum;
  }
  Vec3 spin(const ParticlesView& p) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < particles_.size(); ++k) sum += weight_[k] * p.angular_velocity[particles_[k]];
    return sum;
  }
  /// On the specimen, by what holds the components `mask`.
  Reaction reaction(const ParticlesView& p, std::uint8_t mask) const {
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = 0; k < particles_.size(); ++k) middle += weight_[k] * p.position[particles_[k]];
    Reaction r;
    for (const Index k : particles_) {
      Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
      for (int c = 0; c < 3; ++c) {
        if (mask >> c & 1) force[c] = -p.force[k][c];
        if (mask >> (c + 3) & 1) torque[c] = -p.torque[k][c];
      }
      r.force += force;
      r.moment += torque + Vec3(p.position[k] - middle).cross(force);
    }
    return r;
  }

 private:
  /// A layer across the axis; without a height all of the specimen.
  struct Layer {
    Layer(const Place& place, const SpecimenShape& s, const ParticlesView& p) : shape(s), tolerance(1e-9 * s.height) {
      double largest = 0;
      for (const double r : p.radius) largest = std::max(largest, r);
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
  std::vector<Index> particles_;
  std::vector<double> weight_;  ///< their sum is 1
};

}  // namespace breccia::end_load
