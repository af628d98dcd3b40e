// SPDX-License-Identifier: BSD-3-Clause
#include "config/reader.hpp"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "config/overrides.hpp"
#include "config/section_reader.hpp"

namespace breccia {

namespace {

[[noreturn]] void refuse(std::vector<Finding> findings, const std::string& file_name) {
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return std::tie(a.place.source, a.place.line, a.place.column) <
           std::tie(b.place.source, b.place.line, b.place.column);
  });
  std::vector<Problem> problems;
  for (Finding& f : findings)
    problems.push_back({f.place.source == 0 ? file_name : "--set", f.place.line, f.place.column, std::move(f.path),
                        std::move(f.text)});
  throw ConfigError(std::move(problems));
}

}  // namespace

Json read_config(const std::string& yaml_text, const std::string& file_name, const ParamSpec& root,
                 const PluginDirectory& plugins, const std::vector<std::string>& overrides,
                 const std::function<Issues(const Json&)>& root_rules) {
  std::vector<Finding> findings;
  YamlPtr tree = parse_yaml(yaml_text, {}, findings);
  if (tree && tree->kind == YamlNode::Kind::null && findings.empty())
    findings.push_back({{}, "", "the workflow is empty"});
  if (!tree || tree->kind == YamlNode::Kind::null) refuse(std::move(findings), file_name);
  if (tree->kind == YamlNode::Kind::mapping)
    for (std::size_t k = 0; k < overrides.size(); ++k) tree = apply_override(tree, overrides[k], int(k) + 1, findings);

  const std::filesystem::path folder = std::filesystem::absolute(file_name).parent_path();
  SectionReader reader(plugins, folder, root, *tree);
  Json config = reader.read(root, *tree, {"", {}});
  if (findings.empty() && reader.findings().empty() && root_rules)
    reader.add_issues(root_rules(config), *tree, {"", {}});
  findings.insert(findings.end(), reader.findings().begin(), reader.findings().end());
  if (!findings.empty()) refuse(std::move(findings), file_name);
  return config;
}

}  // namespace breccia
