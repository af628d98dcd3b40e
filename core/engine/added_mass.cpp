// SPDX-License-Identifier: BSD-3-Clause
#include "engine/added_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace breccia {

AddedMass add_mass(Strided<const double> mass, std::span<const double> steps, double share,
                   std::vector<double>& factors) {
  AddedMass added;
  factors.assign(mass.size(), 1);
  std::vector<std::size_t> order(mass.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return steps[a] < steps[b]; });
  const double total = std::accumulate(mass.begin(), mass.end(), 0.0), budget = share * total;
  // The first n of them reach the step T with sum((T^2/dt^2 - 1) m) more mass: which n spends the budget?
  double own = 0, needed = 0, square = 0;
  std::size_t n = 0;
  while (n < order.size() && std::isfinite(steps[order[n]]) && steps[order[n]] > 0) {
    const double m = mass[order[n]], dt = steps[order[n]];
    if (n > 0 && dt * dt * needed - own >= budget) break;  // to reach this one takes more than there is
    own += m;
    needed += m / (dt * dt);
    square = (budget + own) / needed;
    ++n;
  }
  if (n == 0 || !(budget > 0)) return added;
  added.step = std::sqrt(square);
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t a = order[k];
    factors[a] = std::max(1.0, square / (steps[a] * steps[a]));
    if (factors[a] > 1) ++added.particles;
    added.largest_factor = std::max(added.largest_factor, factors[a]);
    sum += (factors[a] - 1) * mass[a];
  }
  added.share = sum / total;
  return added;
}

}  // namespace breccia
