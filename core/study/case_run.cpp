// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "study/run_in_folder.hpp"
#include "study/study_run.hpp"

namespace breccia {

namespace fs = std::filesystem;

fs::path study_folder(const StudyRequest& a, const Sweep& sweep) {
  return a.output.empty() ? fs::path("results") / sweep.study().study.name : a.output;
}

namespace {

/// A case by itself goes into a new folder or one of a study. (The whole study looks after its folder itself.)
void check_is_study(const fs::path& folder) {
  std::error_code unknown;
  if (!fs::exists(folder, unknown)) return;
  if (!fs::is_directory(folder, unknown))
    throw UserError("cannot write results to " + folder.string() + ": it is a file");
  if (fs::is_empty(folder, unknown)) return;
  for (const char* mark : {"cases", "breccia.json", ".breccia.lock"})
    if (fs::exists(folder / mark, unknown)) return;
  throw UserError("the folder " + folder.string() +
                  " holds files but no cases of a study: choose another with --output");
}

}  // namespace

CaseToRun case_to_run(const StudyRequest& a, const Sweep& sweep) {
  const SweepCase& c = sweep.find(a.one);
  check_is_study(study_folder(a, sweep));
  CaseToRun ready{c, case_folder(study_folder(a, sweep), c), sweep.resolve(c)};
  if (!a.expect.empty() && a.expect != ready.resolved.hash)
    throw UserError("the study or its workflow was changed while it ran");
  return ready;
}

StudyEnd run_case(const StudyRequest& a, const Sweep& sweep, const CaseToRun& c, Terminal& terminal) {
  const std::string named = fmt::format("case {} of study `{}`", c.the.number, sweep.study().study.name);
  return run_in_folder({c.resolved.loaded, sweep.registry(c.the), c.folder, c.resolved.hash,
                        about_case(sweep, c.the, c.resolved), named, a.parent > 0, a.overwrite},
                       terminal);
}

}  // namespace breccia
