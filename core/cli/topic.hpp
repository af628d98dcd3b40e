// SPDX-License-Identifier: BSD-3-Clause
/// What `breccia describe` may be asked for.
#pragma once

#include "plugin/registry.hpp"

namespace breccia::cli {

struct Topic {
  std::string kind, name;  ///< of a plugin; the kind is empty for the keys of a file
  Documentation doc;
  std::string origin = {};  ///< lines on where a plugin comes from that is not Breccia's; else empty
};

/// A plugin, or the keys of workflows, studies or calibrations. UserError for what is neither.
Topic topic_named(const Registry& registry, const std::string& written);

}  // namespace breccia::cli
