// SPDX-License-Identifier: BSD-3-Clause
#include "config/base_chain.hpp"

#include <algorithm>

#include "breccia/text_file.hpp"
#include "config/yaml_text.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

YamlPtr without(const YamlPtr& tree, const std::string& key) {
  auto copy = std::make_shared<YamlNode>(*tree);
  std::erase_if(copy->entries, [&](const YamlEntry& entry) { return entry.key == key; });
  return copy;
}

/// "a.yaml -> b.yaml -> a.yaml"
std::string circle(const std::vector<InputFile>& files, std::size_t first) {
  std::string names;
  for (std::size_t k = first; k < files.size(); ++k) names += files[k].name + " -> ";
  return names + files[first].name;
}

}  // namespace

std::string read_text(const fs::path& file) {
  std::error_code error;  // of paths that are too long, say: opening fails for them as well
  if (fs::is_directory(file, error)) throw UserError(file.string() + " is a folder; a workflow file is needed");
  return read_bytes(file, max_workflow_bytes + 1);  // one more tells that there is too much
}

BaseChain single_file(const std::string& yaml_text, const std::string& file_name, const std::string& what) {
  BaseChain chain;
  InputFile& file = chain.files.emplace_back(InputFile{file_name, fs::absolute(file_name).parent_path(), nullptr, {}});
  file.tree = parse_yaml(yaml_text, {0, 1, 1}, chain.findings);
  if (!file.tree) return chain;
  chain.whole = file.tree->kind != YamlNode::Kind::null;
  if (!chain.whole) chain.findings.push_back({{0, 1, 1}, "", "the " + what + " is empty"});
  return chain;
}

BaseChain follow_bases(const std::string& yaml_text, const std::string& file_name) {
  BaseChain chain;
  std::string text = yaml_text, name = file_name;
  for (;;) {
    const int source = int(chain.files.size());
    InputFile& file = chain.files.emplace_back(InputFile{name, fs::absolute(name).parent_path(), nullptr, {}});
    YamlPtr tree = parse_yaml(text, {source, 1, 1}, chain.findings);
    if (!tree) return chain;
    if (tree->kind == YamlNode::Kind::null) {
      chain.findings.push_back({{source, 1, 1}, "", source == 0 ? "the workflow is empty" : "the base is empty"});
      return chain;
    }
    file.tree = tree;
    const YamlEntry* base = tree->find("base");
    if (!base) break;
    file.tree = without(tree, "base");
    file.base = base->place;
    const YamlNode& value = *base->value;
    const auto refuse = [&](std::string why) { chain.findings.push_back({value.place, "base", std::move(why)}); };
    if (value.kind != YamlNode::Kind::scalar || value.text.empty()) {
      refuse("must be the name of the workflow file to build on, such as `base: specimen.yaml`");
      return chain;
    }
    if (chain.files.size() > max_bases) {
      refuse("more than " + std::to_string(max_bases) + " files build on each other");
      return chain;
    }
    const fs::path next = (fs::path(name).parent_path() / value.text).lexically_normal();
    try {
      text = read_text(next);
    } catch (const UserError& error) {
      refuse(error.what());
      return chain;
    }
    for (std::size_t k = 0; k < chain.files.size(); ++k) {
      std::error_code unknown;  // the workflow may be a text that is in no file
      if (!fs::equivalent(chain.files[k].name, next, unknown)) continue;
      refuse("the files build on each other in a circle: " + circle(chain.files, k));
      return chain;
    }
    name = next.string();
  }
  chain.whole = true;
  return chain;
}

}  // namespace breccia
