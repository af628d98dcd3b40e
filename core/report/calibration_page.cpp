// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/calibration_files.hpp"
#include "report/html.hpp"
#include "report/quantity.hpp"
#include "report/report_pages.hpp"
#include "report/run_parts.hpp"

namespace breccia::report {
namespace {

constexpr std::size_t rows_at_once = 15;  // of a front: more are told by its chart
constexpr std::size_t points_shown = 60;  // beyond that they are folded away

std::string code(const std::string& text) { return "<code>" + escaped(text) + "</code>"; }

/// "-0.5": with its sign, in units of a scatter.
std::string scatters(double v) {
  if (!std::isfinite(v)) return number_text(v);
  return (v > 0 ? "+" : "") + number_text(v, 2);
}

std::string parameters_table(const CalibrationFiles& c) {
  Table table("Parameters");
  table.column("Parameter")
      .column("Best", Table::Is::number)
      .column("90 % interval", Table::Is::number)
      .column("Range that was searched", Table::Is::number)
      .column("Where it stands in the workflows");
  for (const CalibratedQuantity& p : c.parameters) {
    std::string paths;
    const Json all = at_path(p.said, "paths");
    for (const Json& path : all)
      if (path.is_string()) paths += (paths.empty() ? "" : ", ") + code(path.get<std::string>());
    table.row({escaped(p.title), p.text(p.value("best")), p.ends("interval_90", 3), p.ends("range", 6), paths});
  }
  return table.html() +
         paragraph(
             "Between the ends of an interval lie 90 % of the values that agree with the laboratory, whatever the "
             "other "
             "parameters are: before any run all values of the range are equally likely (on a log scale where one was "
             "chosen), and each point then counts by how likely the targets are there, given the scatter of the "
             "experiments and what the model of the targets does not know.");
}

std::string targets_table(const CalibrationFiles& c) {
  Table table("Targets, and what new packings gave at the best point");
  table.column("Target")
      .column("Laboratory", Table::Is::number)
      .column("Check", Table::Is::number)
      .column("Packings", Table::Is::number)
      .column("Scatter of packings", Table::Is::number)
      .column("Off, in scatters of the experiment", Table::Is::number)
      .column("Off, in scatters of packings", Table::Is::number)
      .column("Model", Table::Is::number);
  for (const CalibratedQuantity& t : c.targets)
    table.row({escaped(t.title), t.number(t.value("wanted")) + " ± " + t.text(t.value("scatter_of_experiment"), 2),
               t.text(t.value("measured")), number_text(t.value("packings")), t.text(t.value("scatter_of_packings"), 2),
               scatters(t.value("residual_over_scatter_of_experiment")),
               scatters(t.value("residual_over_scatter_of_packings")),
               t.number(t.value("predicted")) + " ± " + t.text(t.value("predicted_deviation"), 2)});
  return table.html() + paragraph("The check: the best point once more, with packings that the search has never seen.");
}

std::string sensitivities_table(const CalibrationFiles& c) {
  Table table("Shares of each target's variance over the ranges in which a parameter has a part (by itself)");
  table.column("Parameter");
  for (const CalibratedQuantity& t : c.targets) table.column(t.title, Table::Is::number);
  for (const CalibratedQuantity& p : c.parameters) {
    if (at_path(p.said, "sensitivity").is_null()) return {};
    std::vector<std::string> row{escaped(p.title)};
    for (const CalibratedQuantity& t : c.targets)
      row.push_back(fmt::format("{:.2f} ({:.2f})", p.value("sensitivity." + t.name + ".total"),
                                p.value("sensitivity." + t.name + ".alone")));
    table.row(row);
  }
  return table.html();
}

/// Rows that lie evenly between the first and the last.
std::vector<std::size_t> some_of(std::size_t rows) {
  std::vector<std::size_t> all;
  const std::size_t shown = std::min(rows, rows_at_once);
  for (std::size_t k = 0; k < shown; ++k) all.push_back(shown == 1 ? 0 : k * (rows - 1) / (shown - 1));
  return all;
}

std::string front_table(const CalibrationFiles& c) {
  const std::size_t rows = c.pareto.rows.size();
  Table table("Points at which no target comes nearer without another going farther, by the model");
  for (const CalibratedQuantity& t : c.targets) table.column(t.title_with_unit(), Table::Is::number);
  for (const CalibratedQuantity& t : c.targets) table.column(t.title + ", scatters away", Table::Is::number);
  for (const CalibratedQuantity& p : c.parameters) table.column(p.title_with_unit(), Table::Is::number);
  for (const std::size_t r : some_of(rows)) {
    std::vector<std::string> row;
    for (const CalibratedQuantity& t : c.targets) row.push_back(t.number(c.pareto.number(r, t.column)));
    for (const CalibratedQuantity& t : c.targets)
      row.push_back(number_text(c.pareto.number(r, t.name + "_distance"), 2));
    for (const CalibratedQuantity& p : c.parameters) row.push_back(p.number(c.pareto.number(r, p.column)));
    table.row(row);
  }
  if (rows > rows_at_once)
    return table.html() + paragraph(number_text(double(rows_at_once)) + " of " + number_text(double(rows)) +
                                    " points; pareto.csv has all of them.");
  return table.html();
}

std::string points_tables(const CalibrationFiles& c) {
  Table where("The points and why they were run"), what("What each point gave: means, with deviations of packings");
  where.column("Point").column("Why").column("Stage");
  for (const CalibratedQuantity& p : c.parameters) where.column(p.title_with_unit(), Table::Is::number);
  what.column("Point");
  for (const CalibratedQuantity& t : c.targets) what.column(t.title_with_unit(), Table::Is::number);
  what.column("Distance, in scatters", Table::Is::number);
  for (std::size_t r = 0; r < c.points.rows.size(); ++r) {
    const std::string number = escaped(c.points.cell(r, "point"));
    std::vector<std::string> row{number, escaped(c.points.cell(r, "why")), escaped(c.points.cell(r, "stage"))};
    for (const CalibratedQuantity& p : c.parameters) row.push_back(p.number(c.points.number(r, p.column)));
    where.row(row);
    row = {number};
    for (const CalibratedQuantity& t : c.targets) {
      const double deviation = c.points.number(r, t.deviation_column);
      row.push_back(t.number(c.points.number(r, t.column)) +
                    (std::isfinite(deviation) ? " ± " + t.number(deviation, 2) : ""));
    }
    row.push_back(number_text(c.points.number(r, "distance"), 3));
    what.row(row);
  }
  const std::string both = where.html() + what.html();
  return c.points.rows.size() > points_shown
             ? foldable("All " + number_text(double(c.points.rows.size())) + " points", both)
             : both;
}

std::string failed_table(const CalibrationFiles& c) {
  Table table("Runs without results");
  table.column("Run").column("Folder").column("Point").column("Status").column("What was said");
  for (std::size_t r = 0; r < c.runs.rows.size(); ++r)
    if (c.runs.cell(r, "status") != "finished")
      table.row({escaped(c.runs.cell(r, "case")), code(c.runs.cell(r, "folder")), escaped(c.runs.cell(r, "point")),
                 escaped(c.runs.cell(r, "status")), escaped(c.runs.cell(r, "error"))});
  return table.html();
}

/// The charts whose names are of one of the three kinds that a calibration draws.
enum class Tells { course, contradiction, dependence };
std::string charts_that_tell(Tells of, const std::vector<Figure>& figures) {
  std::vector<Figure> some;
  for (const Figure& f : figures) {
    const Tells tells = f.name.starts_with("pareto_")      ? Tells::contradiction
                        : f.name.ends_with("_over_points") ? Tells::course
                                                           : Tells::dependence;
    if (tells == of) some.push_back(f);
  }
  return charts_html(some) + pictures_html(some);
}

std::string lead(const CalibrationFiles& c) {
  const std::size_t failed = c.count("failed_runs");
  return number_text(double(c.parameters.size())) + " parameters, " + number_text(double(c.targets.size())) +
         " targets; " + number_text(double(c.count("runs"))) + " runs at " + number_text(double(c.count("points"))) +
         " points, " + (failed == 0 ? "none" : number_text(double(failed))) + " of them failed.";
}

}  // namespace

std::string calibration_page(const CalibrationFiles& c, const std::vector<Figure>& figures, const std::string& methods,
                             const Registry& registry, const ReportFacts& facts) {
  const Json description = at_path(c.said, "description"), version = at_path(c.said, "breccia_version");
  std::string body = "<header>\n" + heading("Report of a calibration", c.name, facts.authors,
                                            version.is_string() ? "Breccia " + version.get<std::string>() : "");
  if (description.is_string() && !description.get<std::string>().empty())
    body += "<p class=\"lead\">" + escaped(description.get<std::string>()) + "</p>\n";
  body += paragraph(lead(c));
  if (!c.is_complete())
    body +=
        "<div class=\"note\"><p><strong>The calibration has not come to its end.</strong> This is what is known so "
        "far.</p></div>\n";
  body += "</header>\n<main>\n" + section("first", "What to know first", warnings_list(at_path(c.said, "warnings")));
  body += section("parameters", "Parameters", parameters_table(c));
  body += section("targets", "Targets", targets_table(c));
  body += section("contradiction", "Targets that contradict each other",
                  front_table(c) + charts_that_tell(Tells::contradiction, figures));
  body += section("dependence", "What depends on what",
                  sensitivities_table(c) + charts_that_tell(Tells::dependence, figures));
  body += section("course", "Course of the search", charts_that_tell(Tells::course, figures) + points_tables(c));
  body += section("failed", "Runs without results", failed_table(c));
  body += section("methods", "Methods, for a paper", methods);
  if (!c.examples.empty()) {
    body += section("computation", "Computation of the run " + c.examples[0].folder.filename().string(),
                    computation_part(c.examples[0]));
    body += section("cite", "How to cite", citation_part(c.examples[0], registry, search_source(c.search(), registry)));
  }
  std::string ready;
  for (const auto& [file, text] : c.ready)
    ready += foldable("Workflow with the best parameters: " + file, "<pre><code>" + escaped(text) + "</code></pre>\n");
  body += section("more", "Ready workflows", ready);
  return page(c.name + ": report of a calibration", body + "</main>\n" + footer(facts));
}

}  // namespace breccia::report
