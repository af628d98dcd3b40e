// SPDX-License-Identifier: BSD-3-Clause
#include "config/overrides.hpp"

namespace breccia {

namespace {

struct Step {
  std::string name;
  Place place;
};

/// Thrown inside this file only: the override cannot be applied.
struct Refused {
  Finding finding;
};

std::vector<Step> steps_of(std::string_view path, Place start) {
  std::vector<Step> steps;
  for (PathStep& step : split_path(path))
    steps.push_back({std::move(step.name), {start.source, start.line, start.column + int(step.offset)}});
  return steps;
}

YamlPtr with_value(const YamlPtr& node, const std::vector<Step>& steps, std::size_t depth, const YamlPtr& value,
                   const std::string& path) {
  if (depth == steps.size()) return value;
  const Step& step = steps[depth];
  auto copy = std::make_shared<YamlNode>(*node);
  if (node->kind == YamlNode::Kind::sequence) {
    const auto index = item_index(step.name);
    const std::string count = std::to_string(node->items.size());
    if (!index)
      throw Refused{{step.place, path, "is a list: its items are named by numbers from 0, not by `" + step.name + "`"}};
    if (*index >= node->items.size())
      throw Refused{{step.place, path, "has no item " + step.name + "; it has " + count + ", counted from 0"}};
    copy->items[*index] = with_value(node->items[*index], steps, depth + 1, value, item_path(path, *index));
    return copy;
  }
  if (node->kind == YamlNode::Kind::scalar)
    throw Refused{
        {step.place, path, "is the single value `" + node->text + "`, which has no `" + step.name + "` in it"}};
  if (node->kind == YamlNode::Kind::null) {
    copy->kind = YamlNode::Kind::mapping;
    copy->place = step.place;
  }
  const std::string inner = member_path(path, step.name);
  for (YamlEntry& entry : copy->entries)
    if (entry.key == step.name) {
      entry.value = with_value(entry.value, steps, depth + 1, value, inner);
      return copy;
    }
  copy->entries.push_back({step.name, step.place, with_value(null_node(step.place), steps, depth + 1, value, inner)});
  return copy;
}

}  // namespace

namespace {

/// What cannot be applied becomes a finding.
YamlPtr placed(const YamlPtr& root, const std::vector<Step>& steps, const YamlPtr& value,
               std::vector<Finding>& findings) {
  try {
    return with_value(root, steps, 0, value, "");
  } catch (const Refused& refused) {
    findings.push_back(refused.finding);
    return root;
  }
}

/// After a finding when a part is empty.
bool check_steps(const std::vector<Step>& steps, std::string_view path, std::vector<Finding>& findings) {
  for (const Step& step : steps)
    if (step.name.empty()) {
      findings.push_back({step.place, "",
                          "`" + std::string(path) +
                              "` has an empty part; a path reads "
                              "`section.key` or `list.0.key`"});
      return false;
    }
  return true;
}

}  // namespace

YamlPtr apply_value(const YamlPtr& root, const PlacedValue& given, std::vector<Finding>& findings) {
  const std::vector<Step> steps = steps_of(given.path, given.place);
  return check_steps(steps, given.path, findings) ? placed(root, steps, given.value, findings) : root;
}

YamlPtr apply_override(const YamlPtr& root, std::string_view text, Place start, std::vector<Finding>& findings) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    findings.push_back({start, "", "`" + std::string(text) + "` is not of the form `path=value`"});
    return root;
  }
  const std::vector<Step> steps = steps_of(text.substr(0, equals), start);
  if (!check_steps(steps, text.substr(0, equals), findings)) return root;
  const Place value_place{start.source, start.line, start.column + int(equals) + 1};
  std::vector<Finding> in_value;
  const YamlPtr value = parse_yaml(text.substr(equals + 1), value_place, in_value);
  std::string path;
  for (const Step& step : steps) path = member_path(path, step.name);
  for (Finding& finding : in_value) {
    finding.path = path;
    findings.push_back(std::move(finding));
  }
  return value ? placed(root, steps, value, findings) : root;
}

}  // namespace breccia
