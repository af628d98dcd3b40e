// SPDX-License-Identifier: BSD-3-Clause
#include "config/writer.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "breccia/utf8.hpp"
#include "config/to_yaml.hpp"

namespace breccia {

namespace {

/// Text that any YAML reader takes as that same text without quotes.
bool is_plain_text(const std::string& text) {
  if (text.empty() || !(std::isalpha(static_cast<unsigned char>(text[0])) || text[0] == '/' || text[0] == '_'))
    return false;
  for (const char c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && (c == '\0' || !std::strchr("_/.-+ ", c))) return false;
  if (text.back() == ' ') return false;
  std::string lower;
  for (const char c : text) lower += char(std::tolower(static_cast<unsigned char>(c)));
  for (const char* word : {"true", "false", "yes", "no", "on", "off", "y", "n", "null"})
    if (lower == word) return false;
  return true;
}

std::string quoted(const std::string& text) { return json_text(text); }

std::string scalar_text(const YamlNode& node) {
  return node.plain || is_plain_text(node.text) ? node.text : quoted(node.text);
}

std::string key_text(const std::string& key) { return is_plain_text(key) ? key : quoted(key); }

bool is_flat(const YamlNode& list) {
  return std::all_of(list.items.begin(), list.items.end(), [](const YamlPtr& item) {
    return item->kind == YamlNode::Kind::scalar || item->kind == YamlNode::Kind::null;
  });
}

class TextWriter {
 public:
  std::string text;

  /// What follows "key:" or "-": on the same line, or on lines of its own.
  void write_value(const YamlNode& node, int indent) {
    switch (node.kind) {
      case YamlNode::Kind::null:
        text += " null\n";
        return;
      case YamlNode::Kind::scalar:
        text += " " + scalar_text(node) + "\n";
        return;
      case YamlNode::Kind::mapping:
        text += node.entries.empty() ? " {}\n" : "\n";
        write_entries(node, indent);
        return;
      case YamlNode::Kind::sequence:
        if (is_flat(node)) {
          text += " " + flow(node) + "\n";
        } else {
          text += "\n";
          write_items(node, indent);
        }
    }
  }

  void write_entries(const YamlNode& mapping, int indent, bool first_is_indented = false) {
    for (const YamlEntry& entry : mapping.entries) {
      if (!first_is_indented) text.append(indent, ' ');
      first_is_indented = false;
      text += key_text(entry.key) + ":";
      write_value(*entry.value, indent + 2);
    }
  }

 private:
  void write_items(const YamlNode& list, int indent) {
    for (const YamlPtr& item : list.items) {
      text.append(indent, ' ');
      text += "-";
      if (item->kind == YamlNode::Kind::mapping && !item->entries.empty()) {
        text += " ";
        write_entries(*item, indent + 2, true);
      } else {
        write_value(*item, indent + 2);
      }
    }
  }
  static std::string flow(const YamlNode& list) {
    std::string all = "[";
    for (std::size_t k = 0; k < list.items.size(); ++k) {
      const YamlNode& item = *list.items[k];
      all += (k ? ", " : "") + (item.kind == YamlNode::Kind::null ? "null" : scalar_text(item));
    }
    return all + "]";
  }
};

}  // namespace

std::string write_yaml(const Json& config, const ParamSpec& root, const PluginDirectory& plugins) {
  TextWriter writer;
  writer.write_entries(*yaml_of(root, config, plugins), 0);
  return writer.text;
}

}  // namespace breccia
