// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "cli/console.hpp"
#include "cli/on_ranks.hpp"
#include "cli/results_table.hpp"
#include "cli/verbs.hpp"
#include "run/on_ranks.hpp"
#include "run/run_to_results.hpp"

namespace breccia::cli {

namespace {

int run_here(const RunArguments& asked, RankLink* link) {
  RunArguments a = asked;
  a.link = link;
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  Console console(a.threads > 0 ? a.threads : link ? threads_of_rank(*link, cores) : cores);
  Registry registry;
  if (link && !link->first()) {
    const RunOutcome outcome = run_beside(a, registry, console);
    return outcome.interrupted ? interrupted : outcome.failure.empty() ? ok : bad_input;
  }
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

}  // namespace

int run(const RunArguments& a) {
  return on_ranks([&](RankLink* link) { return run_here(a, link); });
}

}  // namespace breccia::cli
