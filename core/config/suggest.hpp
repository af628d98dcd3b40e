// SPDX-License-Identifier: BSD-3-Clause
/// "Did you mean": the known name nearest to what was written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace breccia {

/// Insertions, deletions, substitutions and swaps of neighbours that turn one into the other, letter case ignored
/// (optimal string alignment, a form of the Damerau-Levenshtein distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The nearest of `known` if it is near enough to be meant, the first of several equally near; else the only one that
/// has all words of what was written; else empty.
std::string closest(std::string_view written, const std::vector<std::string>& known);

/// "`a`, `b`, `c`"; long lists end in "and N more".
std::string list_of(const std::vector<std::string>& names, std::size_t at_most = 12);

/// "; did you mean `x`?" or, when nothing is near, "; known here: `a`, `b`". Empty without known names.
std::string suggestion(std::string_view written, const std::vector<std::string>& known);

}  // namespace breccia
