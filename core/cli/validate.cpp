// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <set>

#include "breccia/utf8.hpp"
#include "calibrate/course.hpp"
#include "cli/verbs.hpp"
#include "config/base_chain.hpp"
#include "run/load_workflow.hpp"
#include "study/cases.hpp"

namespace breccia::cli {

int validate(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& overrides,
             const std::string& variant) {
  int code = ok;
  for (const auto& file : files) {
    try {
      if (is_calibration(follow_bases(read_text(file), file.string()))) {
        if (!variant.empty())
          throw UserError(file.string() +
                          ": is a calibration, which says itself which variants it runs: leave out --variant");
        const CalibrationTrials trials(file);
        for (const std::string& doubt : trials.warnings()) fmt::print(stderr, "warning: {}\n", printable(doubt));
        fmt::print(
            "{}: ok, a calibration of at most {} runs{}\n", printable(file.string()),
            plan_course(trials.calibration()).runs,
            !trials.calibration().search.empty() ? "" : "; to run it needs a search, which is not installed here");
        continue;
      }
      if (is_study(follow_bases(read_text(file), file.string()))) {
        if (!variant.empty())
          throw UserError(file.string() +
                          ": is a study, whose cases say themselves which variant they are: leave out "
                          "--variant");
        const SweepPlan planned = plan(Sweep(file));
        for (const std::string& doubt : planned.warnings) fmt::print(stderr, "warning: {}\n", printable(doubt));
        fmt::print("{}: ok, a study of {} cases\n", printable(file.string()), planned.cases.size());
        continue;
      }
      std::vector<std::string> variants{variant};
      if (variant.empty()) {
        const std::vector<std::string> all = workflow_variants(file);
        variants.insert(variants.end(), all.begin(), all.end());
      }
      std::set<std::string> said;  // once, though each variant holds it
      for (const std::string& each : variants) {
        Registry registry;  // one each: plugins named by one workflow must not help another
        for (const std::string& doubt : load_workflow(file, overrides, registry, each).warnings)
          if (said.insert(doubt).second) fmt::print(stderr, "warning: {}\n", printable(doubt));
      }
      fmt::print("{}: ok\n", printable(file.string()));
    } catch (const UserError& e) {
      fmt::print(stderr, "{}\n", printable(e.what()));
      code = bad_input;
    }
  }
  return code;
}

}  // namespace breccia::cli
