// SPDX-License-Identifier: BSD-3-Clause
#include "study/study_results.hpp"

#include <algorithm>

#include "breccia/atomic_file.hpp"
#include "breccia/text_file.hpp"
#include "config/at_path.hpp"
#include "config/suggest.hpp"
#include "plugin/drawing.hpp"
#include "plugin/guarded.hpp"
#include "results/summary_keys.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string cell(const Json& v) { return v.is_null() ? "" : v.is_string() ? v.get<std::string>() : json_text(v); }

void add_new(std::vector<std::string>& all, const std::string& name) {
  if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
}

}  // namespace

std::string state_text(CaseState state) {
  switch (state) {
    case CaseState::absent:
      return "not run";
    case CaseState::unfinished:
      return "unfinished";
    case CaseState::failed:
      return "failed";
    case CaseState::finished:
      return "finished";
    case CaseState::other_inputs:
      return "other inputs";
  }
  return {};
}

std::vector<CaseResult> read_results(const SweepPlan& plan, const fs::path& results, Host& host) {
  std::vector<CaseResult> all;
  for (const PlannedCase& c : plan.cases) {
    const fs::path folder = case_folder(results, c.the);
    CaseResult result;
    result.record = read_case(folder, c.hash, host);
    result.summary = Json::object();
    if (result.record.state == CaseState::finished) {
      try {
        result.summary = Json::parse(read_bytes(folder / "summary.json"), nullptr, false);
      } catch (const UserError&) { result.summary = Json(); }
      if (!result.summary.is_object()) {
        result.record.state = CaseState::failed;
        result.record.error = "summary.json is damaged";
        result.summary = Json::object();
      }
    }
    all.push_back(std::move(result));
  }
  return all;
}

SweepTable::SweepTable(const Sweep& sweep, const SweepPlan& plan, std::vector<CaseResult> results)
    : sweep_(sweep), plan_(plan), results_(std::move(results)), values_(sweep.study().study.collect) {
  if (!values_.empty()) return;
  std::vector<std::string> inputs = input_headers(sweep, plan);
  for (const StudyRatio& d : sweep.study().study.derived) inputs.push_back(d.name);
  for (const CaseResult& r : results_)
    for (const auto& [key, value] : r.summary.items())
      if ((value.is_number() || value.is_null()) && !is_bookkeeping(key) &&
          std::find(inputs.begin(), inputs.end(), key) == inputs.end())
        add_new(values_, key);
}

Json SweepTable::value(std::size_t k, const std::string& key) const {
  const Json* at = value_at(results_[k].summary, key);
  if (!at) return {};
  if (at->is_boolean()) return at->get<bool>() ? 1 : 0;
  return at->is_structured() ? Json() : *at;
}

Json SweepTable::number(const StudyTerm& term, std::size_t point) const {
  Json v;
  switch (term.is) {
    case StudyTerm::Is::parameter:
      v = plan_.cases[index(point, 0)].inputs[term.index];
      break;
    case StudyTerm::Is::derived:
      v = derived(sweep_.study().study.derived[term.index], point);
      break;
    case StudyTerm::Is::value:
      v = value(index(point, term.index), term.key);
      break;
  }
  return v.is_number() ? v : Json();
}

Json SweepTable::derived(const StudyRatio& ratio, std::size_t point) const {
  const Json above = number(sweep_.study().term(ratio.numerator), point),
             below = number(sweep_.study().term(ratio.denominator), point);
  if (above.is_null() || below.is_null() || below.get<double>() == 0) return {};
  return above.get<double>() / below.get<double>();
}

std::string SweepTable::csv() const {
  const Study& study = sweep_.study().study;
  std::vector<std::string> header = input_headers(sweep_, plan_);
  header.push_back("status");
  header.insert(header.end(), values_.begin(), values_.end());
  for (const StudyRatio& d : study.derived) header.push_back(d.name);
  header.push_back("error");
  std::string text = csv_line(header);
  for (std::size_t k = 0; k < plan_.cases.size(); ++k) {
    std::vector<std::string> row = input_cells(sweep_, plan_.cases[k]);
    row.push_back(state_text(results_[k].record.state));
    for (const std::string& key : values_) row.push_back(cell(value(k, key)));
    for (const StudyRatio& d : study.derived) row.push_back(cell(derived(d, plan_.cases[k].the.point)));
    row.push_back(first_line(results_[k].record.error));
    text += csv_line(row);
  }
  return text;
}

