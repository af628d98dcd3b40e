// SPDX-License-Identifier: BSD-3-Clause
/// The names and numbers of summary.json, as tables of several runs show them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "breccia/schema.hpp"

namespace breccia {

/// Whether a key of the top level tells of the computation (steps, wall time) rather than of the specimen.
bool is_bookkeeping(const std::string& key);

/// What a summary calls a quantity, and its unit; that is empty for a pure number, and where the summary does not say.
struct TitleAndUnit {
  std::string title, unit;
};
/// Of a dotted key: the last of its names. `peak_stress_Pa` is a peak stress in Pa if the summary says so.
TitleAndUnit title_of(const std::string& key, const Json& summary);

/// A name for readers: "peak stress", "Young's modulus".
std::string readable(std::string name);

/// The numbers below a JSON object with their dotted names, truth values as 1 and 0. A number that a run could not
/// measure is null and kept.
std::vector<std::pair<std::string, Json>> numbers_below(const Json& object, const std::string& prefix = "");

/// A cell of a CSV file: in quotes where it needs them.
std::string csv_cell(const std::string& text);
/// With its end of line.
std::string csv_line(const std::vector<std::string>& cells);

}  // namespace breccia
