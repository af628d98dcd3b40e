// SPDX-License-Identifier: BSD-3-Clause
/// What the result of a run depends on, in one short text.
#pragma once

#include <string>

#include "plugin/registry.hpp"

namespace breccia {

/// Of a resolved configuration, and of the contents of the files that it names; not of the program and its plugins, nor
/// of what only describes the run.
std::string input_hash(Json config, const Registry& registry);

}  // namespace breccia
