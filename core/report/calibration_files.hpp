// SPDX-License-Identifier: BSD-3-Clause
/// What a calibration has left, as a report tells it: calibration.json, its tables, and the folders of its runs.
#pragma once

#include "report/run_files.hpp"
#include "results/shown_quantity.hpp"

namespace breccia::report {

/// A table of the results; cells as they are written.
struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  /// The cell of that column; empty when there is none.
  std::string cell(std::size_t row, const std::string& column) const;
  /// NaN when it holds no number.
  double number(std::size_t row, const std::string& column) const;
};

/// A parameter or a target.
struct CalibratedQuantity {
  std::string name, column;      ///< as the file has it; in the tables
  std::string deviation_column;  ///< of a target: how packings scatter
  std::string title;             ///< for readers
  std::string unit;              ///< SI
  ChosenUnit given_in;           ///< by the user
  double like = 0;               ///< SI, of the size of its values
  Json said;                     ///< its part of calibration.json

  /// Of a value in SI: with its unit, and without; of what is no number a dash.
  std::string text(double si, int digits = 4) const { return shown(si, digits).text(); }
  std::string number(double si, int digits = 4) const { return shown(si, digits).number; }
  std::string title_with_unit() const;
  std::string ends(const char* of, int digits) const;  ///< "1 to 2 GPa": of an interval of `said`
  double value(const std::string& path) const;         ///< of `said`, NaN where it has none

 private:
  ShownQuantity shown(double si, int digits) const;
};

struct CalibrationFiles {
  std::filesystem::path folder;
  std::string name;
  Json said;  ///< calibration.json
  std::vector<CalibratedQuantity> parameters, targets;
  CsvTable points, runs, pareto;  ///< `pareto` has no rows where targets do not contradict each other
  std::vector<std::string> files;
  std::vector<std::pair<std::string, std::string>> ready;  ///< workflows with the best parameters: file, text
  std::vector<RunFiles> examples;  ///< a run of each workflow, at the best point if it was checked there

  std::size_t count(const char* key) const;  ///< of calibration.json; 0 when it has none
  std::string search() const;                ///< the name of what proposed the points
  bool is_complete() const { return said.value("complete", Json()) == true; }
};

/// UserError when the folder is not that of a calibration that has come to a result.
CalibrationFiles read_calibration_files(const std::filesystem::path& folder);

}  // namespace breccia::report
