// SPDX-License-Identifier: BSD-3-Clause
#include "config/yaml_syntax.hpp"

#include <algorithm>
#include <cctype>

namespace breccia {

namespace {

std::string_view stripped(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t") - first + 1);
}

bool is_blank(std::string_view line) { return stripped(line).empty() || stripped(line).front() == '#'; }

/// The line at or before `number` that looks like `key:value`, or a word without a colon; npos when none does.
std::size_t line_without_colon(const SourceText& source, std::size_t number) {
  for (std::size_t looked = 0, k = number + 1; looked < 2 && k-- > 0;) {
    const std::string_view line = stripped(source.line(k));
    if (is_blank(line)) continue;
    ++looked;
    const bool has_key = line.find(": ") != std::string_view::npos || line.back() == ':' || line.front() == '-' ||
                         line.find(" #") != std::string_view::npos ||
                         line.find_first_of("[]{}\"'") != std::string_view::npos;
    if (!has_key) return k;
  }
  return std::string_view::npos;
}

}  // namespace

std::string with_space_after_colon(std::string_view key) {
  const std::size_t colon = key.find(':');
  if (colon == std::string_view::npos || colon == 0 || colon + 1 == key.size()) return {};
  for (const char c : key.substr(0, colon))
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return {};
  return std::string(key.substr(0, colon + 1)) + " " + std::string(key.substr(colon + 1));
}

Finding explain_syntax(const SourceText& source, std::size_t offset, const std::string& message) {
  const Place place = source.place(offset);
  const auto has = [&](const char* text) { return message.find(text) != std::string::npos; };
  const std::string_view here = source.text().substr(std::min(offset, source.text().size()));
  if (has("illegal map value") || has("end of map not found")) {
    const std::size_t number = source.line_of(offset), bad = line_without_colon(source, number);
    if (bad != std::string_view::npos) {
      const std::string_view line = stripped(source.line(bad));
      const Place at = source.place(source.line_start(bad) + source.line(bad).find_first_not_of(" \t"));
      if (const std::string better = with_space_after_colon(line); !better.empty())
        return {at, "", "a space is missing after the colon: write `" + better + "`"};
      return {at, "", "`" + std::string(line.substr(0, 60)) + "` has no colon; a line reads `name: value`"};
    }
    if (has("illegal map value") && !here.empty() && here.front() == ':')
      return {place, "", "a second `: ` in one line; put the value in quotes, or begin a new line"};
    return {place, "", "this line does not fit what stands above it; check its indentation"};
  }
  if (has("end of sequence flow not found")) return {place, "", "a list opened with `[` is not closed before here"};
  if (has("end of map flow not found")) return {place, "", "a mapping opened with `{` is not closed before here"};
  if (has("illegal flow end")) return {place, "", "a closing bracket that nothing opened"};
  if (has("illegal block entry") || has("end of sequence not found"))
    return {place, "", "a list item (`- `) does not fit what stands above it; check its indentation"};
  if (has("unknown token") && !here.empty())
    return {place, "", "a value cannot begin with `" + std::string(here.substr(0, 1)) + "`; put it in quotes"};
  if (has("anchor is not defined"))
    return {place, "", "the alias refers to an anchor (`&name`) that is not defined above it"};
  if (has("unknown escape"))
    return {source.place(source.text().rfind('\\', offset)), "",
            "an unknown escape in a text with double quotes; single quotes take it as it is"};
  if (has("bad file")) return {place, "", "lists and mappings are nested too deeply"};
  return {place, "", "not valid YAML: " + message};
}

}  // namespace breccia
