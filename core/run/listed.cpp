// SPDX-License-Identifier: BSD-3-Clause
#include "run/listed.hpp"

#include <algorithm>

namespace breccia {

std::span<const double> NamedCurves::column(std::string_view name) const {
  const std::string own = prefix_ + std::string(name);
  const std::vector<Column>& all = of_.columns();
  const bool is_own = std::any_of(all.begin(), all.end(), [&](const Column& c) { return c.name == own; });
  return of_.column(is_own ? std::string_view(own) : name);
}

}  // namespace breccia
