// SPDX-License-Identifier: BSD-3-Clause
#include "report/calibration_files.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "breccia/text_file.hpp"
#include "report/quantity.hpp"
#include "report/study_files.hpp"
#include "results/curve_table.hpp"
#include "results/results_folder.hpp"
#include "results/summary_keys.hpp"

namespace breccia::report {

namespace fs = std::filesystem;

namespace {

std::string text_of(const Json& object, const char* key) {
  const Json value = at_path(object, key);
  return value.is_string() ? value.get<std::string>() : "";
}

CsvTable table_of(const fs::path& file, bool needed) {
  CsvTable table;
  if (!needed && !fs::exists(file)) return table;
  try {
    table.rows = csv_rows(read_text_file(file));
  } catch (const UserError& e) { throw UserError(file.string() + " is damaged: " + e.what()); }
  if (table.rows.empty()) throw UserError(file.string() + " is empty");
  table.header = table.rows.front();
  table.rows.erase(table.rows.begin());
  for (const auto& row : table.rows)
    if (row.size() != table.header.size())
      throw UserError(file.string() + " is damaged: its rows differ in their number of cells");
  return table;
}

/// `size`: where `said` tells how large the values are.
CalibratedQuantity quantity_of(const std::string& name, const Json& said, const char* size) {
  CalibratedQuantity q{name, "", "", capital(readable(name)), text_of(said, "unit"), {}, 0, said};
  q.column = header_name({name, q.unit, ""});
  q.deviation_column = header_name({name + "_deviation", q.unit, ""});
  const double factor = q.value("given_in.factor");
  if (factor > 0) q.given_in = {text_of(said, "given_in.unit"), factor};
  const double like = q.value(size);
  q.like = std::isfinite(like) ? like : 0;
  return q;
}

std::vector<CalibratedQuantity> quantities_of(const Json& said, const char* section, const char* size) {
  std::vector<CalibratedQuantity> all;
  const Json members = at_path(said, section);
  for (const auto& [name, one] : members.items()) all.push_back(quantity_of(name, one, size));
  return all;
}

/// A finished run of each workflow: those of the check before others, since they have the best parameters.
std::vector<RunFiles> examples_of(const CalibrationFiles& c) {
  std::set<std::string> checked, workflows;
  for (std::size_t p = 0; p < c.points.rows.size(); ++p)
    if (c.points.cell(p, "why") == "check") checked.insert(c.points.cell(p, "point"));
  std::vector<RunFiles> all;
  for (const bool of_check : {true, false})
    for (std::size_t r = 0; r < c.runs.rows.size(); ++r) {
      const std::string workflow = c.runs.cell(r, "workflow");
      if (c.runs.cell(r, "status") != "finished" || workflows.contains(workflow) ||
          checked.contains(c.runs.cell(r, "point")) != of_check)
        continue;
      try {
        all.push_back(read_run_files(c.folder / "cases" / c.runs.cell(r, "folder")));
        workflows.insert(workflow);
      } catch (const UserError&) {}  // another may be whole
    }
  return all;
}

}  // namespace

std::string CsvTable::cell(std::size_t row, const std::string& column) const {
  const auto at = std::find(header.begin(), header.end(), column);
  return at == header.end() ? "" : rows[row][std::size_t(at - header.begin())];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  const Json value = Json::parse(cell(row, column), nullptr, false);
  return value.is_number() ? value.get<double>() : NAN;
}

double CalibratedQuantity::value(const std::string& path) const { return number_of(at_path(said, path)); }

ShownQuantity CalibratedQuantity::shown(double si, int digits) const {
  if (!std::isfinite(si)) return {number_text(NAN), ""};
  return shown_quantity(si, unit, given_in, like, digits);
}

std::string CalibratedQuantity::ends(const char* of, int digits) const {
  const double low = value(std::string(of) + ".0"), high = value(std::string(of) + ".1");
  if (!std::isfinite(low) || !std::isfinite(high)) return number_text(NAN);
  return number(low, digits) + " to " + text(high, digits);
}

std::string CalibratedQuantity::title_with_unit() const {
  const std::string in = shown(like, 4).unit;
  return title + (in.empty() ? "" : " (" + in + ")");
}

std::string CalibrationFiles::search() const { return text_of(said, "search"); }

std::size_t CalibrationFiles::count(const char* key) const {
  const Json value = at_path(said, key);
  return value.is_number_unsigned() ? value.get<std::size_t>() : 0;
}

CalibrationFiles read_calibration_files(const fs::path& folder) {
  const fs::path file = folder / "calibration.json";
  if (!fs::exists(file))
    throw UserError("the calibration in " + folder.string() +
                    " has no result yet: there is no calibration.json; `breccia calibrate FILE` goes on with it, and "
                    "with --collect it writes what is known so far");
  CalibrationFiles c;
  c.folder = fs::weakly_canonical(fs::absolute(folder));
  c.said = Json::parse(read_bytes(file), nullptr, false);
  if (!c.said.is_object() || !at_path(c.said, "parameters").is_object() || !at_path(c.said, "targets").is_object())
    throw UserError(file.string() + " is damaged: it is not what a calibration writes");
  c.name = text_of(c.said, "name");
  c.parameters = quantities_of(c.said, "parameters", "range.1");
  c.targets = quantities_of(c.said, "targets", "wanted");
  c.points = table_of(folder / "points.csv", true);
  c.runs = table_of(folder / "runs.csv", true);
  c.pareto = table_of(folder / "pareto.csv", false);
  c.files = listed_results(folder);
  for (const std::string& f : c.files)
    if (f.starts_with("best/") && has_ending(f, ".yaml")) c.ready.emplace_back(f, read_text_file(folder / f));
  c.examples = examples_of(c);
  return c;
}

}  // namespace breccia::report
