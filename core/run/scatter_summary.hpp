// SPDX-License-Identifier: BSD-3-Clause
/// What the bonds of a specimen have drawn of parameters that scatter, beside what was asked for.
#pragma once

#include "breccia/views.hpp"
#include "engine/interactions.hpp"

namespace breccia {

struct DrawnParameter {
  std::string parameter, unit;
  std::vector<std::string> materials;          ///< of the pairs it holds for; empty: all
  std::size_t bonds = 0;                       ///< that drew it
  double asked_mean = 0, asked_deviation = 0;  ///< of the distribution before it is truncated
  double mean = 0, deviation = 0;              ///< of the bonds; the deviation with n - 1, 0 of one bond
  Json json() const;                           ///< an entry of the summary
  std::string text() const;                    ///< a line of the log
};

/// Of a law's parameters in their order, for each kind of pair that has its own distribution. Of a specimen in parts
/// all ranks call it together.
std::vector<DrawnParameter> drawn_parameters(const NamedLaw& law, const SimulationView& view);

}  // namespace breccia
