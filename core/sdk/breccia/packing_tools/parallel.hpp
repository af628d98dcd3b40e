// SPDX-License-Identifier: BSD-3-Clause
/// Sums and loops whose result does not depend on the number of threads. Needs OpenMP in the plugin that includes it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace breccia {

/// f(k) for k = 0..n-1, each writing only what is its own.
template <class F>
void for_all(std::size_t n, int threads, F&& f) {
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t k = 0; k < n; ++k) f(k);
}

/// Sum of f(k): chunks of fixed length are summed apart, then in order.
template <class F>
double ordered_sum(std::size_t n, int threads, F&& f) {
  constexpr std::size_t chunk = 256;
  const std::size_t chunks = (n + chunk - 1) / chunk;
  std::vector<double> part(chunks);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t c = 0; c < chunks; ++c) {
    double sum = 0;
    for (std::size_t k = c * chunk; k < std::min(n, (c + 1) * chunk); ++k) sum += f(k);
    part[c] = sum;
  }
  double total = 0;
  for (const double p : part) total += p;
  return total;
}

}  // namespace breccia
