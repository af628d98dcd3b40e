// SPDX-License-Identifier: BSD-3-Clause
#include "suggest.hpp"

#include <algorithm>
#include <numeric>

namespace breccia::pictures {
namespace {

/// Levenshtein's distance.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::size_t> nearest_of(const std::string& name, const std::vector<std::string>& names) {
  std::optional<std::size_t> nearest;
  std::size_t least = 2 + name.size() / 3;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (const std::size_t d = edits(name, names[k]); d < least) {
      least = d;
      nearest = k;
    }
  return nearest;
}

std::string first_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t k = 0; k < std::min(names.size(), most); ++k) text.append(k ? ", " : "").append(names[k]);
  return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

}  // namespace breccia::pictures
