// SPDX-License-Identifier: BSD-3-Clause
#include "neighbours.hpp"

#include <algorithm>
#include <numeric>

#include "breccia/cell_grid.hpp"
#include "breccia/packing_tools/parallel.hpp"

namespace breccia::labra_onate {

bool NeighbourFinder::still_good(const Spheres& s, double reach) const {
  if (reach != reach_ || s.size() != then_.size()) return false;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double grown = std::max(0.0, s.r[i] - then_.r[i]), room = 0.5 * skin_ - (1 + reach) * grown;
    if (room < 0 || (s.x[i] - then_.x[i]).squaredNorm() > room * room) return false;
  }
  return true;
}

void NeighbourFinder::collect(const Spheres& s, double reach) {
  const std::size_t n = s.size();
  then_ = s;
  reach_ = reach;
  skin_ = 0.4 * std::accumulate(s.r.begin(), s.r.end(), 0.0) / double(n);
  const CellGrid grid(s.x, (1 + reach) * 2 * *std::max_element(s.r.begin(), s.r.end()) + skin_);
  std::vector<std::vector<Index>> near(n);
  for_all(n, threads_, [&](std::size_t i) {
    grid.for_each_near(s.x[i], [&](Index j) {
      const double limit = (1 + reach) * (s.r[i] + s.r[j]) + skin_;
      if (j != i && (s.x[i] - s.x[j]).squaredNorm() < limit * limit) near[i].push_back(j);
    });
    std::sort(near[i].begin(), near[i].end());
  });
  start_.assign(n + 1, 0);
  candidate_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    candidate_.insert(candidate_.end(), near[i].begin(), near[i].end());
    start_[i + 1] = candidate_.size();
  }
}

NeighbourSet NeighbourFinder::find(const Spheres& s, std::size_t pairs) {
  const double reach = pairs > 0 ? widest_gap : 0.0;
  if (!still_good(s, reach)) collect(s, reach);

  // (d/s)^2 orders like the relative gap and needs no root.
  const std::size_t n = s.size();
  std::vector<double> square(candidate_.size());
  for_all(n, threads_, [&](std::size_t i) {
    for (std::size_t e = start_[i]; e < start_[i + 1]; ++e) {
      const double sum = s.r[i] + s.r[candidate_[e]];
      square[e] = (s.x[i] - s.x[candidate_[e]]).squaredNorm() / (sum * sum);
    }
  });
  double limit = (1 + reach) * (1 + reach);
  if (pairs > 0) {
    std::vector<double> gaps;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t e = start_[i]; e < start_[i + 1]; ++e)
        if (candidate_[e] > i && square[e] < limit) gaps.push_back(square[e]);
    if (gaps.size() > pairs) {
      std::nth_element(gaps.begin(), gaps.begin() + std::ptrdiff_t(pairs - 1), gaps.end());
      limit = std::max(1.0, gaps[pairs - 1]);
    }
  }

  NeighbourSet set;
  set.tolerance = std::sqrt(limit) - 1;
  const double wall_reach = 1 + (pairs > 0 ? std::max(set.tolerance, wall_gap) : 0.0);
  set.start.assign(n + 1, 0);
  set.tangent.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t e = start_[i]; e < start_[i + 1]; ++e)
      if (square[e] <= limit) set.partner.push_back(candidate_[e]);
    set.start[i + 1] = set.partner.size();
    std::array<WallDistance, Container::max_walls> walls;
    const std::size_t count = box_.walls(s.x[i], walls);
    unsigned bits = 0;
    for (std::size_t w = 0; w < count; ++w)
      if (walls[w].distance <= wall_reach * s.r[i]) bits |= 1u << w;
    set.tangent[i] = std::uint8_t(bits);
  }
  return set;
}

}  // namespace breccia::labra_onate
