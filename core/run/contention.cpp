// SPDX-License-Identifier: BSD-3-Clause
#include "run/contention.hpp"

#include <sys/resource.h>

namespace breccia {
namespace {

/// Times that a core was taken from a thread of this process that could have gone on.
long times_taken() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? usage.ru_nivcsw : 0;
}

}  // namespace

Contention::Contention(int threads)
    : since_(std::chrono::steady_clock::now()), taken_(times_taken()), watching_(threads > 1) {}

bool Contention::noticed() {
  constexpr double window = 2, most = 100;  // [s], [1/s]: by themselves threads lose their cores a few times a second
  if (!watching_) return false;
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - since_).count();
  if (seconds < window) return false;
  const long taken = times_taken();
  const bool crowded = double(taken - taken_) > most * seconds;
  since_ = now;
  taken_ = taken;
  watching_ = !crowded;
  return crowded;
}

}  // namespace breccia
