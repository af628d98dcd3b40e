// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/calibration_files.hpp"

#include <cmath>

#include "breccia/atomic_file.hpp"
#include "calibrate/shown_values.hpp"
#include "results/curve_table.hpp"
#include "results/summary_keys.hpp"
#include "study/study_results.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

std::string cell(double v) { return std::isfinite(v) ? json_text(Json(v)) : ""; }

std::vector<std::string> parameter_headers(const CalibrationTrials& trials) {
  std::vector<std::string> names;
  const LoadedCalibration& c = trials.calibration();
  for (std::size_t k = 0; k < c.parameters.size(); ++k)
    names.push_back(header_name({c.parameters[k].name, trials.parameter_units()[k], ""}));
  return names;
}

std::string target_header(const LoadedCalibration::Target& t, const std::string& ending = "") {
  return header_name({t.name + ending, t.measure.unit, ""});
}

std::vector<std::string> parameter_cells(const CalibrationTrials& trials, const TrialPoint& values) {
  std::vector<std::string> cells;
  for (std::size_t k = 0; k < values.size(); ++k) cells.push_back(cell(si_value(trials, k, values[k])));
  return cells;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

std::string points_csv(const CalibrationTrials& trials, const Course& course) {
  const LoadedCalibration& c = trials.calibration();
  std::vector<std::string> header{"point", "why", "stage"};
  append(header, parameter_headers(trials));
  for (const auto& t : c.targets)
    append(header, {target_header(t), target_header(t, "_deviation"), t.name + "_packings"});
  header.push_back("distance");
  std::string text = csv_line(header);
  std::size_t number = 0;
  for (const CoursePoint& p : course.points()) {
    std::vector<std::string> row{std::to_string(++number), why_text(p.why), c.stages[p.stage].name};
    append(row, parameter_cells(trials, p.values));
    double sum = 0;
    for (std::size_t t = 0; t < c.targets.size(); ++t) {
      const TargetMeasure& m = c.targets[t].measure;
      const TargetStatistics s = statistics(p, t, m);
      const double mean = m.back(s.mean);
      append(row, {cell(mean), cell(m.log ? s.deviation * mean : s.deviation), std::to_string(s.count)});
      sum += residual_of(m, s.mean) * residual_of(m, s.mean);
    }
    row.push_back(cell(std::sqrt(sum / double(c.targets.size()))));
    text += csv_line(row);
  }
  return text;
}

std::string pareto_csv(const CalibrationTrials& trials, const CalibrationOutcome& outcome) {
  const LoadedCalibration& c = trials.calibration();
  std::vector<std::string> header = parameter_headers(trials);
  for (const auto& t : c.targets) append(header, {target_header(t), t.name + "_distance"});
  std::string text = csv_line(header);
  for (const ParetoPoint& p : outcome.front) {
    std::vector<std::string> row = parameter_cells(trials, p.values);
    for (std::size_t t = 0; t < c.targets.size(); ++t) append(row, {cell(p.predicted[t]), cell(p.distance[t])});
    text += csv_line(row);
  }
  return text;
}

Json number(double v) { return std::isfinite(v) ? Json(v) : Json(); }

/// The unit in which a user thinks of a value; null of a pure number.
Json given_in(const ChosenUnit& unit) {
  return unit.name.empty() ? Json() : Json({{"unit", unit.name}, {"factor", unit.factor}});
}

Json parameters_json(const CalibrationTrials& trials, const CalibrationOutcome& o) {
  const LoadedCalibration& c = trials.calibration();
  Json all = Json::object();
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const ParameterOutcome& p = o.parameters[k];
    const ParameterScale& scale = c.parameters[k].scale;
    Json one = {{"paths", c.parameters[k].paths},
                {"unit", trials.parameter_units()[k]},
                {"given_in", given_in(chosen_unit(trials, k))},
                {"range", {si_value(trials, k, scale.text(0)), si_value(trials, k, scale.text(1))}},
                {"scale", scale.log ? "log" : "linear"}};
    one["best"] = o.has_best ? Json(si_value(trials, k, p.best)) : Json();
    if (o.has_model) {
      one["interval_90"] = {si_value(trials, k, p.low), si_value(trials, k, p.high)};
      for (std::size_t t = 0; t < c.targets.size(); ++t)
        one["sensitivity"][c.targets[t].name] = {{"alone", p.of_target[t].alone}, {"total", p.of_target[t].total}};
    }
    all[c.parameters[k].name] = std::move(one);
  }
  return all;
}

