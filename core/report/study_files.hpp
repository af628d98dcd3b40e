// SPDX-License-Identifier: BSD-3-Clause
/// What a study has left, as a report tells it: results.csv, and the folders of its cases.
#pragma once

#include "report/run_files.hpp"

namespace breccia::report {

struct StudyColumn {
  std::string key, title, unit;  ///< as results.csv has it; for readers; SI, empty for pure numbers
  std::string path = key;        ///< of a parameter: in the workflow
  bool is_seed() const { return key == "seed" || key.ends_with(".seed"); }
};

struct StudyCase {
  std::string number, folder, workflow, status, error;
  std::vector<Json> inputs, values;  ///< numbers, texts or null, one per column
  bool has_finished() const { return status == "finished"; }
};

struct StudyFiles {
  std::filesystem::path folder;
  std::string name;
  std::vector<StudyColumn> inputs, values;  ///< what was varied; what was measured
  std::vector<StudyCase> cases;
  std::vector<std::string> files;
  std::vector<RunFiles> examples;  ///< the first finished case of each workflow

  std::size_t finished() const;
  /// Of the finished cases that have a number there.
  std::vector<double> numbers(std::size_t value) const;
};

/// UserError when the folder is not that of a study that has been gathered.
StudyFiles read_study_files(const std::filesystem::path& folder);

/// Rows of a CSV file, cells in quotes included. UserError when a quote is never closed.
std::vector<std::vector<std::string>> csv_rows(const std::string& text);

struct Scatter {
  std::size_t count = 0;
  double mean = 0, deviation = 0, least = 0, largest = 0;  ///< the standard deviation with n - 1; NaN of one number
};
Scatter scatter_of(const std::vector<double>& numbers);

}  // namespace breccia::report
