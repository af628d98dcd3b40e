// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_archive.hpp"

namespace breccia {
namespace {

void archive_test(Archive& archive, const RunParts& run, std::vector<std::string>& unknown) {
  archive("engine", run.simulation);
  archive("loading", run.loading);
  {
    const Archive::Group group(archive, "protocol");
    calling(run.protocol_id, archive.reading() ? "reading a checkpoint" : "writing a checkpoint", [&] {
      if (!run.protocol.archive(archive)) unknown.push_back("protocol `" + std::string(run.protocol_id.type) + "`");
    });
  }
  archive("loading_checks", run.loading_checks);
}

void archive_measured(Archive& archive, const RunParts& run, std::vector<std::string>& unknown) {
  {
    const Archive::Group posts(archive, "postprocessors");
    for (auto& p : run.posts) {
      if (!p.works()) continue;
      const Archive::Group group(archive, p.label());
      p.archive(archive, unknown);
    }
  }
  if (!run.first) return;
  archive("curves", run.curves);
  archive("energy_check", run.energy_check);
}

void refuse_unknown(const std::vector<std::string>& unknown) {
  if (!unknown.empty())
    throw UserError("the checkpoint cannot be used: " + unknown.front() + " does not say what changes in it");
}

}  // namespace

std::vector<std::string> archive_run(Archive& archive, const RunParts& run) {
  std::vector<std::string> unknown;
  if (!archive.reading()) archive("about", run.about);
  if (!archive.reading()) archive("warnings", run.log);
  archive_test(archive, run, unknown);
  archive_measured(archive, run, unknown);
  run.frames.archive(archive, unknown);
  return unknown;
}

void read_run(Archive& from, const RunParts& run) { refuse_unknown(archive_run(from, run)); }

void read_branch(Archive& from, const RunParts& run, bool measured) {
  std::vector<std::string> unknown;
  archive_test(from, run, unknown);
  if (measured) {
    archive_measured(from, run, unknown);
    from("warnings", run.log);
  }
  refuse_unknown(unknown);
}

}  // namespace breccia
