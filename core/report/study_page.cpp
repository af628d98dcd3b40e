// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>

#include "report/html.hpp"
#include "report/quantity.hpp"
#include "report/report_pages.hpp"
#include "report/run_parts.hpp"

namespace breccia::report {
namespace {

double largest_size(const std::vector<double>& numbers) {
  double largest = 0;
  for (const double v : numbers) largest = std::max(largest, std::abs(v));
  return largest;
}

/// Of a column: its title with the unit that suits its largest number, and its numbers in that unit.
class Shown {
 public:
  Shown(const StudyColumn& column, double largest) : unit_(column.unit), like_(largest) {
    const std::string unit = shown_quantity(largest, unit_).unit;
    title_ = capital(column.title) + (unit.empty() ? "" : " (" + unit + ")");
  }
  const std::string& title() const { return title_; }
  std::string number(double value) const { return shown_quantity(value, unit_, like_).number; }
  std::string cell(const Json& v) const {
    if (v.is_number()) return number(v.get<double>());
    return v.is_string() ? escaped(v.get<std::string>()) : "";
  }

 private:
  std::string unit_, title_;
  double like_;
};

Shown shown_input(const StudyFiles& study, std::size_t k) {
  double largest = 0;
  for (const StudyCase& c : study.cases)
    if (c.inputs[k].is_number()) largest = std::max(largest, std::abs(c.inputs[k].get<double>()));
  return {study.inputs[k], largest};
}

Shown shown_value(const StudyFiles& study, std::size_t k) { return {study.values[k], largest_size(study.numbers(k))}; }

/// Strength and stiffness first; seeds are numbers of no size.
std::vector<std::size_t> values_in_order(const StudyFiles& study) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < study.values.size(); ++k)
    if (!study.values[k].is_seed() && !study.numbers(k).empty()) all.push_back(k);
  std::stable_partition(all.begin(), all.end(), [&](std::size_t k) { return !is_secondary(study.values[k].key); });
  return all;
}

/// Those that differ among the cases, by more than rounding; of the others one number says all.
std::vector<std::size_t> values_that_differ(const StudyFiles& study) {
  std::vector<std::size_t> all;
  for (const std::size_t k : values_in_order(study)) {
    const Scatter s = scatter_of(study.numbers(k));
    if (s.count == 1 || s.largest - s.least > 1e-12 * std::abs(s.mean)) all.push_back(k);
  }
  return all;
}

std::string varied_table(const StudyFiles& study) {
  Table table("What was varied");
  table.column("Parameter").column("Values").column("Path in the workflow");
  for (std::size_t k = 0; k < study.inputs.size(); ++k) {
    const Shown shown = shown_input(study, k);
    std::vector<Json> values;
    for (const StudyCase& c : study.cases)
      if (std::find(values.begin(), values.end(), c.inputs[k]) == values.end()) values.push_back(c.inputs[k]);
    const bool numbers = std::all_of(values.begin(), values.end(), [](const Json& v) { return v.is_number(); });
    std::string text;
    if (numbers && values.size() > 12) {
      std::sort(values.begin(), values.end(),
                [](const Json& a, const Json& b) { return a.get<double>() < b.get<double>(); });
      text = std::to_string(values.size()) + " values from " + shown.cell(values.front()) + " to " +
             shown.cell(values.back());
    } else {
      for (const Json& v : values) text += (text.empty() ? "" : ", ") + shown.cell(v);
    }
    table.row({escaped(shown.title()), text, "<code>" + escaped(study.inputs[k].path) + "</code>"});
  }
  return table.html();
}

std::string scatter_table(const StudyFiles& study) {
  Table table("Over all finished cases");
  table.column("Quantity")
      .column("Cases", Table::Is::number)
      .column("Mean", Table::Is::number)
      .column("Standard deviation", Table::Is::number)
      .column("Least", Table::Is::number)
      .column("Largest", Table::Is::number);
  for (const std::size_t k : values_in_order(study)) {
    Scatter s = scatter_of(study.numbers(k));
    if (s.deviation < 1e-12 * std::abs(s.mean)) s.deviation = 0;  // of rounding
    const Shown shown = shown_value(study, k);
    table.row({escaped(shown.title()), std::to_string(s.count), shown.number(s.mean), shown.number(s.deviation),
               shown.number(s.least), shown.number(s.largest)});
  }
  return table.html();
}

