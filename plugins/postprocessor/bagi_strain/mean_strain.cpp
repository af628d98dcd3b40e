// SPDX-License-Identifier: BSD-3-Clause
#include "mean_strain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "breccia/error.hpp"

namespace breccia {
namespace {

double total_volume(const Triangulation& t, Strided<const Vec3> centre) {
  double volume = 0;
  for (std::size_t s = 0; s < t.simplices.size(); ++s) volume += simplex_volume(t, s, centre);
  return volume;
}

}  // namespace

MeanStrain::MeanStrain(int dimension, Strided<const Vec3> reference, Strided<const double> radius, double gap_limit,
                       std::span<const std::uint8_t> rigid)
    : triangulation_(triangulate(dimension, reference, radius)), reference_(reference.begin(), reference.end()) {
  const std::size_t count = reference.size();
  const double hull_volume = total_volume(triangulation_, reference);
  report_.flat = triangulation_.flat;
  report_.peeled = peel_hull(triangulation_, reference, radius, gap_limit);
  const double kept_volume = total_volume(triangulation_, reference);
  report_.peeled_volume_share = hull_volume > 0 ? 1 - kept_volume / hull_volume : 0;
  report_.gripped = std::erase_if(triangulation_.simplices, [&](const auto& s) {
    return !rigid.empty() &&
           std::all_of(s.begin(), s.begin() + triangulation_.corners(), [&](Index k) { return rigid[k]; });
  });
  report_.simplices = triangulation_.simplices.size();
  report_.volume = total_volume(triangulation_, reference);
  if (report_.simplices == 0)
    throw UserError(
        "bagi_strain: the particles of the packing are so far apart that no part of it counts as filled; "
        "raise hull_gap, or use a denser packing");

  weight_.assign(count, Vec3::Zero());
  std::vector<char> corner(count, 0);
  double largest = 0;
  for (std::size_t s = 0; s < triangulation_.simplices.size(); ++s) {
    const auto g = shape_gradients(triangulation_, s, reference_);
    for (int a = 0; a < triangulation_.corners(); ++a) {
      weight_[triangulation_.simplices[s][a]] += g[a];
      corner[triangulation_.simplices[s][a]] = 1;
      largest = std::max(largest, g[a].norm());
    }
  }
  // Inside, the faces around a centre close and their areas cancel: what is left is rounding.
  for (Vec3& w : weight_) {
    report_.boundary += w.norm() > 1e-9 * largest;
    w /= report_.volume;
  }

  std::vector<Index> corners;
  for (std::size_t p = 0; p < count; ++p)
    if (corner[p]) corners.push_back(Index(p));
  report_.hidden = count - corners.size();
  stand_in_.resize(count);
  for (std::size_t p = 0; p < count; ++p) {
    stand_in_[p] = Index(p);
    double nearest = std::numeric_limits<double>::infinity();
    if (!corner[p])
      for (const Index q : corners) {
        const double distance = (reference_[p] - reference_[q]).squaredNorm();
        if (distance < nearest) {
          nearest = distance;
          stand_in_[p] = q;
        }
      }
  }
}

Mat3 MeanStrain::gradient(Strided<const Vec3> position) const {
  BRECCIA_ASSERT(position.size() == reference_.size());
  Mat3 g = Mat3::Zero();
  for (std::size_t p = 0; p < position.size(); ++p) g += (position[p] - reference_[p]) * weight_[p].transpose();
  return g;
}

std::vector<Mat3> MeanStrain::local_gradients(Strided<const Vec3> position) const {
  BRECCIA_ASSERT(position.size() == reference_.size());
  const std::size_t count = position.size();
  std::vector<Mat3> sum(count, Mat3::Zero());
  std::vector<double> volume(count, 0);
  for (std::size_t s = 0; s < triangulation_.simplices.size(); ++s) {
    const auto& corner = triangulation_.simplices[s];
    const auto g = shape_gradients(triangulation_, s, reference_);
    Mat3 of_simplex = Mat3::Zero();
    for (int a = 0; a < triangulation_.corners(); ++a)
      of_simplex += (position[corner[a]] - reference_[corner[a]]) * g[a].transpose();
    const double v = simplex_volume(triangulation_, s, reference_);
    for (int a = 0; a < triangulation_.corners(); ++a) {
      sum[corner[a]] += of_simplex;
      volume[corner[a]] += v;
    }
  }
  std::vector<Mat3> local(count);
  for (std::size_t p = 0; p < count; ++p) local[p] = sum[stand_in_[p]] / volume[stand_in_[p]];
  return local;
}

}  // namespace breccia
