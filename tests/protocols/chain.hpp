// SPDX-License-Identifier: BSD-3-Clause
/// Chains of particles, held and loaded as beams are by `end_load`.
#pragma once

#include <numbers>

#include "protocols/protocol_run.hpp"

namespace breccia::testing {

/// Along z, in a plane along y.
struct Chain {
  int dimension = 3;
  std::vector<double> radii;  // [m]
  double gap = 0;             ///< between surfaces [m]

  static Chain equal(int dimension, int bonds, double r, double gap = 0) {
    return {dimension, std::vector<double>(std::size_t(bonds + 1), r), gap};
  }
  PackedParticles packing() const {
    PackedParticles p;
    p.outline = SpecimenShape::Outline::box;
    p.axis = axis();
    double at = 0;
    for (std::size_t k = 0; k < radii.size(); ++k) {
      at += k == 0 ? radii[k] : radii[k - 1] + gap + radii[k];
      p.position.push_back(at * axis());
      p.radius.push_back(radii[k]);
    }
    return p;
  }
  double length() const {  ///< from the first centre to the last [m]
    double sum = gap * bonds() - radii.front() - radii.back();
    for (const double r : radii) sum += 2 * r;
    return sum;
  }
  int bonds() const { return int(radii.size()) - 1; }
  Vec3 axis() const { return dimension == 2 ? Vec3::UnitY() : Vec3::UnitZ(); }
  /// About which a force along x bends the chain, x cross axis turned the way the tip turns.
  Vec3 bending_axis() const { return axis().cross(Vec3::UnitX()); }
};

/// A round beam, or in a plane a rectangular one 1 m thick, of radius or half height r.
struct BeamSection {
  BeamSection(int dimension, double r)
      : area(dimension == 2 ? 2 * r : std::numbers::pi * r * r),
        bending(dimension == 2 ? 2.0 / 3.0 * r * r * r : 0.25 * std::numbers::pi * std::pow(r, 4)),
        torsion(dimension == 2 ? 0 : 2 * bending),
        coefficient(dimension == 2 ? 5.0 / 6.0 : 0.9) {}
  double area, bending, torsion;  // [m2], [m4], [m4]
  double coefficient;             ///< of shear, as `beam_bond` takes it
};

inline Json as_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Held at the root, loaded at the tip, at rest.
inline Json cantilever(const Vec3& force, const Vec3& moment, const Json& changes = Json::object()) {
  Json c = {{"supports", {{{"at", "lower"}, {"holds", {"all"}}}}},
            {"loads", {{{"at", "upper"}, {"force", as_json(force)}, {"moment", as_json(moment)}, {"share", "equal"}}}},
            {"rest", 3e-7}};
  for (const auto& [key, value] : changes.items()) c[key] = value;
  return c;
}

inline Vec3 vector_result(const ProtocolRun& run, const std::string& name, const std::string& unit) {
  Vec3 v = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (const auto found = run.summary.find(ResultName(name + "_" + "xyz"[k], unit).key()); found != run.summary.end())
      v[k] = found->second.get<double>();
  return v;
}

}  // namespace breccia::testing