Json targets_json(const CalibrationTrials& trials, const CalibrationOutcome& o) {
  const LoadedCalibration& c = trials.calibration();
  Json all = Json::object();
  for (std::size_t t = 0; t < c.targets.size(); ++t) {
    const TargetMeasure& m = c.targets[t].measure;
    const TargetOutcome& x = o.targets[t];
    all[c.targets[t].name] = {{"workflow", c.workflows[c.targets[t].workflow].name},
                              {"key", c.targets[t].key},
                              {"unit", m.unit},
                              {"given_in", given_in(chosen_unit(m))},
                              {"wanted", m.value},
                              {"scatter_of_experiment", m.scatter},
                              {"measured", number(x.measured)},
                              {"packings", x.packings},
                              {"scatter_of_packings", number(x.scatter)},
                              {"residual_over_scatter_of_experiment", number(x.residual)},
                              {"residual_over_scatter_of_packings", number(x.of_packings)},
                              {"predicted", number(x.predicted)},
                              {"predicted_deviation", number(m.log ? x.error * x.predicted : x.error)}};
  }
  return all;
}

}  // namespace

std::vector<std::string> calibration_file_names() {
  return {"calibration.json", "runs.csv", "points.csv", "report.md"};
}

std::string why_text(CoursePoint::Why why) {
  switch (why) {
    case CoursePoint::Why::start:
      return "start";
    case CoursePoint::Why::scaled:
      return "scaled";
    case CoursePoint::Why::search:
      return "search";
    case CoursePoint::Why::stage:
      return "best of the stage before";
    case CoursePoint::Why::check:
      return "check";
  }
  return {};
}

std::string runs_csv(const CalibrationTrials& trials, const Course& course, const std::vector<TrialRecord>& records) {
  const LoadedCalibration& c = trials.calibration();
  std::vector<std::string> header{"case", "folder", "point", "stage", "workflow", "seed"};
  append(header, parameter_headers(trials));
  header.push_back("status");
  for (const auto& t : c.targets) header.push_back(target_header(t));
  header.push_back("error");
  std::string text = csv_line(header);
  std::size_t point = 0, within = 0;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const TrialRecord& r = records[k];
    while (point < course.points().size() && within == course.points()[point].trials.size()) ++point, within = 0;
    // Of a batch that is under way the number of the point is not known yet.
    std::vector<std::string> row{std::to_string(k + 1),
                                 r.folder,
                                 point < course.points().size() ? std::to_string(point + 1) : "",
                                 c.stages[r.trial.stage].name,
                                 c.workflows[r.trial.workflow].name,
                                 std::to_string(r.trial.seed)};
    ++within;
    append(row, parameter_cells(trials, r.trial.values));
    row.push_back(state_text(r.state));
    for (const double v : r.result.value) row.push_back(cell(v));
    row.push_back(r.result.error.substr(0, r.result.error.find('\n')));
    text += csv_line(row);
  }
  return text;
}

std::vector<fs::path> write_calibration(const CalibrationTrials& trials, Course& course,
                                        const std::vector<TrialRecord>& records, const CalibrationOutcome& o,
                                        bool whole, const fs::path& folder, const fs::path& shown, Host& host) {
  const LoadedCalibration& c = trials.calibration();
  std::vector<fs::path> made;
  const auto write = [&](const fs::path& file, const std::string& text) {
    write_file(folder / file, text);
    made.push_back(folder / file);
  };
  write("runs.csv", runs_csv(trials, course, records));
  write("points.csv", points_csv(trials, course));
  if (!o.front.empty()) write("pareto.csv", pareto_csv(trials, o));
  if (o.has_best) {
    std::error_code error;
    fs::create_directories(folder / "best", error);
    if (error) throw UserError("cannot make the folder " + (folder / "best").string() + ": " + error.message());
    for (std::size_t w = 0; w < c.workflows.size(); ++w)
      write(fs::path("best") / (c.workflows[w].name + ".yaml"), trials.ready_workflow(w, o.best, shown / "best"));
  }
  const Json json = {{"name", c.config.name},
                     {"description", c.config.description},
                     {"breccia_version", BRECCIA_VERSION},
                     {"complete", whole},
                     {"runs", o.runs},
                     {"failed_runs", o.failed},
                     {"runs_out_of_time", o.out_of_time},
                     {"run_time_limit_s", c.run_time.seconds > 0 ? Json(c.run_time.seconds) : Json()},
                     {"points", o.points},
                     {"seed", c.config.seed},
                     {"search", c.search},
                     {"parameters", parameters_json(trials, o)},
                     {"targets", targets_json(trials, o)},
                     {"warnings", o.warnings}};
  write("calibration.json", json_text(json, 2) + "\n");
  const std::vector<fs::path> charts = draw_calibration(trials, course, o, folder, host);
  made.insert(made.end(), charts.begin(), charts.end());
  write("report.md", calibration_report(trials, course, o, whole, charts));
  return made;
}

}  // namespace breccia
