// SPDX-License-Identifier: BSD-3-Clause
#include "config/suggest.hpp"

#include <algorithm>

namespace breccia {

namespace {

std::string lower_case(std::string_view s) {
  std::string out(s);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return out;
}

/// Whether all words of `part` are among those of `whole`, words being what underscores part.
bool has_words_of(std::string_view whole, std::string_view part) {
  const auto in_underscores = [](std::string_view s) { return "_" + lower_case(s) + "_"; };
  const std::string words = in_underscores(whole), wanted = in_underscores(part);
  for (std::size_t at = 1; at < wanted.size();) {
    const std::size_t end = wanted.find('_', at);
    if (words.find(wanted.substr(at - 1, end - at + 2)) == std::string::npos) return false;
    at = end + 1;
  }
  return true;
}

}  // namespace

std::size_t edit_distance(std::string_view first, std::string_view second) {
  const std::string a = lower_case(first), b = lower_case(second);
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k) last[k] = k;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t change = a[i - 1] == b[k - 1] ? 0 : 1;
      now[k] = std::min({last[k] + 1, now[k - 1] + 1, last[k - 1] + change});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
        now[k] = std::min(now[k], before_last[k - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

std::string closest(std::string_view written, const std::vector<std::string>& known) {
  // A pathological key must not cost time: nothing that long is a slip of the pen.
  if (written.empty() || written.size() > 200) return {};
  // One slip per three letters: `mass` should not suggest `time`.
  std::size_t best = std::max<std::size_t>(1, written.size() / 3) + 1;
  std::string found;
  for (const std::string& name : known) {
    const std::size_t distance = edit_distance(written, name);
    if (distance < best && distance < name.size()) {
      best = distance;
      found = name;
    }
  }
  if (!found.empty()) return found;
  // `friction_angle` for `internal_friction_angle`, if there is only one such.
  for (const std::string& name : known) {
    if (!has_words_of(name, written)) continue;
    if (!found.empty()) return {};
    found = name;
  }
  return found;
}

std::string list_of(const std::vector<std::string>& names, std::size_t at_most) {
  std::string out;
  for (std::size_t k = 0; k < names.size() && k < at_most; ++k) out += (k ? ", `" : "`") + names[k] + "`";
  if (names.size() > at_most) out += " and " + std::to_string(names.size() - at_most) + " more";
  return out;
}

std::string suggestion(std::string_view written, const std::vector<std::string>& known) {
  if (known.empty()) return {};
  const std::string near = closest(written, known);
  return near.empty() ? "; known here: " + list_of(known) : "; did you mean `" + near + "`?";
}

}  // namespace breccia
