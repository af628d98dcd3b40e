// SPDX-License-Identifier: BSD-3-Clause
/// YAML as a tree in which everything knows where it was written. A strict subset: one document, one mapping at the
/// top, no duplicate or merge keys, no tags, values on one line unless they are block scalars. Internal to the
/// configuration.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "breccia/schema.hpp"

namespace breccia {

/// Where something was written. Source 0 is the workflow, those after it its bases, the last one the command line (its
/// lines are the overrides).
struct Place {
  int source = 0, line = 1, column = 1;
};

/// A problem before the name of its file is known.
struct Finding {
  Place place;
  std::string path, text;
};

struct YamlNode;
using YamlPtr = std::shared_ptr<const YamlNode>;

struct YamlEntry {
  std::string key;
  Place place;  ///< of the key
  YamlPtr value;
};

struct YamlNode {
  enum class Kind { null, scalar, sequence, mapping };
  Kind kind = Kind::null;
  Place place;
  std::string text;   ///< of a scalar
  bool plain = true;  ///< a scalar without quotes
  std::vector<YamlPtr> items;
  std::vector<YamlEntry> entries;
  std::size_t weight = 1;  ///< characters and nodes when all aliases are written out

  const YamlEntry* find(std::string_view key) const;
};

/// The tree, or nullptr when the text cannot be read further than the findings tell. Findings that leave a usable tree
/// (duplicate keys, say) do not end the reading. `origin` is the place of the first character of `text`.
YamlPtr parse_yaml(std::string_view text, Place origin, std::vector<Finding>& findings);

/// The tree as JSON, plain scalars by the rules of YAML's core schema: integers, numbers, true, false, null, else text.
Json plain_json(const YamlNode& node);

/// An empty value.
YamlPtr null_node(Place place);

/// "a.b", "b" without a parent; "a[2]".
std::string member_path(const std::string& parent, std::string_view key);
std::string item_path(const std::string& parent, std::size_t index);

/// One part of a path, and where it begins in it.
struct PathStep {
  std::string name;
  std::size_t offset;
};
/// "walls[2].point" or "walls.2.point" as "walls", "2", "point".
std::vector<PathStep> split_path(std::string_view path);
/// Of a step into a list of `count` items; nothing when it is no number or there is no such item.
std::optional<std::size_t> item_index(const std::string& step, std::size_t count = SIZE_MAX);

}  // namespace breccia
