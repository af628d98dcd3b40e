// SPDX-License-Identifier: BSD-3-Clause
/// Names of results: a quantity with its unit as data, and the key that stands for it in files.
#pragma once

#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "breccia/param_spec.hpp"

namespace breccia {

/// What a result is called, and its SI unit. "peak stress" in Pa has the key `peak_stress_Pa`, which nobody takes apart
/// again: the unit is kept beside it.
struct ResultName {
  std::string name;        ///< lower case with underscores, without the unit; "a.b" is b in the section a
  std::string unit = "1";  ///< SI; "1" for a pure number, or what is none
  ResultName(const char* n) : name(n) {}
  ResultName(std::string n) : name(std::move(n)) {}
  ResultName(std::string n, std::string u) : name(std::move(n)), unit(std::move(u)) {}
  /// "peak_stress_Pa".
  std::string key() const {
    if (unit == "1" || unit.empty()) return name;
    std::string written = name + "_";
    for (const char c : unit) written += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return written;
  }
};

/// Some of them, in order.
using Results = std::vector<std::pair<ResultName, Json>>;

}  // namespace breccia
