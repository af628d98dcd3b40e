// SPDX-License-Identifier: BSD-3-Clause
/// What the cases of a study gave: results.csv and charts.
#pragma once

#include "breccia/renderer.hpp"
#include "results/summary_keys.hpp"
#include "study/case_folder.hpp"

namespace breccia {

/// One case and, if it is finished, its summary.
struct CaseResult {
  CaseRecord record;
  Json summary;
};

/// The cases as their folders have them now, in the order of the plan.
std::vector<CaseResult> read_results(const SweepPlan& plan, const std::filesystem::path& results, Host& host);

/// The table of a study. Numbers are JSON as the summaries have them; null where there is none.
class SweepTable {
 public:
  SweepTable(const Sweep& sweep, const SweepPlan& plan, std::vector<CaseResult> results);

  /// One row per case: its inputs, `status`, its values, derived values (the same for all cases of a point), and the
  /// first line of its error.
  std::string csv() const;
  /// What its columns are, for results.json: header, name, SI unit (empty of values that no
  /// case has), and what it holds.
  Json columns() const;
  /// Values that were asked for and that no finished case has.
  std::vector<std::string> warnings() const;
  /// A chart of the points that have both values. UserError when there is none.
  StudyChart chart(const StudyChartConfig& config) const;

 private:
  Json number(const StudyTerm& term, std::size_t point) const;
  Json value(std::size_t case_index, const std::string& key) const;
  Json derived(const StudyRatio& ratio, std::size_t point) const;
  TitleAndUnit said_of(const std::string& key) const;    ///< of a value, by the first case that knows it
  std::string quotient_unit(std::size_t derived) const;  ///< of a derived column
  StudyChart::Axis axis(const StudyTerm& term, const std::optional<std::string>& label, const std::string& name) const;
  std::vector<std::string> all_keys() const;
  std::size_t index(std::size_t point, std::size_t workflow) const {
    return point * sweep_.study().workflow_names.size() + workflow;
  }

  const Sweep& sweep_;
  const SweepPlan& plan_;
  std::vector<CaseResult> results_;
  std::vector<std::string> values_;  ///< columns
};

/// "finished", "failed", "not run" and so on, as results.csv has it.
std::string state_text(CaseState state);

/// Writes cases.csv, results.csv and the charts into the folder of the study; what cannot be drawn is a
/// warning; without a renderer there are no charts. The files.
std::vector<std::filesystem::path> write_results(const Sweep& sweep, const SweepPlan& plan, const SweepTable& table,
                                                 const std::optional<PluginChoice>& renderer,
                                                 const std::filesystem::path& folder, Host& host);

}  // namespace breccia
