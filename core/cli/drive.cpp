// SPDX-License-Identifier: BSD-3-Clause
#include "drive/drive.hpp"

#include <fmt/format.h>

#include "breccia/text_file.hpp"
#include "cli/console.hpp"
#include "cli/results_table.hpp"
#include "cli/verbs.hpp"
#include "results/results_folder.hpp"

namespace breccia::cli {

namespace fs = std::filesystem;

int drive(const DriveArguments& a) {
  Console console(1);
  Registry registry;
  for (const std::string& w : registry.warnings()) console.warn(w);
  DriveSettings s = drive_settings(a, registry, console);
  const DrivePath path = read_drive_path(a.path);
  s.renderer = drive_charts(path, registry, console);
  const fs::path folder = a.output.empty() ? fs::path("results") / ("drive_" + s.law.names("_")) : a.output;
  ResultsFolder results(folder, a.overwrite, console);
  console.log_to(results.work() / "run.log");
  console.info(fmt::format("breccia {}: one contact of `{}` along {} into {}", BRECCIA_VERSION, s.law.names("` and `"),
                           a.path.string(), folder.string()));
  const auto files = breccia::drive(s, path, registry, results.work(), console);
  results.take_over(true);
  console.clear_bar();
  print_results(Json::parse(read_bytes(results.path() / "summary.json")));
  for (const fs::path& file : files)
    console.info("made " + (folder / file.lexically_relative(results.work())).string());
  return ok;
}

}  // namespace breccia::cli
