// SPDX-License-Identifier: BSD-3-Clause
#include "config/reader.hpp"

#include <algorithm>
#include <tuple>

#include "config/merge.hpp"
#include "config/overrides.hpp"
#include "config/section_reader.hpp"

namespace breccia {

namespace {

[[noreturn]] void refuse(std::vector<Finding> findings, const std::vector<InputFile>& files) {
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return std::tie(a.place.source, a.place.line, a.place.column) <
           std::tie(b.place.source, b.place.line, b.place.column);
  });
  std::vector<Problem> problems;
  for (Finding& f : findings) {
    const std::size_t source = std::size_t(f.place.source);
    problems.push_back({source < files.size() ? files[source].name : "--set", f.place.line, f.place.column,
                        std::move(f.path), std::move(f.text)});
  }
  throw ConfigError(std::move(problems));
}

}  // namespace

Json read_config(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins,
                 const std::vector<std::string>& overrides, const std::function<Issues(const Json&)>& root_rules) {
  if (!chain.whole) refuse(chain.findings, chain.files);
  std::vector<Finding> findings = chain.findings;
  YamlPtr tree = chain.files.back().tree;
  for (std::size_t k = chain.files.size() - 1; k-- > 0;) tree = merge(root, tree, chain.files[k].tree, plugins);
  const int command_line = int(chain.files.size());
  if (tree->kind == YamlNode::Kind::mapping)
    for (std::size_t k = 0; k < overrides.size(); ++k)
      tree = apply_override(tree, overrides[k], {command_line, int(k) + 1, 1}, findings);
  if (const YamlEntry* base = tree->find("base"))
    findings.push_back({base->place, "base", "cannot be set here; only a workflow file names the file it builds on"});

  SectionReader reader(plugins, chain.files, root, *tree);
  Json config = reader.read(root, *tree, {"", {}});
  if (findings.empty() && reader.findings().empty() && root_rules)
    reader.add_issues(root_rules(config), *tree, {"", {}});
  findings.insert(findings.end(), reader.findings().begin(), reader.findings().end());
  if (!findings.empty()) refuse(std::move(findings), chain.files);
  return config;
}

Json read_config(const std::string& yaml_text, const std::string& file_name, const ParamSpec& root,
                 const PluginDirectory& plugins, const std::vector<std::string>& overrides,
                 const std::function<Issues(const Json&)>& root_rules) {
  return read_config(follow_bases(yaml_text, file_name), root, plugins, overrides, root_rules);
}

}  // namespace breccia
