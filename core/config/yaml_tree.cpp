// SPDX-License-Identifier: BSD-3-Clause
#include "config/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <charconv>
#include <map>
#include <sstream>

#include "breccia/text_file.hpp"
#include "config/number.hpp"
#include "config/yaml_syntax.hpp"
#include "config/yaml_text.hpp"

namespace breccia {

namespace {

constexpr std::size_t max_expanded = std::size_t(8) << 20;

/// The rest of the text cannot be trusted after this finding.
struct Stop {
  Finding finding;
};

/// Builds the tree from the parser's events: unlike the library's own tree, they show duplicates, aliases and tags.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const SourceText& source, std::vector<Finding>& findings) : source_(source), findings_(findings) {}

  YamlPtr root() const { return root_; }
  bool any_document() const { return started_; }
  Place start() const { return start_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    started_ = true;
    start_ = place(mark);
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    auto node = make(YamlNode::Kind::null, mark);
    // The library's mark of an empty value is wherever the next word happens to be.
    if (!open_.empty() && open_.back().expects_value()) node->place = open_.back().key_place;
    finish(node, anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    auto node = make(YamlNode::Kind::scalar, mark);
    refuse_tag(tag, mark);
    node->text = value;
    node->plain = tag != "!";
    node->weight += value.size();
    check_one_line(*node, offset(mark));
    if (value.find('\0') != std::string::npos) report(node->place, "a zero byte in a text; delete the escape `\\0`");
    finish(node, anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto it = anchors_.find(anchor);
    if (it == anchors_.end())
      throw Stop{{place(mark), path_here(), "the alias stands inside what it refers to, which would never end"}};
    if (is_key_next()) throw Stop{{place(mark), path_here(), "an alias cannot be a key"}};
    attach(it->second);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::sequence, tag, mark, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::mapping, tag, mark, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Frame {
    std::shared_ptr<YamlNode> node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;
    std::string key;
    Place key_place;
    bool expects_value() const { return node->kind == YamlNode::Kind::mapping && has_key; }
  };

  std::size_t offset(const YAML::Mark& mark) const { return mark.pos < 0 ? 0 : std::size_t(mark.pos); }
  Place place(const YAML::Mark& mark) const { return source_.place(offset(mark)); }
  std::shared_ptr<YamlNode> make(YamlNode::Kind kind, const YAML::Mark& mark) const {
    auto node = std::make_shared<YamlNode>();
    node->kind = kind;
    node->place = place(mark);
    return node;
  }
  bool is_key_next() const {
    return !open_.empty() && open_.back().node->kind == YamlNode::Kind::mapping && !open_.back().has_key;
  }
  std::string path_here() const {
    std::string path;
    for (const Frame& f : open_) {
      if (f.expects_value()) path = member_path(path, f.key);
      else if (f.node->kind == YamlNode::Kind::sequence) path = item_path(path, f.node->items.size());
    }
    return path;
  }
  void report(Place at, std::string text) { findings_.push_back({at, path_here(), std::move(text)}); }

  void refuse_tag(const std::string& tag, const YAML::Mark& mark) {
    if (!tag.empty() && tag != "?" && tag != "!")
      report(place(mark), "tags (`!...`) have no meaning here; leave it out");
  }

  /// The library takes a bracket that is never closed for the beginning of a key.
  [[noreturn]] void refuse_key(std::size_t at) const {
    const std::string_view text = source_.text();
    int depth = 0;
    for (std::size_t k = at; k < text.size(); ++k) {
      if (text[k] == '[' || text[k] == '{') ++depth;
      if ((text[k] == ']' || text[k] == '}') && --depth == 0) break;
    }
    throw Stop{{source_.place(at), path_here(),
                depth > 0 ? "a bracket that is opened here is not closed"
                          : "a key must be a word; a list or mapping cannot be one"}};
  }

  void open(YamlNode::Kind kind, const std::string& tag, const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (is_key_next()) refuse_key(offset(mark));
    refuse_tag(tag, mark);
    open_.push_back({make(kind, mark), anchor, false, {}, {}});
  }
  void close() {
    const Frame frame = std::move(open_.back());
    open_.pop_back();
    finish(frame.node, frame.anchor);
  }
  void finish(const std::shared_ptr<YamlNode>& node, YAML::anchor_t anchor) {
    if (anchor) anchors_[anchor] = node;
    attach(node);
  }

  void attach(const YamlPtr& value) {
    if (open_.empty()) {
      root_ = value;
      return;
    }
    Frame& top = open_.back();
    if (is_key_next()) {
      if (value->kind != YamlNode::Kind::scalar)
        throw Stop{{value->place, path_here(), "a key is missing before the colon"}};
      top.has_key = true;
      top.key = value->text;
      top.key_place = value->place;
      return;
    }
    top.node->weight += value->weight;
    if (top.node->weight > max_expanded)
      throw Stop{{value->place, path_here(), "the file grows beyond all bounds when its aliases are written out"}};
    if (top.node->kind == YamlNode::Kind::sequence) {
      top.node->items.push_back(value);
      return;
    }
    add_entry(top, value);
    top.has_key = false;
  }

  void add_entry(const Frame& top, const YamlPtr& value) {
    if (top.key == "<<") {
      findings_.push_back({top.key_place, path_here(),
                           "merge keys (`<<`) are not followed; write the members out, or give the "
                           "whole section an anchor (`&name`) and use it as `*name`"});
    } else if (!keys_[top.node.get()].emplace(top.key, top.key_place).second) {
      const int first = keys_[top.node.get()].at(top.key).line;
      findings_.push_back({top.key_place, path_here(), "given twice; the first is in line " + std::to_string(first)});
    } else {
      top.node->entries.push_back({top.key, top.key_place, value});
    }
  }

  /// Quotes that are not closed and lines that run on are read by the library as one long text.
  void check_one_line(const YamlNode& node, std::size_t at) const {
    const std::string_view text = source_.text();
    // The mark of a value with an anchor or a tag is that of the anchor.
    while (at < text.size() && (text[at] == '&' || (text[at] == '!' && !node.text.starts_with('!')))) {
      while (at < text.size() && !std::isspace(static_cast<unsigned char>(text[at]))) ++at;
      while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at]))) ++at;
    }
    if (at >= text.size() || text[at] == '|' || text[at] == '>') return;
    const char quote = text[at];
    if (quote == '"' || quote == '\'') {
      if (!is_key_or_value_closed(text, at))
        throw Stop{{source_.place(at), path_here(), "the quote opened here is not closed in its line"}};
    } else if (node.plain && text.substr(at, node.text.size()) != node.text) {
      const std::string_view line = source_.line(source_.line_of(at));
      const std::string first(line.substr(at - source_.line_start(source_.line_of(at))));
      throw Stop{{source_.place(at), path_here(),
                  "`" + first.substr(0, 60) +
                      "` goes on in the next line; check the "
                      "indentation there, colons and brackets"}};
    }
  }

