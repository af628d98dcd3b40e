// SPDX-License-Identifier: BSD-3-Clause
#include "config/describe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/topic.hpp"
#include "cli/verbs.hpp"

namespace breccia::cli {
namespace {

/// The plugins of a kind with what they do.
int describe_kind(const Registry& registry, const std::string& kind, const std::string& format) {
  Json all = Json::array();
  std::string text;
  for (const std::string& name : registry.names(kind)) {
    std::string summary;
    try {
      summary = registry.documentation(kind, name).summary;
    } catch (const UserError& e) { summary = std::string("of no use: ") + e.what(); }
    all.push_back({{"name", name}, {"summary", summary}});
    text += format == "markdown" ? fmt::format("- `{}/{}`: {}\n", kind, name, summary)
                                 : fmt::format("{}/{}: {}\n", kind, name, summary);
  }
  if (format == "json") fmt::print("{}\n", Json{{"kind", kind}, {"plugins", all}}.dump(2));
  else fmt::print("{}", text.empty() ? "no " + kind + " plugin was found\n" : text);
  return ok;
}

}  // namespace

int describe(const std::string& written, const std::string& format) {
  Registry registry;
  const std::vector<std::string>& kinds = registry.kinds();
  if (std::find(kinds.begin(), kinds.end(), written) != kinds.end()) return describe_kind(registry, written, format);
  const auto [kind, name, doc, origin] = topic_named(registry, written);
  if (format == "json") fmt::print("{}\n", describe_json(kind, name, doc).dump(2));
  else if (format == "markdown") fmt::print("{}", describe_markdown(kind, name, doc));
  else fmt::print("{}{}", origin, describe_text(kind, name, doc));
  return ok;
}

}  // namespace breccia::cli
