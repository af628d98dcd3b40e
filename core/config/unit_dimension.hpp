// SPDX-License-Identifier: BSD-3-Clause
/// UDUNITS-2 behind a narrow door: units, their dimensions, conversions. Internal to the configuration.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace breccia::units {

/// Powers of the basic units by symbol: {kg: 1, m: -1, s: -2} for a pressure. Angles count (rad: 1).
using Dimension = std::map<std::string, int>;

/// A unit as UDUNITS understands it. One basic unit product = `factor` * number + `offset`.
struct Unit {
  Dimension dimension;
  double factor = 1, offset = 0;
};

/// Nothing for an unknown spelling, and for dates and logarithmic units. UserError when the units database is missing.
std::optional<Unit> find_unit(std::string_view text);

/// One family of quantities that has a common name.
struct Family {
  const char* name;  ///< with its article: "a pressure"
  const char* si;
  const char* examples;  ///< "Pa, MPa, GPa or psi"
  const char* usual;     ///< "MPa"
};

/// The family of a dimension, or nullptr.
const Family* family_of(const Dimension& dimension);

/// The spelling of a common unit of `dimension` that was probably meant by `written`, or empty.
std::string similar_unit(std::string_view written, const Dimension& dimension);

}  // namespace breccia::units