  static bool is_key_or_value_closed(std::string_view text, std::size_t at) {
    const char quote = text[at];
    for (std::size_t k = at + 1; k < text.size() && text[k] != '\n'; ++k) {
      if (quote == '"' && text[k] == '\\' && k + 1 < text.size() && text[k + 1] != '\n') ++k;
      else if (text[k] == quote && quote == '\'' && k + 1 < text.size() && text[k + 1] == quote) ++k;
      else if (text[k] == quote) return true;
    }
    return false;
  }

  const SourceText& source_;
  std::vector<Finding>& findings_;
  std::vector<Frame> open_;
  std::map<YAML::anchor_t, YamlPtr> anchors_;
  std::map<const YamlNode*, std::map<std::string, Place>> keys_;
  YamlPtr root_;
  bool started_ = false;
  Place start_;
};

}  // namespace

const YamlEntry* YamlNode::find(std::string_view key) const {
  for (const YamlEntry& entry : entries)
    if (entry.key == key) return &entry;
  return nullptr;
}

YamlPtr parse_yaml(std::string_view given, Place origin, std::vector<Finding>& findings) {
  const std::string text = plain_lines(given);
  const SourceText source(text, origin);
  if (!check_text(source, findings)) return nullptr;
  try {
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    TreeBuilder first(source, findings);
    if (!parser.HandleNextDocument(first) || !first.root()) return null_node(origin);
    std::vector<Finding> unused;
    TreeBuilder second(source, unused);
    if (parser.HandleNextDocument(second)) {
      const std::size_t number = std::size_t(second.start().line - origin.line);
      const bool separated = source.line(number).substr(0, 3) == "---";
      findings.push_back({second.start(), "",
                          separated ? "a second document begins; a workflow is one document"
                                    : "what follows does not belong to what stands above; a workflow is "
                                      "one mapping, check the indentation"});
      return nullptr;
    }
    return first.root();
  } catch (const Stop& stop) { findings.push_back(stop.finding); } catch (const YAML::ParserException& error) {
    findings.push_back(explain_syntax(source, error.mark.pos < 0 ? 0 : std::size_t(error.mark.pos), error.msg));
  }
  return nullptr;
}

Json plain_json(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null:
      return nullptr;
    case YamlNode::Kind::sequence: {
      Json all = Json::array();
      for (const YamlPtr& item : node.items) all.push_back(plain_json(*item));
      return all;
    }
    case YamlNode::Kind::mapping: {
      Json all = Json::object();
      // Keys are unique already; operator[] would look through all of them each time.
      for (const YamlEntry& entry : node.entries)
        all.get_ref<Json::object_t&>().push_back({entry.key, plain_json(*entry.value)});
      return all;
    }
    case YamlNode::Kind::scalar:
      break;
  }
  if (!node.plain) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  const auto number = scan_decimal(node.text);
  if (!number || number->length != node.text.size() || has_leading_zero(*number)) return node.text;
  if (node.text.find_first_of(".eE") == std::string::npos) {
    const char* begin = node.text.data() + (node.text[0] == '+' ? 1 : 0);
    const char* end = node.text.data() + node.text.size();
    std::int64_t whole = 0;
    std::uint64_t large = 0;
    if (const auto r = std::from_chars(begin, end, whole); r.ec == std::errc() && r.ptr == end) return whole;
    if (const auto r = std::from_chars(begin, end, large); r.ec == std::errc() && r.ptr == end) return large;
  }
  if (const auto value = to_double(*number)) return *value;
  return node.text;
}

YamlPtr null_node(Place place) {
  auto node = std::make_shared<YamlNode>();
  node->place = place;
  return node;
}

std::string member_path(const std::string& parent, std::string_view key) {
  return parent.empty() ? std::string(key) : parent + "." + std::string(key);
}

std::string item_path(const std::string& parent, std::size_t index) {
  return parent + "[" + std::to_string(index) + "]";
}

std::vector<PathStep> split_path(std::string_view path) {
  std::vector<PathStep> steps{{"", 0}};
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (path[k] == '.' || path[k] == '[') steps.push_back({"", k + 1});
    else if (path[k] != ']') steps.back().name += path[k];
  }
  return steps;
}

std::optional<std::size_t> item_index(const std::string& step, std::size_t count) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (error != std::errc() || end != step.data() + step.size() || index >= count) return {};
  return index;
}

}  // namespace breccia
