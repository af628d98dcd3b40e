// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "cli/console.hpp"
#include "cli/verbs.hpp"
#include "study/jobs.hpp"
#include "study/study_run.hpp"

namespace breccia::cli {
namespace {

int code_of(StudyEnd end) { return end == StudyEnd::finished ? ok : end == StudyEnd::stopped ? interrupted : failure; }

}  // namespace

int sweep(const SweepArguments& a) {
  if (a.parent > 0) end_with(a.parent);
  const Sweep sweep(a.study);
  if (!a.one.empty()) {
    const CaseToRun one = case_to_run(a, sweep);
    Console console(a.threads);
    return code_of(run_case(a, sweep, one, console));
  }
  const SweepPlan planned = plan(sweep);
  if (a.cases) {
    fmt::print("{}", cases_csv(sweep, planned));
    return ok;
  }
  Console console(1);
  return code_of(run_study(a, sweep, planned, console));
}

}  // namespace breccia::cli
