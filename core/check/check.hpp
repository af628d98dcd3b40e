// SPDX-License-Identifier: BSD-3-Clause
/// Whether a plugin is what its kind promises: tried on small cases, against itself.
#pragma once

#include <string>
#include <vector>

#include "check/findings.hpp"
#include "plugin/registry.hpp"

namespace breccia {

/// What is tried, and of which the plugin holds; deterministic, but for times. `parameters` ("friction=0.3") go before
/// the examples of its declarations. ConfigError when no configuration can be made; PluginFault where a law throws;
/// Cancelled when `user` wants it to end.
CheckFindings check_plugin(const Registry& registry, const std::string& kind, const std::string& name,
                           const std::vector<std::string>& parameters, const Host& user);

// Of each kind; `check_plugin` chooses.
CheckFindings check_packing(const Registry& registry, const std::string& name,
                            const std::vector<std::string>& parameters, const Host& user);
CheckFindings check_protocol(const Registry& registry, const std::string& name,
                             const std::vector<std::string>& parameters, const Host& user);
CheckFindings check_postprocessor(const Registry& registry, const std::string& name,
                                  const std::vector<std::string>& parameters, const Host& user);
CheckFindings check_output(const Registry& registry, const std::string& name,
                           const std::vector<std::string>& parameters, const Host& user);
CheckFindings check_renderer(const Registry& registry, const std::string& name,
                             const std::vector<std::string>& parameters, const Host& user);
CheckFindings check_search(const Registry& registry, const std::string& name,
                           const std::vector<std::string>& parameters, const Host& user);

}  // namespace breccia
