// SPDX-License-Identifier: BSD-3-Clause
/// One of many runs, in a folder of its own: gone on with where it stopped, begun by one process at a time, with
/// case.json telling how it stands.
#pragma once

#include "run/terminal.hpp"
#include "study/case_folder.hpp"
#include "study/run_time.hpp"

namespace breccia {

enum class StudyEnd { finished, some_not, stopped };

struct FolderRun {
  const LoadedWorkflow& loaded;
  const Registry& registry;  ///< of its plugins
  std::filesystem::path folder;
  std::string hash;        ///< of its inputs
  Json about;              ///< what case.json says of it besides how it stands
  std::string named;       ///< "case 3 of study `friction`"
  bool wait = false;       ///< for another process that is about to leave the folder
  bool overwrite = false;  ///< finished results of other inputs
  RunTime at_most = {};    ///< from the moment at which this process has the folder, packing included
};

/// Runs it, or goes on where it stopped; nothing when it has finished before.
StudyEnd run_in_folder(const FolderRun& run, Terminal& terminal);

/// What is said of results whose inputs have changed since; `which` "finished results in X are".
UserError other_inputs(const std::string& which);

}  // namespace breccia
