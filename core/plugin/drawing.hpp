// SPDX-License-Identifier: BSD-3-Clause
/// Renderers beside other work: pictures and charts that nobody misses so much that the rest should fail.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "breccia/services.hpp"
#include "plugin/registry.hpp"

namespace breccia {

/// A renderer as the command line asks for it: with its defaults, and each "path=value" of `overrides` in its section.
/// ConfigError when these do not fit.
PluginChoice renderer_settings(const std::string& type, const std::vector<std::string>& overrides,
                               const PluginDirectory& plugins);

/// `pictures` where nobody named another renderer; none, and a warning, when it is not installed.
std::optional<PluginChoice> usual_renderer(const std::vector<std::string>& overrides, const PluginDirectory& plugins,
                                           Host& host);

/// Whether what a renderer refuses (UserError) is told as a warning, or ends the work.
enum class Refusal { warns, ends };

/// The files that `draw` makes by the renderer of that label. Where this machine cannot draw: none, and a warning that
/// there are no `what` ("charts").
std::vector<std::filesystem::path> drawn(const std::string& what, const std::string& renderer, Refusal refusal,
                                         Host& host, const std::function<std::vector<std::filesystem::path>()>& draw);

}  // namespace breccia
