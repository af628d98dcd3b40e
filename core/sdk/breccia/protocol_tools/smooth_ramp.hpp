// SPDX-License-Identifier: BSD-3-Clause
/// A quantity that goes from value to value along a cosine, without a jump of its rate.
#pragma once

#include <cmath>
#include <numbers>

namespace breccia {

/// Trivially copyable: part of a protocol's running state. A ramp to where it already leads is not begun again, so that
/// a test may be cut into stages without a trace.
class SmoothRamp {
 public:
  double at(double time) const {
    const double x = duration_ > 0 ? (time - start_) / duration_ : 1.0;
    return x >= 1 ? to_ : x <= 0 ? from_ : from_ + 0.5 * (to_ - from_) * (1 - std::cos(std::numbers::pi * x));
  }
  void lead_to(double value, double time, double duration) {
    if (value == to_) return;
    from_ = at(time);
    to_ = value;
    start_ = time;
    duration_ = duration;
  }
  /// At once.
  void set(double value) {
    from_ = to_ = value;
    duration_ = 0;
  }
  double target() const { return to_; }
  bool done(double time) const { return time >= start_ + duration_; }

 private:
  double from_ = 0, to_ = 0, start_ = 0, duration_ = 0;
};

}  // namespace breccia
