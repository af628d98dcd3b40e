// SPDX-License-Identifier: BSD-3-Clause
#include "run/resume.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "breccia/sdk_abi.hpp"
#include "results/results_folder.hpp"
#include "run/provenance.hpp"

namespace breccia {
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return in ? text.str() : std::string();
}

}  // namespace

ResumePoint find_resume_point(const fs::path& folder, Host& host) {
  complete_results(folder, host);
  const fs::path unfinished = unfinished_results(folder);
  std::string passed_over;
  for (const fs::path& results : {unfinished, folder}) {
    if (results.empty()) continue;
    for (const fs::path& file : checkpoints_in(results / "checkpoints")) {
      ResumePoint point{results / "resolved.yaml", nullptr, {}};
      try {
        point.checkpoint = read_checkpoint(file);
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
      return point;
    }
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
