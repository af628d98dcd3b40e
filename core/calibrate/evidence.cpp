// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/evidence.hpp"

#include <algorithm>
#include <cmath>

#include "breccia/text_file.hpp"
#include "config/at_path.hpp"
#include "config/reader.hpp"
#include "config/suggest.hpp"
#include "config/units.hpp"
#include "results/summary_keys.hpp"

namespace breccia {

namespace fs = std::filesystem;

TrialRecord Evidence::look(const Trial& t, Host& host) const {
  TrialRecord r;
  r.trial = t;
  r.result.value.assign(trials_.calibration().targets.size(), NAN);
  try {
    const ResolvedTrial resolved = trials_.resolve(t);
    r.hash = resolved.hash;
    r.folder = resolved.folder;
  } catch (const UserError& e) {  // of these values together: each by itself was tried
    r.state = CaseState::failed;
    r.result.error = e.what();
    return r;
  }
  const CaseRecord record = read_case(folder(r), r.hash, host);
  r.state = record.state;
  r.result.error = record.error;
  r.result.out_of_time = record.out_of_time;
  if (record.state != CaseState::finished) return r;
  Json summary;
  try {
    summary = Json::parse(read_bytes(folder(r) / "summary.json"), nullptr, false);
  } catch (const UserError&) {}
  if (!summary.is_object()) {
    r.state = CaseState::failed;
    r.result.error = "summary.json is damaged";
    return r;
  }
  r.result.finished = true;
  r.result.value = values_in(summary, t.workflow);
  return r;
}

std::vector<double> Evidence::values_in(const Json& summary, std::size_t workflow) const {
  const LoadedCalibration& c = trials_.calibration();
  std::vector<double> values(c.targets.size(), NAN);
  std::vector<Finding> findings;
  for (std::size_t k = 0; k < c.targets.size(); ++k) {
    const auto& target = c.targets[k];
    if (target.workflow != workflow) continue;
    const auto wrong = [&](std::string text) {
      findings.push_back({target.place, "targets." + target.name + ".key", std::move(text)});
    };
    const Json* value = value_at(summary, target.key);
    if (!value || value->is_structured() || value->is_string()) {
      std::vector<std::string> known;
      for (const auto& [key, number] : numbers_below(summary)) known.push_back(key);
      wrong("no summary of the workflow `" + c.workflows[workflow].name + "` has the number `" + target.key + "`" +
            suggestion(target.key, known));
      continue;
    }
    const auto units = summary.find("units");
    const bool has_unit = units != summary.end() && units->is_object() && units->contains(target.key);
    const std::string unit = has_unit ? (*units)[target.key].get<std::string>() : "1";
    if (unit != target.measure.unit && (unit == "1" || si_unit_of("1 " + unit) != target.measure.unit)) {
      wrong("`" + target.key + "` is " + dimension_name(unit) + ", and the value that is wanted is " +
            dimension_name(target.measure.unit));
      continue;
    }
    if (value->is_number()) values[k] = value->get<double>();
  }
  if (!findings.empty()) refuse(std::move(findings), {c.file});
  return values;
}

}  // namespace breccia
