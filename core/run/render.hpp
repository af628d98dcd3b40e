// SPDX-License-Identifier: BSD-3-Clause
/// Pictures from the files of a run.
#pragma once

#include "breccia/renderer.hpp"
#include "run/workflow.hpp"

namespace breccia {

/// Runs the renderers; one that cannot draw on this machine is a warning. The files that were made.
std::vector<std::filesystem::path> render_all(const std::vector<PluginChoice>& renderers, const Registry& registry,
                                              const RenderRequest& request, Host& host);

}  // namespace breccia
