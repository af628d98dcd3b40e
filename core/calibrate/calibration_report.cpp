// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "calibrate/calibration_files.hpp"
#include "calibrate/shown_values.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

std::string rounded(double v, const char* form) {
  return std::isfinite(v) ? fmt::format(fmt::runtime(form), v) : std::string("-");
}

std::string parameters_table(const CalibrationTrials& trials, const CalibrationOutcome& o) {
  const LoadedCalibration& c = trials.calibration();
  std::string text = "| parameter | best | 5 % | 95 % | range |\n|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const ParameterOutcome& p = o.parameters[k];
    const ParameterScale& s = c.parameters[k].scale;
    text += fmt::format("| {} | {} | {} | {} | {} to {} |\n", c.parameters[k].name, shown(trials, k, p.best),
                        o.has_model ? shown(trials, k, p.low, digits_of_intervals) : "-",
                        o.has_model ? shown(trials, k, p.high, digits_of_intervals) : "-",
                        shown(trials, k, s.text(0), digits_of_ranges), shown(trials, k, s.text(1), digits_of_ranges));
  }
  return text;
}

std::string targets_table(const LoadedCalibration& c, const CalibrationOutcome& o) {
  std::string text =
      "| target | experiment | its scatter | check | packings | their scatter | off, in scatters of the experiment | "
      "of "
      "packings | model |\n|---|---|---|---|---|---|---|---|---|\n";
  for (std::size_t t = 0; t < c.targets.size(); ++t) {
    const TargetMeasure& m = c.targets[t].measure;
    const TargetOutcome& x = o.targets[t];
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", c.targets[t].name, shown(m, m.value),
                        shown(m, m.scatter, digits_of_errors), shown(m, x.measured), x.packings,
                        shown(m, x.scatter, digits_of_errors), rounded(x.residual, "{:+.2f}"),
                        rounded(x.of_packings, "{:+.2f}"), shown(m, x.predicted));
  }
  return text;
}

std::string sensitivities_table(const LoadedCalibration& c, const CalibrationOutcome& o) {
  std::string text = "| parameter |";
  for (const auto& t : c.targets) text += " " + t.name + " |";
  text += "\n|---|";
  for (std::size_t t = 0; t < c.targets.size(); ++t) text += "---|";
  text += "\n";
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    text += "| " + c.parameters[k].name + " |";
    for (const SearchSensitivity& s : o.parameters[k].of_target)
      text += fmt::format(" {:.2f} ({:.2f}) |", s.total, s.alone);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string calibration_report(const CalibrationTrials& trials, const Course& course, const CalibrationOutcome& o,
                               bool whole, const std::vector<fs::path>& charts) {
  const LoadedCalibration& c = trials.calibration();
  std::string text = "# " + c.config.name + "\n\n";
  if (!c.config.description.empty()) text += c.config.description + "\n\n";
  text += fmt::format("{} runs at {} points, {} of them failed{}.\n\n", o.runs, course.points().size(), o.failed,
                      whole ? "" : "; the calibration has not come to its end");
  if (!o.warnings.empty()) {
    text += "## What to know first\n\n";
    for (const std::string& w : o.warnings) text += "- " + w + "\n";
    text += "\n";
  }
  if (o.has_best) {
    text += "## Parameters\n\n" + parameters_table(trials, o) + "\n";
    if (o.has_model)
      text +=
          "Between the two ends lie 90 % of the values that agree with the experiment: each point of the ranges counts "
          "by how likely the targets are there, given the experiment's scatter and what the model does not know; the "
          "scatter of the packings is in the latter. They hold for each parameter by itself, the others free.\n\n";
    text += "## Targets\n\n" + targets_table(c, o) +
            "\nThe check: the best point with packings that the search has never seen.\n\n";
  }
  if (o.has_model)
    text += "## What depends on what\n\n" + sensitivities_table(c, o) +
            "\nShares of the variance of each target over the ranges that each parameter has a part in (by itself), by "
            "the model.\n\n";
  if (!o.front.empty())
    text += fmt::format(
        "## Contradiction\n\n`pareto.csv` holds {} points at which no target comes nearer without "
        "another going farther.\n\n",
        o.front.size());
  for (const fs::path& chart : charts)
    if (chart.extension() == ".png") text += "![" + chart.stem().string() + "](" + chart.filename().string() + ")\n\n";
  if (o.has_best) text += "The workflows with the best parameters are in `best/`.\n";
  return text;
}

}  // namespace breccia
