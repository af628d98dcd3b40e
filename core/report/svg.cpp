// SPDX-License-Identifier: BSD-3-Clause
#include "report/svg.hpp"

#include <algorithm>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string_view>

#include "breccia/utf8.hpp"

namespace breccia::report {
namespace {

/// Elements that draw, and neither run, style the page nor load anything.
bool is_drawing(std::string_view name) {
  static const std::set<std::string_view> all{
      "svg",      "g",        "defs", "symbol", "use",     "title",          "desc",          "path",
      "line",     "polyline", "rect", "circle", "ellipse", "polygon",        "text",          "tspan",
      "clipPath", "mask",     "stop", "marker", "pattern", "linearGradient", "radialGradient"};
  return all.contains(name);
}

class Embedding {
 public:
  Embedding(pugi::xml_node svg, const std::string& prefix) : prefix_(prefix) { collect(svg); }

  /// False when something is not plain drawing.
  bool rewrite(pugi::xml_node node) const {
    if (!is_drawing(node.name())) return false;
    for (pugi::xml_attribute a = node.first_attribute(), next; a; a = next) {
      next = a.next_attribute();
      const std::string_view name = a.name();
      const std::string value = a.value();
      if (name.starts_with("on")) return false;
      if (name == "href" || name == "xlink:href") {
        if (value.empty() || value[0] != '#') return false;
        a.set_value(("#" + prefix_ + value.substr(1)).c_str());
      } else if (name == "id") {
        a.set_value((prefix_ + value).c_str());
      } else if (name == "class") {
        node.remove_attribute(a);  // the page's styles are not meant for it
      } else if (value.find("url(") != value.npos) {
        const std::string own = renamed_urls(value);
        if (own.empty()) return false;
        a.set_value(own.c_str());
      }
    }
    for (pugi::xml_node child : node.children())
      if (child.type() == pugi::node_element && !rewrite(child)) return false;
    return true;
  }

 private:
  void collect(pugi::xml_node node) {
    if (const char* id = node.attribute("id").value(); *id) ids_.insert(id);
    for (pugi::xml_node child : node.children()) collect(child);
  }
  /// Every `url(#a)` of the value as `url(#prefix-a)`; empty when one leads elsewhere.
  std::string renamed_urls(const std::string& value) const {
    std::string out;
    std::size_t from = 0;
    for (std::size_t at; (at = value.find("url(", from)) != value.npos;) {
      std::size_t name = at + 4;
      const bool quoted = name < value.size() && (value[name] == '"' || value[name] == '\'');
      name += quoted;
      if (name >= value.size() || value[name] != '#') return {};
      const std::size_t end = value.find(')', name);
      if (end == value.npos || !ids_.contains(value.substr(name + 1, end - name - 1 - quoted))) return {};
      out += value.substr(from, at - from) + "url(#" + prefix_ + value.substr(name + 1, end - name - 1 - quoted) + ")";
      from = end + 1;
    }
    return out + value.substr(from);
  }

  const std::string& prefix_;
  std::set<std::string> ids_;
};

/// A page scales it by its viewBox; a fixed size would overflow a narrow one.
bool make_scalable(pugi::xml_node svg) {
  if (!svg.attribute("viewBox")) {
    const double width = svg.attribute("width").as_double(), height = svg.attribute("height").as_double();
    if (!(width > 0 && height > 0)) return false;
    std::ostringstream box;
    box << "0 0 " << width << ' ' << height;
    svg.append_attribute("viewBox") = box.str().c_str();
  }
  svg.remove_attribute("width");
  svg.remove_attribute("height");
  return true;
}

}  // namespace

std::optional<InlineSvg> inline_svg(const std::string& text, const std::string& prefix,
                                    const std::string& fallback_title) {
  pugi::xml_document file;
  // Comments, instructions and document types are left out, so that no entity is ever resolved.
  if (valid_utf8(text) != text ||
      !file.load_buffer(text.data(), text.size(), pugi::parse_minimal | pugi::parse_escapes | pugi::parse_cdata,
                        pugi::encoding_utf8))
    return {};
  pugi::xml_node svg = file.document_element();
  if (std::string_view(svg.name()) != "svg" || !Embedding(svg, prefix).rewrite(svg) || !make_scalable(svg)) return {};
  InlineSvg made;
  pugi::xml_node title = svg.child("title");
  if (!title) title = svg.prepend_child("title");
  if (!*title.text().get()) title.text().set(fallback_title.c_str());
  made.title = title.text().get();
  const std::string id = prefix + "title";
  title.remove_attribute("id");
  title.append_attribute("id") = id.c_str();
  for (const char* name : {"role", "aria-labelledby", "aria-label"}) svg.remove_attribute(name);
  svg.append_attribute("role") = "img";
  svg.append_attribute("aria-labelledby") = id.c_str();
  std::ostringstream out;
  svg.print(out, "", pugi::format_raw);
  made.markup = out.str();
  return made;
}

}  // namespace breccia::report
