// SPDX-License-Identifier: BSD-3-Clause
/// The YAML library's terse messages in the words of a workflow's author. Internal to the configuration.
#pragma once

#include <string>

#include "config/yaml_text.hpp"

namespace breccia {

/// What is wrong at byte `offset`, given the library's message, and where the mistake most likely is.
Finding explain_syntax(const SourceText& source, std::size_t offset, const std::string& message);

/// A key such as `friction:0.5` that lacks the space; the text to write instead, or empty.
std::string with_space_after_colon(std::string_view key);

}  // namespace breccia
