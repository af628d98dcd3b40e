// SPDX-License-Identifier: BSD-3-Clause
/// What the trials of a plugin found, whatever its kind.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "breccia/services.hpp"

namespace breccia {

struct CheckFinding {
  enum class Outcome { holds, fails, not_checked };
  std::string check;  ///< "energy against work, shear"
  Outcome outcome = Outcome::holds;
  std::string measured;  ///< what was found, in a few words; why it could not be tried
  std::string mend;      ///< what to look at when it does not hold
};
using CheckFindings = std::vector<CheckFinding>;

/// Checks that are made in several cases (shapes, dimensions): each gives one finding, that of its worst case.
/// Cancelled when the user wants them to end.
class Trials {
 public:
  explicit Trials(const Host& user) : user_(user) {}
  /// `badness`: of those that hold the text of the worst is told. Every text may be built for each call: few are.
  void see(std::string_view check, const std::string& where, bool holds, const std::string& measured,
           std::string_view mend, double badness = 0);
  /// Told once for all the cases that it concerns.
  void skip(std::string_view check, const std::string& where, const std::string& why);
  bool any() const { return !seen_.empty(); }  ///< something was tried
  CheckFindings findings() const;

 private:
  struct Seen {
    std::string check, mend, worst, worst_at, failed, failed_at;
    double badness = 0;
    std::size_t cases = 0, failures = 0;
  };
  struct Skipped {
    std::string check, why;
    std::vector<std::string> where;
  };
  const Host& user_;
  std::vector<Seen> seen_;
  std::vector<Skipped> skipped_;
};

/// Bit by bit; what is no number is as good as any other.
inline bool same_value(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

}  // namespace breccia
