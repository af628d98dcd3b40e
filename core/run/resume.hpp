// SPDX-License-Identifier: BSD-3-Clause
/// From which checkpoint a run goes on.
#pragma once

#include <memory>

#include "archive/checkpoint_file.hpp"
#include "workflow/read_workflow.hpp"

namespace breccia {

/// What a checkpoint says of itself besides the run's state.
struct CheckpointAbout {
  std::string program, resolved, provenance;  ///< version; text of resolved.yaml; JSON
  std::uint32_t sdk_abi = 0;
  void archive(Archive& archive) {
    archive("program", program);
    archive("sdk_abi", sdk_abi);
    archive("resolved_yaml", resolved);
    archive("provenance", provenance);
  }
};

struct ResumePoint {
  std::filesystem::path resolved;  ///< the workflow
  std::unique_ptr<CheckpointReader> checkpoint;
  CheckpointAbout about;
};

/// The newest whole checkpoint of a results folder: of a run that came to no end there, else of the results. One that
/// is damaged is passed over with a warning. UserError when there is none, when its workflow is another one than
/// resolved.yaml beside it states, or when it was made with another SDK. `link`: of ranks that go on together, which
/// all look at the files that the first has found; else null.
ResumePoint find_resume_point(const std::filesystem::path& folder, Host& host, RankLink* link = nullptr);

/// UserError when it was written by a program of another SDK.
void refuse_other_sdk(const CheckpointAbout& about, const std::filesystem::path& file);

/// UserError when something that made the checkpoint has changed since, `accepted` changes of plugins but said.
void refuse_changes(const CheckpointAbout& about, const Json& provenance, bool accepted, Host& host);

}  // namespace breccia
