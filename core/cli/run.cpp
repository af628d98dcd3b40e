// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "cli/console.hpp"
#include "cli/results_table.hpp"
#include "cli/verbs.hpp"
#include "run/run_to_results.hpp"

namespace breccia::cli {

int run(const RunArguments& a) {
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  Console console(a.threads > 0 ? a.threads : cores);
  Registry registry;
  for (const std::string& w : registry.warnings()) console.warn(w);
  const RunInFolder end = run_to_results(a, registry, console);
  const RunOutcome& outcome = end.outcome;
  console.clear_bar();
  print_results(outcome.summary);
  console.info(fmt::format("{} in {:.1f} s; results in {}",
                           !outcome.failure.empty() ? "ended before its time"
                           : outcome.interrupted    ? "stopped on request"
                                                    : "finished",
                           outcome.summary["wall_time_s"].get<double>(), end.place));
  if (!outcome.failure.empty()) {
    console.info("why: " + outcome.failure);
    if (!end.kept.empty()) console.info(end.kept);
    return bad_input;
  }
  return outcome.interrupted ? interrupted : ok;
}

}  // namespace breccia::cli