/// Cases that differ in nothing but seeds are one group; none when no seed was varied beside other parameters.
std::string seeds_tables(const StudyFiles& study, const std::vector<std::size_t>& values) {
  std::vector<std::size_t> others;
  for (std::size_t k = 0; k < study.inputs.size(); ++k)
    if (!study.inputs[k].is_seed()) others.push_back(k);
  const bool by_workflow = !study.cases.empty() && !study.cases[0].workflow.empty();
  if (others.size() == study.inputs.size() || (others.empty() && !by_workflow)) return {};
  std::vector<std::string> order;
  std::map<std::string, std::vector<const StudyCase*>> groups;
  for (const StudyCase& c : study.cases) {
    if (!c.has_finished()) continue;
    std::string key = c.workflow;
    for (const std::size_t k : others) key += "\n" + c.inputs[k].dump(-1, ' ', false, Json::error_handler_t::replace);
    if (!groups.contains(key)) order.push_back(key);
    groups[key].push_back(&c);
  }
  std::string out;
  for (std::size_t from = 0; from < values.size(); from += 3) {
    Table table(from == 0 ? "Means over the seeds, with the standard deviation" : "Means over the seeds, continued");
    if (by_workflow) table.column("Workflow");
    for (const std::size_t k : others) table.column(shown_input(study, k).title(), Table::Is::number);
    table.column("Cases", Table::Is::number);
    const std::vector<std::size_t> some(values.begin() + std::ptrdiff_t(from),
                                        values.begin() + std::ptrdiff_t(std::min(from + 3, values.size())));
    for (const std::size_t v : some) table.column(shown_value(study, v).title(), Table::Is::number);
    for (const std::string& key : order) {
      const auto& group = groups[key];
      std::vector<std::string> row;
      if (by_workflow) row.push_back(escaped(group[0]->workflow));
      for (const std::size_t k : others) row.push_back(shown_input(study, k).cell(group[0]->inputs[k]));
      row.push_back(std::to_string(group.size()));
      for (const std::size_t v : some) {
        std::vector<double> numbers;
        for (const StudyCase* c : group)
          if (c->values[v].is_number()) numbers.push_back(c->values[v].get<double>());
        const Scatter s = scatter_of(numbers);
        const Shown shown = shown_value(study, v);
        row.push_back(s.count == 0 ? ""
                                   : shown.number(s.mean) + (s.count > 1 ? " ± " + shown.number(s.deviation) : ""));
      }
      table.row(row);
    }
    out += table.html();
  }
  return out;
}

/// All cases, a few columns at a time: paper is narrow.
std::string cases_tables(const StudyFiles& study, const std::vector<std::size_t>& values) {
  const bool by_workflow = !study.cases.empty() && !study.cases[0].workflow.empty(),
             inputs_here = study.inputs.size() <= 3;
  const std::size_t at_once = inputs_here ? 4 : 6;
  std::string out;
  const auto tables_from = [&](const std::string& caption, bool with_inputs, std::size_t from, std::size_t to) {
    Table table(caption);
    table.column("Case");
    if (by_workflow) table.column("Workflow");
    if (with_inputs)
      for (std::size_t k = 0; k < study.inputs.size(); ++k)
        table.column(shown_input(study, k).title(), Table::Is::number);
    for (std::size_t v = from; v < to; ++v) table.column(shown_value(study, values[v]).title(), Table::Is::number);
    if (to == from || from == 0) table.column("Status");
    for (const StudyCase& c : study.cases) {
      std::vector<std::string> row{escaped(c.number)};
      if (by_workflow) row.push_back(escaped(c.workflow));
      if (with_inputs)
        for (std::size_t k = 0; k < study.inputs.size(); ++k) row.push_back(shown_input(study, k).cell(c.inputs[k]));
      for (std::size_t v = from; v < to; ++v) row.push_back(shown_value(study, values[v]).cell(c.values[values[v]]));
      if (to == from || from == 0) row.push_back(escaped(c.status));
      table.row(row);
    }
    out += table.html();
  };
  if (!inputs_here || values.empty()) tables_from("The cases and their parameters", true, 0, 0);
  for (std::size_t from = 0; from < values.size(); from += at_once)
    tables_from(from == 0 ? "What each case gave" : "What each case gave, continued", inputs_here, from,
                std::min(from + at_once, values.size()));
  return study.cases.size() > 60 ? foldable("All " + std::to_string(study.cases.size()) + " cases", out) : out;
}

std::string unfinished_table(const StudyFiles& study) {
  Table table("Cases without results");
  table.column("Case").column("Folder").column("Status").column("What was said");
  for (const StudyCase& c : study.cases)
    if (!c.has_finished())
      table.row({escaped(c.number), "<code>" + escaped(c.folder) + "</code>", escaped(c.status), escaped(c.error)});
  return table.html();
}

}  // namespace

std::string study_page(const StudyFiles& study, const std::vector<Figure>& figures, const std::string& methods,
                       const Registry& registry, const ReportFacts& facts) {
  const std::vector<std::size_t> values = values_that_differ(study);
  const std::size_t open = study.cases.size() - study.finished();
  std::string body =
      "<header>\n" + heading("Report of a parameter study", study.name, facts.authors,
                             study.examples.empty() ? "" : "Breccia " + program_version(study.examples[0]));
  body += "<p class=\"lead\">" + std::to_string(study.cases.size()) + " cases, " + std::to_string(study.finished()) +
          " finished.</p>\n";
  if (open > 0)
    body += "<div class=\"note\"><p>" + std::to_string(open) + (open == 1 ? " case has" : " cases have") +
            " no results; see <a href=\"#open\">which</a>.</p></div>\n";
  body += "</header>\n<main>\n" + section("varied", "Parameters", varied_table(study));
  body += section("charts", "Charts", charts_html(figures) + pictures_html(figures));
  body += section("scatter", "Means and scatter", seeds_tables(study, values) + scatter_table(study));
  body += section("open", "Cases without results", unfinished_table(study));
  body += section("cases", "Cases", cases_tables(study, values));
  body += section("methods", "Methods, for a paper", methods);
  std::string input;
  for (const RunFiles& run : study.examples)
    if (!run.input_text.empty())
      input += foldable("Resolved input of the case " + run.folder.filename().string(),
                        "<pre><code>" + escaped(run.input_text) + "</code></pre>\n");
  if (!study.examples.empty()) {
    body += section("computation", "Computation of the case " + study.examples[0].folder.filename().string(),
                    computation_part(study.examples[0]));
    body += section("cite", "How to cite", citation_part(study.examples[0], registry));
  }
  body += section("more", "Input", input);
  return page(study.name + ": report of a study", body + "</main>\n" + footer(facts));
}

}  // namespace breccia::report
