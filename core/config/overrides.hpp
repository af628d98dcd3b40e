// SPDX-License-Identifier: BSD-3-Clause
/// Values given on the command line: "contact_law.friction=0.3", "postprocessor.0.every=2 ms"; or by a study. Internal
/// to the configuration.
#pragma once

#include "config/base_chain.hpp"

namespace breccia {

/// A copy of `root` with one value replaced or added; the value is read as YAML. List items count from 0, as
/// `list.0.key` or `list[0].key`. Keys that no schema knows are left for the reader to refuse. What cannot be
/// applied becomes a finding, and `root` is returned as it was. `start` is the place of the override's first character.
YamlPtr apply_override(const YamlPtr& root, std::string_view override_text, Place start,
                       std::vector<Finding>& findings);

/// The same for a value that was read before.
YamlPtr apply_value(const YamlPtr& root, const PlacedValue& given, std::vector<Finding>& findings);

}  // namespace breccia
