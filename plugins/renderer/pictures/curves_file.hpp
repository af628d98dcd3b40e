// SPDX-License-Identifier: BSD-3-Clause
/// curves.csv and the tables of a run: one header line of names with their units ("axial_stress_Pa"), then numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "breccia/roles.hpp"

namespace breccia::pictures {

struct Curve {
  std::string name;  ///< without the unit
  std::string unit;  ///< SI; empty for a pure number
  std::vector<double> value;
  std::string doc = {}, role = {};  ///< what curves.json says of it
};

class CurvesFile {
 public:
  /// UserError, with the line, for what is not a table of numbers.
  explicit CurvesFile(const std::filesystem::path& file);

  /// By header, or by name without the unit. UserError with the nearest and all names when there is none.
  const Curve& at(const std::string& name) const;
  const Curve* find(const std::string& name) const;
  /// By role: the first that there is.
  const Curve* find_role(std::initializer_list<std::string_view> roles) const { return role::find(curves_, roles); }
  const std::vector<Curve>& all() const { return curves_; }

 private:
  std::filesystem::path file_;
  std::vector<std::string> headers_;
  std::vector<Curve> curves_;
};

}  // namespace breccia::pictures
