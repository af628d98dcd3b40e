// SPDX-License-Identifier: BSD-3-Clause
/// Other work on the cores of a run.
#pragma once

#include <chrono>

namespace breccia {

/// Threads that meet at barriers wait while the core of one of them does something else: a run of two threads on two
/// cores that others use too can take ten times as long as with one. The system counts how often it takes a core away.
class Contention {
 public:
  explicit Contention(int threads);
  /// True once, after two seconds or more in which cores were taken away all the time.
  bool noticed();

 private:
  std::chrono::steady_clock::time_point since_;
  long taken_;
  bool watching_;
};

}  // namespace breccia
