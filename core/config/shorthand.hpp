// SPDX-License-Identifier: BSD-3-Clause
/// The short form of a list of mappings with a single key: `- build/law.so` for `- path: build/law.so`.
#pragma once

#include "breccia/schema.hpp"

namespace breccia {

/// The key that an item of the list may leave out because it is the only one; nullptr when items have no short form.
inline const ParamSpec* shorthand_member(const ParamSpec& list) {
  if (list.type != ParamType::group_list || list.members.size() != 1) return nullptr;
  const ParamSpec& member = list.members.front();
  const bool is_single_value = member.type == ParamType::path || member.type == ParamType::text ||
                               member.type == ParamType::choice || member.type == ParamType::quantity;
  return is_single_value && member.required ? &member : nullptr;
}

}  // namespace breccia