Json SweepTable::columns() const {
  Json all = Json::array();
  const auto add = [&](const std::string& header, const std::string& unit, const char* holds) {
    const std::string written = ResultName("", unit).key();  // what the header ends in
    std::string name = header;
    if (!written.empty() && name.ends_with(written)) name.resize(name.size() - written.size());
    all.push_back({{"header", header}, {"name", name}, {"unit", unit}, {"holds", holds}});
  };
  const auto or_pure = [](const std::string& unit) { return unit.empty() ? "1" : unit; };
  const std::vector<std::string> inputs = input_headers(sweep_, plan_), known = all_keys();
  const std::size_t first = inputs.size() - plan_.input_units.size();  // before them: case, folder, workflow
  for (std::size_t k = first; k < inputs.size(); ++k) add(inputs[k], or_pure(plan_.input_units[k - first]), "input");
  for (const std::string& key : values_) {  // of one that no case has nothing can be said
    const std::string unit = said_of(key).unit;
    add(key, std::find(known.begin(), known.end(), key) == known.end() ? unit : or_pure(unit), "value");
  }
  const std::vector<StudyRatio>& ratios = sweep_.study().study.derived;
  for (std::size_t d = 0; d < ratios.size(); ++d) add(ratios[d].name, or_pure(quotient_unit(d)), "derived");
  return all;
}

std::vector<std::string> SweepTable::all_keys() const {
  std::vector<std::string> keys;
  for (const CaseResult& r : results_)
    for (const auto& [key, value] : numbers_below(r.summary)) add_new(keys, key);
  return keys;
}

std::vector<std::string> SweepTable::warnings() const {
  const Study& study = sweep_.study().study;
  std::vector<std::pair<std::string, std::string>> asked;  // where, and the dotted path
  for (const std::string& key : study.collect) asked.emplace_back("collect", key);
  const auto ask = [&](const std::string& where, const std::string& name) {
    if (const StudyTerm term = sweep_.study().term(name); term.is == StudyTerm::Is::value)
      asked.emplace_back(where, term.key);
  };
  for (const StudyRatio& d : study.derived)
    for (const std::string& name : {d.numerator, d.denominator}) ask("derived `" + d.name + "`", name);
  for (const StudyChartConfig& c : study.charts)
    for (const std::string& name : {c.x, c.y}) ask("chart `" + c.file_name() + "`", name);
  const std::vector<std::string> known = all_keys();
  std::vector<std::string> texts;
  for (const auto& [where, key] : asked) {
    bool found = known.empty();  // nothing has finished: nothing can be said
    for (std::size_t k = 0; k < results_.size() && !found; ++k) found = !value(k, key).is_null();
    if (found) continue;
    if (std::find(known.begin(), known.end(), key) != known.end())
      add_new(texts, where + ": `" + key + "` could not be measured in any case");
    else add_new(texts, where + ": no summary has `" + key + "`" + suggestion(key, known));
  }
  return texts;
}

TitleAndUnit SweepTable::said_of(const std::string& key) const {
  TitleAndUnit said = title_of(key, Json::object());
  for (const CaseResult& r : results_)
    if (TitleAndUnit more = title_of(key, r.summary); !more.unit.empty()) return more;
  return said;
}

std::string SweepTable::quotient_unit(std::size_t derived) const {
  const StudyRatio& ratio = sweep_.study().study.derived[derived];
  const auto unit_of = [&](const std::string& name) -> std::string {
    const StudyTerm term = sweep_.study().term(name);
    std::string unit = term.is == StudyTerm::Is::parameter ? plan_.input_units[term.index] : said_of(term.key).unit;
    return unit == "1" ? "" : unit;
  };
  const std::string over = unit_of(ratio.numerator), under = unit_of(ratio.denominator);
  if (over == under) return "";
  if (under.empty()) return over;
  const bool simple = under.find_first_of(" /") == under.npos;
  return (over.empty() ? "1" : over) + "/" + (simple ? under : "(" + under + ")");
}

