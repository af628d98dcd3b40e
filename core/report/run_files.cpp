// SPDX-License-Identifier: BSD-3-Clause
#include "report/run_files.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "config/at_path.hpp"
#include "config/yaml_tree.hpp"
#include "results/curve_table.hpp"
#include "results/results_folder.hpp"

namespace breccia::report {

namespace fs = std::filesystem;

namespace {

Json read_json_object(const fs::path& file) {
  Json json = Json::parse(read_bytes(file), nullptr, false);
  if (!json.is_object()) throw UserError(file.string() + " is damaged: it is not a JSON object");
  return json;
}

/// The times at the beginning of the first and the last line that has one.
void read_times(const fs::path& log, RunFiles& run) {
  std::ifstream in(log, std::ios::binary);
  constexpr std::string_view form = "dddd-dd-dd dd:dd:dd ";
  for (std::string line; std::getline(in, line);) {
    bool fits = line.size() > form.size();
    for (std::size_t k = 0; fits && k < form.size(); ++k)
      fits = form[k] == 'd' ? line[k] >= '0' && line[k] <= '9' : line[k] == form[k];
    if (!fits) continue;
    if (run.begun.empty()) run.begun = line.substr(0, form.size() - 1);
    run.ended = line.substr(0, form.size() - 1);
  }
}

void read_input(const fs::path& file, RunFiles& run) {
  run.input_text = read_text_file(file);
  std::vector<Finding> findings;
  const YamlPtr tree = parse_yaml(run.input_text, {}, findings);
  if (tree) run.input = plain_json(*tree);
  if (!tree || !run.input.is_object())
    throw UserError(file.string() + " is damaged" + (findings.empty() ? "" : ": " + findings[0].text));
}

void read_curves(const fs::path& file, RunFiles& run) {
  const TableFile table(file);
  const fs::path units = curve_units_file(file);
  const Json described = fs::exists(units) ? Json::parse(read_bytes(units), nullptr, false) : Json();
  if (!described.is_array()) return;  // without names and units nothing can be said of them
  for (const Json& c : described) {
    const auto text = [&](const char* key) { return c.is_object() ? c.value(key, std::string()) : std::string(); };
    const auto& headers = table.headers();
    if (std::find(headers.begin(), headers.end(), text("header")) == headers.end()) continue;
    const std::string role = c.contains("role") ? text("role") : std::string(role::of_name(text("name")));
    run.curves.push_back({text("name"), text("unit"), text("doc"), role, table.column(text("header"))});
  }
}

}  // namespace

Json at_path(const Json& object, const std::string& path) {
  const Json* value = value_at(object, path);
  return value ? *value : Json();
}

std::string RunFiles::name() const {
  const Json written = result("workflow");
  return written.is_string() ? written.get<std::string>() : folder.filename().string();
}

const Curve* RunFiles::curve(const std::string& wanted) const {
  for (const Curve& c : curves)
    if (c.name == wanted) return &c;
  return nullptr;
}

Json RunFiles::result(const std::string& path) const { return at_path(summary, path); }
Json RunFiles::given(const std::string& path) const { return at_path(input, path); }

double RunFiles::number(const std::string& path) const {
  const Json v = result(path);
  return v.is_number() ? v.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::vector<Json> RunFiles::laws() const {
  const Json law = given("contact_law");
  if (law.is_array()) return law.get<std::vector<Json>>();
  return law.is_object() ? std::vector<Json>{law} : std::vector<Json>{};
}

RunFiles read_run_files(const fs::path& folder) {
  const std::string name = folder.string();
  const fs::path file = folder / "summary.json";
  if (!fs::exists(file)) {
    if (!unfinished_results(folder).empty())
      throw UserError("the run in " + name +
                      " has not come to an end: there is no summary.json yet. If it was killed, "
                      "`breccia run --resume " +
                      name + "` goes on with it");
    throw UserError(name + " is not the result folder of a run or a study: it has no summary.json");
  }
  RunFiles run;
  run.folder = fs::weakly_canonical(fs::absolute(folder));
  if (!run.folder.has_filename()) run.folder = run.folder.parent_path();
  run.summary = read_json_object(file);
  if (!run.summary.contains("workflow") || !run.summary.contains("particles"))
    throw UserError(file.string() +
                    " is not the summary of a workflow's run: a report tells of specimens, not of "
                    "what `drive` or another program leaves");
  run.interrupted = run.result("interrupted") == true;
  if (fs::exists(folder / "resolved.yaml")) read_input(folder / "resolved.yaml", run);
  else run.missing.emplace_back("The input (resolved.yaml) is not in the folder: what it says is left out.");
  if (fs::exists(folder / "curves.csv")) read_curves(folder / "curves.csv", run);
  else run.missing.emplace_back("The curves (curves.csv) are not in the folder: what follows from them is left out.");
  if (fs::exists(folder / "run.log")) read_times(folder / "run.log", run);
  run.files = listed_results(folder);
  return run;
}

}  // namespace breccia::report
