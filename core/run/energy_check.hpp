// SPDX-License-Identifier: BSD-3-Clause
/// Energy that does not close is never silent.
#pragma once

#include <string>

#include "breccia/archive.hpp"
#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia {

struct EnergyLimits {
  double warn = 0.01, end = 0.10;  ///< shares of the work
  double floor = 0;                ///< energies below count as this much while the test is under way [J]
};

/// Holds the ledger's error against the largest of boundary work, stored and initial energy so far.
class EnergyCheck {
 public:
  EnergyCheck() = default;
  EnergyCheck(const EnergyLimits& limits, std::string law) : limits_(limits), law_(std::move(law)) {}

  /// While the test goes on: warns once; UserError above the limit.
  void sample(const EnergyLedger& energy, std::uint64_t step, Host& host);
  /// At the end the test is known whole: small ones are held to the same share, whatever the floor.
  void finish(const EnergyLedger& energy, std::uint64_t step, Host& host);

  void archive(Archive& archive) {
    archive("limits", limits_);
    archive("law", law_);
    archive("largest", largest_);
    archive("warned", warned_);
  }

  double share(double error, double floor) const;  ///< of the largest energy so far; 0 when there was none
  void see(const EnergyLedger& energy);
  std::string text(double share, const std::string& when) const;

 private:
  EnergyLimits limits_;
  std::string law_;
  double largest_ = 0;  // [J]
  bool warned_ = false;
};

}  // namespace breccia
