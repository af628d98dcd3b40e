// SPDX-License-Identifier: BSD-3-Clause
/// What an output asks of a field before it writes it.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "breccia/error.hpp"
#include "breccia/services.hpp"

namespace breccia {

/// UserError when the field does not have its components for each of `size` particles or bonds, or when it says that it
/// holds whole numbers and does not.
inline void check_field(const Field& f, std::size_t size, std::string_view output) {
  const std::string who = "output " + std::string(output) + ": field `" + f.name + "` ";
  if (f.components < 1 || f.values.size() != size * std::size_t(f.components))
    throw UserError(who + "has " + std::to_string(f.values.size()) + " values, where " + std::to_string(size) +
                    (f.on == Field::On::particles ? " particles" : " bonds") + " with " + std::to_string(f.components) +
                    " components each are written: mend the plugin that makes it");
  if (!f.whole) return;
  for (const double v : f.values)
    if (!(std::abs(v) <= 0x1p53) || v != std::floor(v))
      throw UserError(who + "is said to hold whole numbers, and holds " + std::to_string(v) +
                      ": mend the plugin that makes it");
}

/// Two arrays of one name cannot stand in a file.
[[noreturn]] inline void refuse_second_field(std::string_view name, std::string_view output) {
  throw UserError("output " + std::string(output) + ": two fields are named `" + std::string(name) +
                  "`; rename the one that a post-processor makes");
}

}  // namespace breccia
