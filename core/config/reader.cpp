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

namespace {

/// A workflow with all that is laid over its files, not yet checked.
struct Laid {
  YamlPtr tree;
  std::vector<InputFile> files;  ///< sources of the places; those beyond them are overrides
  std::vector<Finding> findings;
};

Laid laid(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins, const ValuesOnTop& on_top) {
  Laid all{nullptr, chain.files, {}};
  all.tree = merged(chain, root, plugins, on_top.changes ? "" : on_top.variant, all.findings);
  if (on_top.changes) all.tree = merge(root, all.tree, with_source(on_top.changes, int(all.files.size())), plugins);
  const int source = int(all.files.size());
  all.files.push_back(on_top.file);
  all.files.back().on_top = true;
  if (all.tree->kind == YamlNode::Kind::mapping)
    for (const PlacedValue& given : on_top.values) {
      PlacedValue here = given;
      here.place.source = source;
      here.value = with_source(given.value, source);
      all.tree = apply_value(fill_defaults(root, all.tree, here.path, plugins), here, all.findings);
    }
  all.tree = drop_replaced(root, all.tree, source, plugins);
  return all;
}

Laid laid(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins,
          const std::vector<std::string>& overrides, const std::string& variant) {
  Laid all{nullptr, chain.files, {}};
  all.tree = merged(chain, root, plugins, variant, all.findings);
  const int command_line = int(chain.files.size());
  if (all.tree->kind == YamlNode::Kind::mapping)
    for (std::size_t k = 0; k < overrides.size(); ++k) {
      const Place place{command_line, int(k) + 1, 1};
      const std::string path = overrides[k].substr(0, overrides[k].find('='));
      all.tree = apply_override(fill_defaults(root, all.tree, path, plugins), overrides[k], place, all.findings);
    }
  all.tree = drop_replaced(root, all.tree, command_line, plugins);
  return all;
}

/// Knows none: what is read before the plugins are known.
struct NoPlugins final : PluginDirectory {
  std::vector<std::string> names(const std::string&) const override { return {}; }
  const Documentation& documentation(const std::string& kind, const std::string& name) const override {
    throw UserError("no " + kind + " `" + name + "` is known yet");
  }
  Issues check(const std::string&, const std::string&, const Json&) const override { return {}; }
};

Json section_of(const Laid& all, const ParamSpec& root, const std::string& name) {
  const auto member =
      std::find_if(root.members.begin(), root.members.end(), [&](const ParamSpec& m) { return m.name == name; });
  BRECCIA_ASSERT(member != root.members.end());
  const YamlEntry* entry = all.tree->kind == YamlNode::Kind::mapping ? all.tree->find(name) : nullptr;
  if (!entry) return nullptr;
  const NoPlugins none;
  SectionReader reader(none, all.files, root, *all.tree);
  Json section = reader.read(*member, *entry->value, {name, entry->place});
  return reader.findings().empty() ? section : Json();
}

}  // namespace

Json read_section(const BaseChain& chain, const ParamSpec& root, const std::string& name,
                  const std::vector<std::string>& overrides, const std::string& variant) {
  return section_of(laid(chain, root, NoPlugins(), overrides, variant), root, name);
}

Json read_section(const BaseChain& chain, const ParamSpec& root, const std::string& name, const ValuesOnTop& on_top) {
  return section_of(laid(chain, root, NoPlugins(), on_top), root, name);
}

Json read_config(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins,
                 const ValuesOnTop& on_top, const std::function<Issues(const Json&)>& root_rules, Places* places) {
  Laid all = laid(chain, root, plugins, on_top);
  if (places) *places = Places(all.tree, all.files);
  return checked(all.tree, all.files, std::move(all.findings), root, plugins, root_rules);
}

Json read_config(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins,
                 const std::vector<std::string>& overrides, const std::function<Issues(const Json&)>& root_rules,
                 const std::string& variant, Places* places) {
  Laid all = laid(chain, root, plugins, overrides, variant);
  if (places) *places = Places(all.tree, all.files);
  return checked(all.tree, all.files, std::move(all.findings), root, plugins, root_rules);
}

Json read_config(const std::string& yaml_text, const std::string& file_name, const ParamSpec& root,
                 const PluginDirectory& plugins, const std::vector<std::string>& overrides,
                 const std::function<Issues(const Json&)>& root_rules) {
  return read_config(follow_bases(yaml_text, file_name), root, plugins, overrides, root_rules);
}

}  // namespace breccia