StudyChart::Axis SweepTable::axis(const StudyTerm& term, const std::optional<std::string>& label,
                                  const std::string& name) const {
  StudyChart::Axis axis;
  if (term.is == StudyTerm::Is::parameter) {
    axis = {readable(split_path(name).back().name), plan_.input_units[term.index]};
  } else {
    const auto [title, unit] =
        term.is == StudyTerm::Is::derived ? TitleAndUnit{readable(name), quotient_unit(term.index)} : said_of(term.key);
    const std::string& workflow = sweep_.study().workflow_names[term.is == StudyTerm::Is::value ? term.index : 0];
    axis = {(term.is == StudyTerm::Is::value && !workflow.empty() ? workflow + ": " : "") + title,
            unit.empty() ? "1" : unit};
  }
  if (label) axis.title = *label;
  return axis;
}

StudyChart SweepTable::chart(const StudyChartConfig& config) const {
  const LoadedStudy& study = sweep_.study();
  const StudyTerm x = study.term(config.x), y = study.term(config.y);
  const bool steady = x.is == StudyTerm::Is::parameter && !study.parameters[x.index].sampled;
  StudyChart chart{axis(x, config.x_label, config.x), axis(y, config.y_label, config.y), {}, config.file_name()};
  std::vector<std::vector<std::pair<double, double>>> points;
  std::size_t drawn = 0;
  for (std::size_t p = 0; p < study.points.size(); ++p) {
    std::string label;
    if (config.series) {
      const StudyTerm by = study.term(*config.series);
      label = axis(by, {}, *config.series).title + " = " + value_text(*study.points[p][by.index].value);
    }
    auto it = std::find_if(chart.series.begin(), chart.series.end(),
                           [&](const StudyChart::Series& s) { return s.label == label; });
    if (it == chart.series.end()) {
      it = chart.series.insert(chart.series.end(), {label, {}, {}, steady});
      points.emplace_back();
    }
    const Json at = number(x, p), up = number(y, p);
    if (at.is_null() || up.is_null()) continue;
    points[std::size_t(it - chart.series.begin())].emplace_back(at.get<double>(), up.get<double>());
    ++drawn;
  }
  if (drawn == 0) throw UserError("no case has both `" + config.x + "` and `" + config.y + "`");
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    std::stable_sort(points[s].begin(), points[s].end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t k = 0; k < points[s].size(); ++k) {
      // Several points at one x differ in what the chart does not show: a line through them would mean nothing.
      if (k > 0 && points[s][k].first == points[s][k - 1].first) chart.series[s].joined = false;
      chart.series[s].x.push_back(points[s][k].first);
      chart.series[s].y.push_back(points[s][k].second);
    }
  }
  std::erase_if(chart.series, [](const StudyChart::Series& s) { return s.x.empty(); });
  return chart;
}

namespace {

/// What could not be drawn after some had been leaves those in `made`.
void draw(const SweepTable& table, const Study& study, const PluginChoice& choice, const fs::path& folder, Host& host,
          std::vector<fs::path>& made) {
  drawn("charts", choice.type, Refusal::ends, host, [&] {
    const auto renderer = Registry().create<Renderer>(choice);
    for (const StudyChartConfig& config : study.charts) {
      if (host.cancelled()) throw Cancelled();
      try {
        StudyChart chart = table.chart(config);
        chart.file = folder / chart.file;
        const auto files =
            calling({Renderer::kind, choice.type}, "drawing", [&] { return renderer->chart(chart, host); });
        made.insert(made.end(), files.begin(), files.end());
      } catch (const CannotWrite&) { throw; } catch (const UserError& e) {
        host.warn("chart `" + config.file_name() + "` was not drawn: " + e.what());
      }
    }
    return std::vector<fs::path>();  // all are in `made`
  });
}

}  // namespace

std::vector<fs::path> write_results(const Sweep& sweep, const SweepPlan& plan, const SweepTable& table,
                                    const std::optional<PluginChoice>& renderer, const fs::path& folder, Host& host) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw UserError("cannot make the folder " + folder.string() + ": " + error.message());
  write_file(folder / "cases.csv", cases_csv(sweep, plan));
  write_file(folder / "results.csv", table.csv());
  write_file(folder / "results.json", json_text(table.columns(), 1) + "\n");
  std::vector<fs::path> made{folder / "cases.csv", folder / "results.csv", folder / "results.json"};
  for (const std::string& text : table.warnings()) host.warn(text);
  if (renderer) draw(table, sweep.study().study, *renderer, folder, host, made);
  return made;
}

}  // namespace breccia
