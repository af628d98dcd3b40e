// SPDX-License-Identifier: BSD-3-Clause
#include "run/resume.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "breccia/sdk_abi.hpp"
#include "results/results_folder.hpp"
#include "run/provenance.hpp"
#include "run/run_ranks.hpp"

namespace breccia {
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return in ? text.str() : std::string();
}

/// Those of a run that came to no end in the folder, then those of its results; each list newest first.
std::vector<fs::path> checkpoints_of(const fs::path& folder, Host& host) {
  complete_results(folder, host);
  std::vector<fs::path> files;
  for (const fs::path& results : {unfinished_results(folder), folder})
    if (!results.empty())
      for (const fs::path& file : checkpoints_in(results / "checkpoints")) files.push_back(file);
  return files;
}

/// What the first rank has found; one after the other with a byte between them that no name has.
std::vector<fs::path> told(const std::vector<fs::path>& files, const RunRanks& ranks) {
  std::string text;
  for (const fs::path& file : files) text += file.string() + '\0';
  std::istringstream all(ranks.told(text));
  std::vector<fs::path> found;
  for (std::string file; std::getline(all, file, '\0');) found.emplace_back(file);
  return found;
}

}  // namespace

ResumePoint find_resume_point(const fs::path& folder, Host& host, RankLink* link) {
  const RunRanks ranks(link);
  std::vector<fs::path> files;
  if (ranks.first()) files = checkpoints_of(folder, host);
  std::string passed_over;
  for (const fs::path& file : told(files, ranks)) {
    ResumePoint point{file.parent_path().parent_path() / "resolved.yaml", nullptr, {}};
    try {
      point.checkpoint = read_checkpoint(file, link);
      (*point.checkpoint)("about", point.about);
    } catch (const UserError& e) {
      host.warn(e.what());
      passed_over = e.what();
      continue;
    }
    refuse_other_sdk(point.about, file);
    if (text_of(point.resolved) != point.about.resolved)
      throw UserError(
          fmt::format("{} is not the workflow that the checkpoint {} was written by: it was changed, or is "
                      "of another run",
                      point.resolved.string(), file.filename().string()));
    ranks.as_first_says(true);  // all have looked before the first touches the folder
    return point;
  }
  throw UserError(
      fmt::format("there is no {}checkpoint in {}: a run writes them to the folder of its results, see "
                  "`checkpoints` of a workflow",
                  passed_over.empty() ? "" : "usable ", folder.string()));
}

void refuse_other_sdk(const CheckpointAbout& about, const fs::path& file) {
  if (about.sdk_abi != BRECCIA_SDK_ABI)
    throw UserError(fmt::format(
        "the checkpoint {} was written with the SDK {} (breccia {}), this program has {}: only a program of the "
        "same build goes on from it",
        file.string(), about.sdk_abi, about.program, BRECCIA_SDK_ABI));
}

void refuse_changes(const CheckpointAbout& about, const Json& provenance, bool accepted, Host& host) {
  std::string all;
  for (const std::string& change : changes_since(Json::parse(about.provenance), provenance)) {
    if (accepted) host.warn(change);
    else all += (all.empty() ? "" : "\n") + change;
  }
  if (!all.empty())
    throw UserError(all +
                    "\nso the run would not go on as it began: nothing was changed. If the change does not matter, "
                    "--accept-changed-plugins goes on");
}

}  // namespace breccia
