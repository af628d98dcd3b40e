// SPDX-License-Identifier: BSD-3-Clause
/// Pictures from the files of a run.
#pragma once

#include "breccia/renderer.hpp"
#include "workflow/read_workflow.hpp"

namespace breccia {

/// At the end of a run: whatever keeps a renderer from drawing is a warning, the results are there. The files that were
/// made.
std::vector<std::filesystem::path> render_all(const std::vector<PluginChoice>& renderers, const Registry& registry,
                                              const RenderRequest& request, Host& host);

/// Pictures that are all that is asked for. They are drawn into a folder of their own within `request.directory`, which
/// is made if need be, and take their places when all are made. UserError when that would replace a file and
/// `overwrite` does not allow it, or when the disk refuses: then all is as before. None when this machine cannot draw.
std::vector<std::filesystem::path> render_apart(const std::vector<PluginChoice>& renderers, const Registry& registry,
                                                const RenderRequest& request, bool overwrite, Host& host);

}  // namespace breccia
