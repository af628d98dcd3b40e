// SPDX-License-Identifier: BSD-3-Clause
#include "engine/neighbour_search.hpp"

#include <algorithm>

#include "breccia/contact_law.hpp"
#include "engine/cell_motion.hpp"

namespace breccia {
namespace {

constexpr std::size_t block = 128;

/// d^2 less the reach squared, for n candidates; a hair below what is exact, so that rounding loses none.
BRECCIA_VECTOR_CLONES void excess(const double* x, const double* y, const double* z, const double* r, std::size_t n,
                                  const Vec3& at, double reach, double* out) {
  const double ax = at.x(), ay = at.y(), az = at.z();
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) {
    const double dx = x[k] - ax, dy = y[k] - ay, dz = z[k] - az, near = reach + r[k];
    out[k] = dx * dx + dy * dy + dz * dz - near * near * (1 + 1e-12);
  }
}

struct Box {
  Vec3 low, high;
};

/// Where nearly all are, with as much again on either side. One particle that flies off would make the cells of a grid
/// over all so wide that the rest stands in one of them, and the search takes the square of their number.
Box box_of_most(std::span<const Vec3> points) {
  constexpr std::size_t of = 64;  // the share of either end that may be strays
  Box box;
  std::vector<double> x(points.size());
  for (int k = 0; k < 3; ++k) {
    for (std::size_t p = 0; p < points.size(); ++p) x[p] = points[p][k];
    const auto at = [&](std::size_t rank) {
      std::nth_element(x.begin(), x.begin() + std::ptrdiff_t(rank), x.end());
      return x[rank];
    };
    const double low = at(x.size() / of), high = at(x.size() - 1 - x.size() / of);
    box.low[k] = low - (high - low);
    box.high[k] = high + (high - low);
  }
  return box;
}

}  // namespace

std::vector<Vec3> NeighbourSearch::drawn_in(std::span<const Vec3> points, double reach) {
  if (points.size() < 64) return {};
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  if (((high - low) / reach + Vec3::Ones()).prod() <= 64.0 + 4.0 * double(points.size())) return {};
  const Box box = box_of_most(points);
  const Vec3 margin = Vec3::Constant(reach);  // of a flat one, too
  std::vector<Vec3> drawn(points.begin(), points.end());
  for (Vec3& p : drawn) p = p.cwiseMax(box.low - margin).cwiseMin(box.high + margin);
  return drawn;
}

NeighbourSearch::NeighbourSearch(const Space& space, const Particles& p, double skin)
    : space_(space),
      p_(p),
      skin_(skin),
      reach_(2 * *std::max_element(p.radius().begin(), p.radius().end()) + skin),
      images_(space, p.position(), reach_),
      drawn_in_(drawn_in(images_.position, reach_)),
      grid_(drawn_in_.empty() ? images_.position : drawn_in_, reach_) {
  refuse_narrow_cell(space, reach_);
  const auto members = grid_.members();
  for (auto* v : {&x_, &y_, &z_, &r_}) v->resize(members.size());
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Vec3& at = images_.position[members[m]];
    x_[m] = at.x();
    y_[m] = at.y();
    z_[m] = at.z();
    r_[m] = p.radius()[images_.of[members[m]]];
  }
}

void NeighbourSearch::append_partners(Index i, std::vector<Index>& out) const {
  double over[block];
  const Vec3& at = images_.position[i];
  const double reach = p_.radius()[i] + skin_;
  grid_.for_each_run_near(drawn_in_.empty() ? at : drawn_in_[i], [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; m += block) {
      const std::size_t n = std::min(block, end - m);
      excess(&x_[m], &y_[m], &z_[m], &r_[m], n, at, reach, over);
      for (std::size_t k = 0; k < n; ++k) {
        if (over[k] >= 0) continue;
        const Index j = images_.of[grid_.members()[m + k]];
        if (j > i && space_.branch(p_.position()[i], p_.position()[j]).norm() < p_.radius()[i] + p_.radius()[j] + skin_)
          out.push_back(j);
      }
    }
  });
}

}  // namespace breccia
