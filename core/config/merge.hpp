// SPDX-License-Identifier: BSD-3-Clause
/// What a workflow and its bases say together. Internal to the configuration.
#pragma once

#include "config/plugin_directory.hpp"
#include "config/yaml_tree.hpp"

namespace breccia {

/// `above` laid over `below`, a file over its base. Mappings are merged key by key; values and lists of `above` replace
/// those of `below` whole. Two cases in which what is above excludes what is below:
///   - a plugin's section with another `type` replaces the one below, whose parameters belong to another plugin;
///   - of parameters that exclude each other (exactly or at most one of them), one given above drops the others below.
/// Every node keeps its place; a key given in both files has the place above.
YamlPtr merge(const ParamSpec& spec, const YamlPtr& below, const YamlPtr& above, const PluginDirectory& plugins);

/// The same for values that were put into `tree` one by one (`--set`, a study) and whose places have source `on_top` or
/// later: of parameters that exclude each other, one given so drops the others.
YamlPtr drop_replaced(const ParamSpec& spec, const YamlPtr& tree, int on_top, const PluginDirectory& plugins);

/// The tree with the defaults written out that `path` ("postprocessors.0.every") leads into, so that a value given
/// there replaces a part of the default and not the whole. Where nothing is defaulted on the way, the tree as it is.
YamlPtr fill_defaults(const ParamSpec& spec, const YamlPtr& tree, std::string_view path,
                      const PluginDirectory& plugins);

}  // namespace breccia
