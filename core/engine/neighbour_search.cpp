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

}  // namespace

NeighbourSearch::NeighbourSearch(const Space& space, const Particles& p, double skin)
    : space_(space),
      p_(p),
      skin_(skin),
      reach_(2 * *std::max_element(p.radius().begin(), p.radius().end()) + skin),
      images_(space, p.position(), reach_),
      grid_(images_.position, reach_) {
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
  grid_.for_each_run_near(at, [&](std::size_t begin, std::size_t end) {
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
