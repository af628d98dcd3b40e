// SPDX-License-Identifier: BSD-3-Clause
/// Points of a space that repeats itself, as a search for neighbours needs them: with their images around the cell.
#pragma once

#include <span>
#include <vector>

#include "breccia/cell_grid.hpp"
#include "breccia/space.hpp"

namespace breccia {

/// The points first, each moved into the cell, then those images of theirs that are within `reach` of it.
class Images {
 public:
  std::vector<Vec3> position;  // [m]
  std::vector<Index> of;       ///< the point that each is an image of

  Images(const Space& space, Strided<const Vec3> points, double reach)
      : position(points.begin(), points.end()), of(points.size()), cell_(space.cell) {
    for (Index k = 0; k < of.size(); ++k) of[k] = k;
    if (!cell_.repeats() || points.empty()) return;
    origin_ = points[0];  // any origin serves
    const Cell& cell = cell_;
    Vec3 margin = Vec3::Zero();
    int least[3] = {0, 0, 0}, most[3] = {0, 0, 0};
    for (int k = 0; k < 3; ++k)
      if (cell.repeats(k)) {
        margin[k] = reach / cell.width(k);
        most[k] = 1 + int(std::ceil(margin[k]));
        least[k] = -most[k];
      }
    for (std::size_t p = 0; p < points.size(); ++p) {
      position[p] = folded(points[p]);
      const Vec3 within = cell.inverse() * (position[p] - origin_);  // 0 to 1 along each vector
      for (int c = least[2]; c <= most[2]; ++c)
        for (int b = least[1]; b <= most[1]; ++b)
          for (int a = least[0]; a <= most[0]; ++a) {
            const Vec3 shift(a, b, c), at = within + shift;
            if ((a == 0 && b == 0 && c == 0) || (at.array() < -margin.array()).any() ||
                (at.array() > (Vec3::Ones() + margin).array()).any())
              continue;
            position.push_back(position[p] + cell.vectors() * shift);
            of.push_back(Index(p));
          }
    }
  }

  /// The image within the cell [m].
  Vec3 folded(const Vec3& x) const {
    if (!cell_.repeats()) return x;
    return x - cell_.vectors() * Vec3((cell_.inverse() * (x - origin_)).array().floor());
  }

 private:
  Cell cell_;
  Vec3 origin_ = Vec3::Zero();
};

/// Calls f(i, j) once for every two points i < j that are not farther apart than `cutoff` [m], and perhaps for some
/// that are; all partners of i before those of i + 1. Of a space that repeats itself the cutoff is below half its
/// width.
template <class F>
void for_each_pair_within(const Space& space, Strided<const Vec3> points, double cutoff, F&& f) {
  if (!space.cell.repeats()) return CellGrid(points, cutoff).for_each_pair(f);
  const Images all(space, points, cutoff);
  const CellGrid grid(all.position, cutoff);
  for (Index i = 0; i < points.size(); ++i)
    grid.for_each_near(all.position[i], [&](Index image) {
      // One image at the most is so near; the grid offers farther ones, too.
      const Index j = all.of[image];
      if (j > i && (all.position[image] - all.position[i]).squaredNorm() <= cutoff * cutoff) f(i, j);
    });
}

}  // namespace breccia
