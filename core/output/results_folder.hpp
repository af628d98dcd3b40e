// SPDX-License-Identifier: BSD-3-Clause
/// The folder of one run.
#pragma once

#include <filesystem>

namespace breccia {

/// Makes the folder. What an earlier run left there is never touched unless `overwrite`: then files that a run makes are
/// removed first (the folder must look like a result folder: it holds resolved.yaml or run.log). UserError otherwise.
void make_results_folder(const std::filesystem::path& folder, bool overwrite);

}  // namespace breccia
