// SPDX-License-Identifier: BSD-3-Clause
/// What a run has left, as a report tells it. Nothing but the folder is asked.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "breccia/result_tools/table_file.hpp"
#include "breccia/services.hpp"

namespace breccia::report {

/// One curve, by the name that plugins give it.
struct Curve {
  std::string name, unit, doc, role;
  std::vector<double> values;
};

struct RunFiles {
  std::filesystem::path folder;
  Json summary;                    ///< an object
  Json input = Json::object();     ///< resolved.yaml, values as they are written there: "3e10 Pa"; empty without it
  std::string input_text;          ///< of the file
  std::vector<Curve> curves;       ///< none when curves.csv is not there
  std::vector<std::string> files;  ///< of the results, relative to the folder, in order of the alphabet
  std::string begun, ended;        ///< "2026-11-29 03:50:34", local time of the machine; empty without run.log
  bool interrupted = false;
  std::vector<std::string> missing;  ///< what a run leaves and is not there, a sentence each

  std::string name() const;
  const Curve* curve(const std::string& name) const;
  /// By dotted path; null when there is none.
  Json result(const std::string& path) const;
  Json given(const std::string& path) const;
  /// NaN when there is none.
  double number(const std::string& path) const;
  /// The laws of `contact_law`, one or several.
  std::vector<Json> laws() const;
};

/// UserError for a folder that is not that of a run that has come to an end.
RunFiles read_run_files(const std::filesystem::path& folder);

/// The member at a dotted path, or null.
Json at_path(const Json& object, const std::string& path);

}  // namespace breccia::report
