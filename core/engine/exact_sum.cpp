// SPDX-License-Identifier: BSD-3-Clause
#include "engine/exact_sum.hpp"

#include "engine/rank_link.hpp"

namespace breccia {

std::vector<double> totals(std::span<ExactSum> sums, RankLink* link) {
  if (link && !sums.empty()) {
    for (ExactSum& s : sums) s.carry();
    link->add({reinterpret_cast<std::int64_t*>(sums.data()), sums.size() * ExactSum::words});
  }
  std::vector<double> values;
  for (const ExactSum& s : sums) values.push_back(s.value());
  return values;
}

}  // namespace breccia
