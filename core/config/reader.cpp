// SPDX-License-Identifier: BSD-3-Clause
#include "config/reader.hpp"

#include <algorithm>
#include <tuple>

#include "config/merge.hpp"
#include "config/overrides.hpp"
#include "config/section_reader.hpp"
#include "config/suggest.hpp"

namespace breccia {

std::vector<Problem> problems_of(std::vector<Finding> findings, const std::vector<InputFile>& files) {
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
  return problems;
}

void refuse(std::vector<Finding> findings, const std::vector<InputFile>& files) {
  throw ConfigError(problems_of(std::move(findings), files));
}

namespace {

/// Takes the mapping `variants` out of the tree, and lays the one asked for over what is left.
YamlPtr choose_variant(const YamlPtr& tree, const std::string& variant, const ParamSpec& root,
                       const PluginDirectory& plugins, const std::string& file, std::vector<Finding>& findings) {
  const YamlEntry* found = tree->find("variants");
  if (!found) {
    if (!variant.empty())
      throw UserError(file + ": there is no variant `" + variant + "`: the workflow has no `variants`");
    return tree;
  }
  const YamlEntry variants = *found;
  auto rest = std::make_shared<YamlNode>(*tree);
  std::erase_if(rest->entries, [](const YamlEntry& e) { return e.key == "variants"; });
  if (variants.value->kind != YamlNode::Kind::mapping) {
    findings.push_back(
        {variants.place, "variants", "must be a mapping: the name of each variant, and what differs in it"});
    return rest;
  }
  std::vector<std::string> names;
  for (const YamlEntry& e : variants.value->entries) {
    names.push_back(e.key);
    if (e.value->kind != YamlNode::Kind::mapping)
      findings.push_back({e.place, "variants." + e.key, "must be a mapping of what differs in this variant"});
    else if (const YamlEntry* base = e.value->find("base"))
      findings.push_back({base->place, "variants." + e.key + ".base", "a variant has no base of its own"});
    else if (const YamlEntry* inner = e.value->find("variants"))
      findings.push_back({inner->place, "variants." + e.key + ".variants", "a variant has no variants of its own"});
  }
  if (variant.empty() || !findings.empty()) return rest;
  const YamlEntry* chosen = variants.value->find(variant);
  if (!chosen) throw UserError(file + ": there is no variant `" + variant + "`" + suggestion(variant, names));
  return merge(root, rest, chosen->value, plugins);
}

/// The files of the chain, each over its base, with the variant over them.
YamlPtr merged(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins,
               const std::string& variant, std::vector<Finding>& findings) {
  if (!chain.whole) refuse(chain.findings, chain.files);
  YamlPtr tree = chain.files.back().tree;
  for (std::size_t k = chain.files.size() - 1; k-- > 0;) tree = merge(root, tree, chain.files[k].tree, plugins);
  findings = chain.findings;
  if (tree->kind == YamlNode::Kind::mapping)
    tree = choose_variant(tree, variant, root, plugins, chain.files.front().name, findings);
  return tree;
}

Json checked(const YamlPtr& tree, const std::vector<InputFile>& files, std::vector<Finding> findings,
             const ParamSpec& root, const PluginDirectory& plugins,
             const std::function<Issues(const Json&)>& root_rules = {}) {
  if (const YamlEntry* base = tree->find("base"))
    findings.push_back({base->place, "base", "cannot be set here; only a workflow file names the file it builds on"});

  SectionReader reader(plugins, files, root, *tree);
  Json config = reader.read(root, *tree, {"", {}});
  if (findings.empty() && reader.findings().empty() && root_rules)
    reader.add_issues(root_rules(config), *tree, {"", {}});
  findings.insert(findings.end(), reader.findings().begin(), reader.findings().end());
  if (!findings.empty()) refuse(std::move(findings), files);
  return config;
}

/// A copy whose places name another source.
YamlPtr with_source(const YamlPtr& node, int source) {
  auto copy = std::make_shared<YamlNode>(*node);
  copy->place.source = source;
  for (YamlPtr& item : copy->items) item = with_source(item, source);
  for (YamlEntry& entry : copy->entries) {
    entry.place.source = source;
    entry.value = with_source(entry.value, source);
  }
  return copy;
}

}  // namespace

std::vector<std::string> variants_of(const BaseChain& chain) {
  std::vector<std::string> names;
  for (const InputFile& file : chain.files) {
    const YamlEntry* variants =
        file.tree && file.tree->kind == YamlNode::Kind::mapping ? file.tree->find("variants") : nullptr;
    if (!variants || variants->value->kind != YamlNode::Kind::mapping) continue;
    for (const YamlEntry& e : variants->value->entries) names.push_back(e.key);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Json read_config(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins,
                 const ValuesOnTop& on_top) {
  std::vector<Finding> findings;
  YamlPtr tree = merged(chain, root, plugins, {}, findings);
  std::vector<InputFile> files = chain.files;
  const int source = int(files.size());
  files.push_back(on_top.file);
  files.back().on_top = true;
  if (tree->kind == YamlNode::Kind::mapping)
    for (const PlacedValue& given : on_top.values) {
      PlacedValue here = given;
      here.place.source = source;
      here.value = with_source(given.value, source);
      tree = apply_value(tree, here, findings);
    }
  tree = drop_replaced(root, tree, source, plugins);
  return checked(tree, files, std::move(findings), root, plugins);
}

Json read_config(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins,
                 const std::vector<std::string>& overrides, const std::function<Issues(const Json&)>& root_rules,
                 const std::string& variant) {
  std::vector<Finding> findings;
  YamlPtr tree = merged(chain, root, plugins, variant, findings);
  const int command_line = int(chain.files.size());
  if (tree->kind == YamlNode::Kind::mapping)
    for (std::size_t k = 0; k < overrides.size(); ++k)
      tree = apply_override(tree, overrides[k], {command_line, int(k) + 1, 1}, findings);
  tree = drop_replaced(root, tree, command_line, plugins);
  return checked(tree, chain.files, std::move(findings), root, plugins, root_rules);
}

Json read_config(const std::string& yaml_text, const std::string& file_name, const ParamSpec& root,
                 const PluginDirectory& plugins, const std::vector<std::string>& overrides,
                 const std::function<Issues(const Json&)>& root_rules) {
  return read_config(follow_bases(yaml_text, file_name), root, plugins, overrides, root_rules);
}

}  // namespace breccia
