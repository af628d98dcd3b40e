// SPDX-License-Identifier: BSD-3-Clause
/// Equivalent-continuum strain of Bagi (1996): the displacement of the sphere centres, linear in each simplex of their
/// triangulation, averaged over its volume.
#pragma once

#include <span>
#include <vector>

#include "triangulation.hpp"

namespace breccia {

class MeanStrain {
 public:
  struct Report {
    std::size_t simplices = 0;       ///< averaged over
    std::size_t flat = 0;            ///< left out: no volume
    std::size_t gripped = 0;         ///< left out: all corners are held and move as one
    std::size_t peeled = 0;          ///< left out: they bridged gaps of the outline
    double peeled_volume_share = 0;  ///< of the convex hull
    std::size_t hidden = 0;          ///< particles that are corner of no simplex
    std::size_t boundary = 0;        ///< particles that carry weight in the average
    double volume = 0;               ///< [m3]; area in two dimensions [m2]
  };

  MeanStrain() = default;
  /// `gap_limit` [m]: see peel_hull. UserError when no simplex is left.
  MeanStrain(int dimension, Strided<const Vec3> reference, Strided<const double> radius, double gap_limit,
             std::span<const std::uint8_t> rigid = {});

  /// Mean displacement gradient, du_a/dx_b, when the centres have moved from the reference to `position`.
  Mat3 gradient(Strided<const Vec3> position) const;
  /// The same for each particle: average over the simplices at its centre. Hidden particles take over the value of the
  /// nearest that is not.
  std::vector<Mat3> local_gradients(Strided<const Vec3> position) const;

  const Report& report() const { return report_; }
  Strided<const Vec3> reference() const { return reference_; }
  /// Of each particle: the mean gradient is the sum of displacement (x) weight [1/m].
  Strided<const Vec3> weights() const { return weight_; }

 private:
  Triangulation triangulation_;
  std::vector<Vec3> reference_, weight_;
  std::vector<Index> stand_in_;  ///< per particle: whose local strain it shows, itself unless hidden
  Report report_;
};

}  // namespace breccia
