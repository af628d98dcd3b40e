// SPDX-License-Identifier: BSD-3-Clause
#include "rose.hpp"

#include <algorithm>
#include <cmath>

#include "breccia/error.hpp"

namespace breccia {

Rose::Rose(std::size_t sectors, double largest_tilt) : largest_tilt_(largest_tilt), counts_(sectors, 0) {
  BRECCIA_ASSERT(sectors > 0 && sectors % 2 == 0);
}

void Rose::add(double u, double v, double w) {
  const double in_plane = std::hypot(u, v), out_of_plane = std::abs(w);
  if (in_plane <= 1e-9 * out_of_plane || std::atan2(out_of_plane, in_plane) > largest_tilt_) return;
  // Only the half turn from 0 on is looked up, so that both senses of a line give the same pair of sectors.
  if (v < 0 || (v == 0 && u < 0)) {
    u = -u;
    v = -v;
  }
  const std::size_t half = counts_.size() / 2;
  const auto sector = std::min(half - 1, std::size_t(std::atan2(v, u) / M_PI * double(half)));  // atan2 may round to pi
  ++counts_[sector];
  ++counts_[sector + half];
  ++lines_;
}

void Rose::meet(const SeenInPart& parts) {
  std::vector<ExactSum> sums(counts_.size() + 1);
  for (std::size_t k = 0; k < counts_.size(); ++k) sums[k].add(double(counts_[k]));
  sums.back().add(double(lines_));
  const std::vector<double> all = parts.sums(sums);
  for (std::size_t k = 0; k < counts_.size(); ++k) counts_[k] = std::size_t(all[k]);
  lines_ = std::size_t(all.back());
}

double Rose::angle(std::size_t k) const { return 2 * M_PI * (double(k) / double(counts_.size())); }

}  // namespace breccia
