// SPDX-License-Identifier: BSD-3-Clause
/// Finished runs beside each other: comparison.csv, comparison.md and a renderer's charts.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "breccia/renderer.hpp"
#include "plugin/registry.hpp"

namespace breccia {

struct ComparedRun {
  std::filesystem::path folder;  ///< as the user wrote it
  std::string label;             ///< each once
  Json summary;
  bool interrupted = false;
};

/// Reads the summaries; the folder of a study stands for its cases that have finished. A label is `LABEL=DIR` and names
/// its run itself: order does not count. Without one the folder's name is taken; a name met twice is given with that of
/// its parent, a label still met twice with a number. UserError for what is not the folder of a finished run.
std::vector<ComparedRun> read_runs(const std::vector<std::filesystem::path>& folders,
                                   const std::vector<std::string>& labels);

/// One row per run: its label, then every number of its summary in SI, truth values as 1 and 0, those of a section as
/// `section.key`. The columns are all keys that any run has; a cell is empty where a run lacks it.
std::string comparison_csv(const std::vector<ComparedRun>& runs);

/// The quantities at the top level of the summaries for a human reader, beside each run's reference values with the
/// distance in per cent; `charts` are shown below.
std::string comparison_markdown(const std::vector<ComparedRun>& runs, const std::vector<std::filesystem::path>& charts);

/// The Mohr-Coulomb line through the strengths of runs at different confining pressures, with the runs that have one:
/// see breccia/strength.hpp. None when there are not two such pressures.
std::optional<Json> strength_envelope(const std::vector<ComparedRun>& runs);
std::string strength_markdown(const Json& envelope);

struct ComparisonOptions {
  std::filesystem::path folder;          ///< of the files made
  bool overwrite = false;                ///< it may hold files already: those of the same names are replaced
  std::optional<PluginChoice> renderer;  ///< of the charts; none: tables only
};

/// Makes the tables and charts, the tables last. The files made; a renderer that cannot draw here is a warning.
/// UserError, before anything is written, when the folder or a run cannot be used.
std::vector<std::filesystem::path> compare_runs(const std::vector<ComparedRun>& runs, const ComparisonOptions& options,
                                                const Registry& registry, Host& host);

}  // namespace breccia
