// SPDX-License-Identifier: BSD-3-Clause
/// The contacts' normal stresses by direction, at each stress level that is reached for the first time.
#pragma once

#include <optional>
#include <vector>

#include "breccia/archive.hpp"
#include "breccia/views.hpp"

namespace breccia {

/// Contacts whose normals make angles of one interval with the plane across the axis.
struct DirectionBin {
  std::size_t contacts = 0, compressed = 0, tensile = 0, yielded = 0;
  double compression = 0, tension = 0, yield = 0;  ///< sums of magnitudes of the normal stress [Pa]
  DirectionBin& operator+=(const DirectionBin& o);
};

struct Snapshot {
  double axial_stress = 0;         ///< of the specimen, compression positive [Pa]
  double time = 0;                 ///< [s]
  std::vector<DirectionBin> bins;  ///< equal intervals from 0 (across the axis) to pi/2 (along it)
  void archive(Archive& archive) {
    archive("axial_stress", axial_stress);
    archive("time", time);
    archive("bins", bins);
  }
};

/// Mean stress of the specimen along its axis, compression positive [Pa]: sum over pairs, walls and applied forces.
double axial_stress(const SimulationView& view);

/// Intact bonds, and pairs that exert a force. A compressive stress of `limit` or more counts as yielded.
std::vector<DirectionBin> by_direction(const SimulationView& view, std::size_t bins, double area_factor,
                                       std::optional<double> limit);

/// Snapshots of the first way up, a constant factor of stress apart, and one of the highest stress: whatever the peak
/// turns out to be, one of each share of it is there.
class FirstLoading {
 public:
  static constexpr double step = 1.02;
  /// Shares of the peak below `lowest_share` are not asked for.
  FirstLoading(std::size_t bins, double lowest_share) : bins_(bins), lowest_share_(lowest_share) {}

  void sample(const SimulationView& view, double area_factor, std::optional<double> limit);
  const Snapshot* peak() const { return highest_ ? &*highest_ : nullptr; }
  /// The one nearest to this share of the highest stress; null when nothing was compressed.
  const Snapshot* at(double share) const;
  void archive(Archive& archive) {
    archive("levels", levels_);
    archive("highest", highest_);
  }

 private:
  std::size_t bins_;
  double lowest_share_;
  std::vector<Snapshot> levels_;  // rising
  std::optional<Snapshot> highest_;
};

}  // namespace breccia
