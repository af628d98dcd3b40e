// SPDX-License-Identifier: BSD-3-Clause
#include "report/study_files.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "config/yaml_tree.hpp"
#include "report/quantity.hpp"
#include "results/results_folder.hpp"
#include "results/summary_keys.hpp"

namespace breccia::report {

namespace fs = std::filesystem;

namespace {

Json json_cell(const std::string& text) {
  if (text.empty()) return {};
  const Json number = Json::parse(text, nullptr, false);
  return number.is_number() ? number : Json(text);
}

/// "contact_law.bond_modulus_Pa" with the unit that the value has in the input of a case.
StudyColumn input_column(const std::string& header, const Json& input) {
  for (std::size_t end = header.size(); end != header.npos && end > 0; end = header.rfind('_', end - 1)) {
    const std::string path = header.substr(0, end);
    const Json written = at_path(input, path);
    if (written.is_null()) continue;
    std::string unit;
    if (written.is_string() && is_quantity(written)) {
      const std::string text = written.get<std::string>();
      if (const std::size_t space = text.find(' '); space != text.npos) unit = text.substr(space + 1);
    }
    if (ResultName(path, unit).key() == header) return {header, readable(split_path(path).back().name), unit, path};
  }
  return {header, header, ""};
}

/// Titles that say too little together are given as they are written.
void tell_apart(std::vector<StudyColumn>& columns) {
  std::multiset<std::string> titles;
  for (const StudyColumn& c : columns) titles.insert(c.title);
  for (StudyColumn& c : columns)
    if (titles.count(c.title) > 1) c.title = c.path;
}

std::size_t position(const std::vector<std::string>& header, const char* name, const fs::path& file) {
  const auto it = std::find(header.begin(), header.end(), name);
  if (it == header.end())
    throw UserError(file.string() + " is not the table of a study: it has no column `" + name + "`");
  return std::size_t(it - header.begin());
}

}  // namespace

std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  bool quoted = false, begun = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (!begun) {
      rows.push_back({""});
      begun = true;
    }
    std::string& cell = rows.back().back();
    if (quoted) {
      if (text[k] != '"') cell += text[k];
      else if (k + 1 < text.size() && text[k + 1] == '"') cell += text[k++];
      else quoted = false;
    } else if (text[k] == '"') quoted = true;
    else if (text[k] == ',') rows.back().emplace_back();
    else if (text[k] == '\n') begun = false;
    else cell += text[k];
  }
  if (quoted) throw UserError("a quote is never closed");
  return rows;
}

StudyFiles read_study_files(const fs::path& folder) {
  const fs::path file = folder / "results.csv";
  if (!fs::exists(file))
    throw UserError("the study in " + folder.string() +
                    " has not been gathered: there is no results.csv yet; "
                    "`breccia sweep STUDY --collect` writes it");
  StudyFiles study;
  study.folder = fs::weakly_canonical(fs::absolute(folder));
  if (!study.folder.has_filename()) study.folder = study.folder.parent_path();
  study.name = study.folder.filename().string();
  study.files = listed_results(folder);
  std::vector<std::vector<std::string>> rows;
  try {
    rows = csv_rows(read_text_file(file));
  } catch (const UserError& e) { throw UserError(file.string() + " is damaged: " + e.what()); }
  if (rows.empty()) throw UserError(file.string() + " is empty");
  const std::vector<std::string> header = rows[0];
  const std::size_t number = position(header, "case", file), place = position(header, "folder", file),
                    status = position(header, "status", file), error = position(header, "error", file);
  const bool by_workflow = header.size() > place + 1 && header[place + 1] == "workflow";
  const std::size_t first_input = place + 1 + by_workflow;
  if (!(number < place && first_input <= status && status < error && error + 1 == header.size()))
    throw UserError(file.string() + " is not the table of a study: its columns are in another order");
  std::set<std::string> workflows;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const auto& row = rows[r];
    if (row.size() != header.size())
      throw UserError(file.string() + " is damaged: row " + std::to_string(r + 1) + " has " +
                      std::to_string(row.size()) + " cells");
    StudyCase c{row[number], row[place], by_workflow ? row[place + 1] : "", row[status], row[error], {}, {}};
    for (std::size_t k = first_input; k < status; ++k) c.inputs.push_back(json_cell(row[k]));
    for (std::size_t k = status + 1; k < error; ++k) c.values.push_back(json_cell(row[k]));
    if (c.has_finished() && workflows.insert(c.workflow).second) {
      try {
        study.examples.push_back(read_run_files(folder / "cases" / c.folder));
      } catch (const UserError&) { workflows.erase(c.workflow); }  // another may be whole
    }
    study.cases.push_back(std::move(c));
  }
  const Json input = study.examples.empty() ? Json::object() : study.examples[0].input;
  for (std::size_t k = first_input; k < status; ++k) study.inputs.push_back(input_column(header[k], input));
  for (std::size_t k = status + 1; k < error; ++k) {
    TitleAndUnit said = title_of(header[k], Json::object());
    for (const RunFiles& run : study.examples)
      if (TitleAndUnit more = title_of(header[k], run.summary); said.unit.empty() && !more.unit.empty()) said = more;
    study.values.push_back({header[k], said.title, said.unit});
  }
  tell_apart(study.inputs);
  tell_apart(study.values);
  for (const RunFiles& run : study.examples)
    if (fs::exists(run.folder / "case.json")) {
      const Json about = Json::parse(read_bytes(run.folder / "case.json"), nullptr, false);
      if (about.is_object() && about.value("study", Json()).is_string()) study.name = about["study"].get<std::string>();
    }
  return study;
}

std::size_t StudyFiles::finished() const {
  return std::size_t(std::count_if(cases.begin(), cases.end(), [](const StudyCase& c) { return c.has_finished(); }));
}

std::vector<double> StudyFiles::numbers(std::size_t value) const {
  std::vector<double> all;
  for (const StudyCase& c : cases)
    if (c.has_finished() && c.values[value].is_number()) all.push_back(c.values[value].get<double>());
  return all;
}

Scatter scatter_of(const std::vector<double>& numbers) {
  Scatter s;
  s.count = numbers.size();
  if (numbers.empty()) return s;
  s.least = *std::min_element(numbers.begin(), numbers.end());
  s.largest = *std::max_element(numbers.begin(), numbers.end());
  for (const double v : numbers) s.mean += v / double(s.count);
  double squares = 0;
  for (const double v : numbers) squares += (v - s.mean) * (v - s.mean);
  s.deviation = s.count > 1 ? std::sqrt(squares / double(s.count - 1)) : std::numeric_limits<double>::quiet_NaN();
  return s;
}

}  // namespace breccia::report
