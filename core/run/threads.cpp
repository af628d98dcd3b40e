// SPDX-License-Identifier: BSD-3-Clause
#include "run/threads.hpp"

#include <fmt/format.h>

#include <latch>
#include <thread>
#include <vector>

#include "breccia/error.hpp"

namespace breccia {

void refuse_without_threads(int threads) {
  std::latch all(threads);           // none ends before all are there
  std::vector<std::jthread> others;  // joined before what they wait at is gone
  others.reserve(std::size_t(threads));
  try {
    while (int(others.size()) + 1 < threads) others.emplace_back([&] { all.arrive_and_wait(); });
  } catch (const std::exception&) {
    const int got = int(others.size());
    all.count_down(threads - got);
    throw UserError(fmt::format(
        "the system gives only {} of {} threads, or has no memory for more (ulimit -u, -v, -d): use --threads {}",
        got + 1, threads, got + 1));
  }
  all.count_down();
}

}  // namespace breccia
