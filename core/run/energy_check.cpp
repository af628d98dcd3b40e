// SPDX-License-Identifier: BSD-3-Clause
#include "run/energy_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "breccia/error.hpp"

namespace breccia {

void EnergyCheck::see(const EnergyLedger& e) {
  largest_ = std::max({largest_, std::abs(e.boundary_work), std::abs(e.initial), std::abs(e.elastic + e.kinetic)});
}

double EnergyCheck::share(double error, double floor) const {
  const double reference = std::max(largest_, floor);
  return reference > 0 ? std::abs(error) / reference : 0;
}

std::string EnergyCheck::text(double share, const std::string& when) const {
  return fmt::format(
      "energy does not close: {:.3g} % of the work is unaccounted for {}: the time step does not resolve the motion "
      "(collisions of loose particles need a smaller engine.time_step_safety), or the energy function or the reported "
      "dissipation of contact law `{}` does not match its force",
      100 * share, when, law_);
}

void EnergyCheck::sample(const EnergyLedger& e, std::uint64_t step, Host& host) {
  see(e);
  const double off = share(e.error(), limits_.floor);
  const std::string when = fmt::format("at step {}", step);
  if (off > limits_.end)
    throw UserError(text(off, when) +
                    fmt::format("; the run ends here, at {:.3g} %; engine.energy_error_limit: 1e9 lets it go on",
                                100 * limits_.end));
  if (off > limits_.warn && !warned_) {
    warned_ = true;
    host.warn(text(off, when));
  }
}

void EnergyCheck::finish(const EnergyLedger& e, std::uint64_t step, Host& host) {
  see(e);
  const double off = share(e.error(), 0);
  if (off > limits_.warn && !warned_) host.warn(text(off, fmt::format("at the end, step {}", step)));
}

}  // namespace breccia
