// SPDX-License-Identifier: BSD-3-Clause
#include "config/unit_patterns.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "breccia/error.hpp"
#include "config/unit_dimension.hpp"

namespace breccia {

namespace {

/// Words of one dimension.
struct Words {
  const char *si, *pattern;
  int least, most;   ///< powers that occur
  bool with_others;  ///< as a factor of a product
  bool one_of_them;  ///< of these a product has one at the most
};

constexpr Words words[] = {
    {"m", "(?:(?:[fpnudcmhkM]|da|\u00B5|\u03BC)?m|in|inch|ft|yd)", -4, 4, true, false},
    {"s", "(?:(?:[fpnumk]|\u00B5|\u03BC)?s|min|h|hr|d|day)", -3, 2, true, false},
    {"kg", "(?:(?:[pnumkM]|\u00B5|\u03BC)?g|t|lb)", -1, 1, true, true},
    {"N", "(?:(?:[numkMG]|\u00B5|\u03BC)?N|lbf|kgf)", -1, 1, true, true},
    {"Pa", "(?:(?:[numhkMGT]|\u00B5|\u03BC)?Pa|[kM]?psi|ksi|[mkM]?bar|atm)", -1, 1, true, true},
    {"J", "(?:(?:[numkMGT]|\u00B5|\u03BC)?J)", -1, 1, true, true},
    {"W", "(?:(?:[numkMG]|\u00B5|\u03BC)?W)", -1, 1, true, true},
    {"rad", "(?:(?:[mu]|\u00B5|\u03BC)?rad|deg|\u00B0)", -2, 2, true, false},
    {"K", "(?:[mu]?K|degC|degF|\u00B0C|\u00B0F)", -1, 1, true, false},
    {"A", "(?:[umk]?A)", -1, 1, true, false},
    {"Hz", "(?:[mkMGT]?Hz)", -1, 1, false, false},
    {"rpm", "rpm", 1, 1, false, false},
    {"liter", "(?:[umcdh]?[lL])", -1, 1, false, false},
    {"%", "(?:%|ppm)", 1, 1, false, false},
};

struct Factor {
  const Words* of;
  units::Dimension dimension;
};
const std::vector<Factor>& factors() {
  static const std::vector<Factor> all = [] {
    std::vector<Factor> list;
    for (const Words& w : words) {
      const auto unit = units::find_unit(w.si);
      BRECCIA_ASSERT(unit && "the words are of a unit that exists");
      list.push_back({&w, unit->dimension});
    }
    return list;
  }();
  return all;
}

struct Term {
  const Words* of;
  int power;
};
using Terms = std::vector<Term>;

units::Dimension times(units::Dimension product, const Factor& factor, int power) {
  for (const auto& [basic, count] : factor.dimension) product[basic] += power * count;
  std::erase_if(product, [](const auto& entry) { return entry.second == 0; });
  return product;
}

/// Adds to `found` all products of `terms` and up to `more` factors, the first of them `from` or behind it, that have
/// the dimension.
void look(const units::Dimension& wanted, const units::Dimension& so_far, Terms& terms, std::size_t from, int more,
          std::vector<Terms>& found) {
  if (!terms.empty() && so_far == wanted) {
    found.push_back(terms);
    return;  // whatever more cancels out again
  }
  if (more == 0) return;
  for (std::size_t k = from; k < factors().size(); ++k) {
    const Factor& f = factors()[k];
    const auto clashes = [&](const Term& t) {
      return !t.of->with_others || !f.of->with_others || (t.of->one_of_them && f.of->one_of_them);
    };
    if (std::any_of(terms.begin(), terms.end(), clashes)) continue;
    for (int power = f.of->least; power <= f.of->most; ++power) {
      if (power == 0) continue;
      terms.push_back({f.of, power});
      look(wanted, times(so_far, f, power), terms, k + 1, more - 1, found);
      terms.pop_back();
    }
  }
}

/// `m2`, `m^2`, `s-1`
std::string with_power(const Words& of, int power) {
  return power == 1 ? of.pattern : of.pattern + std::string("(?:\\^|\\*\\*)?") + std::to_string(power);
}

constexpr const char *times_sign = "(?: *[.*] *| +|-)", *by_sign = " */ *";

std::string first_term(const Term& t) {
  if (t.power > 0) return with_power(*t.of, t.power);
  return std::string("(?:1") + by_sign + with_power(*t.of, -t.power) + "|" + with_power(*t.of, t.power) + ")";
}
std::string next_term(const Term& t) {
  if (t.power > 0) return times_sign + with_power(*t.of, t.power);
  const std::string twice = t.power == -2 ? std::string("|") + by_sign + t.of->pattern + by_sign + t.of->pattern : "";
  return std::string("(?:") + by_sign + with_power(*t.of, -t.power) + "|" + times_sign + with_power(*t.of, t.power) +
         twice + ")";
}

/// In each order in which those above the line come before those below.
void add_orders(Terms terms, std::string& pattern) {
  const auto before = [](const Term& a, const Term& b) {
    return std::pair(a.power < 0, a.of) < std::pair(b.power < 0, b.of);
  };
  std::sort(terms.begin(), terms.end(), before);
  do {
    const auto below = std::find_if(terms.begin(), terms.end(), [](const Term& t) { return t.power < 0; });
    if (std::any_of(below, terms.end(), [](const Term& t) { return t.power > 0; })) continue;
    pattern += (pattern.empty() ? "" : "|") + first_term(terms.front());
    for (std::size_t k = 1; k < terms.size(); ++k) pattern += next_term(terms[k]);
  } while (std::next_permutation(terms.begin(), terms.end(), before));
}

/// One word over another of its dimension: `mm/m`.
void add_ratios(std::string& pattern) {
  for (const Factor& f : factors())
    if (f.of->with_others) pattern += std::string("|") + f.of->pattern + by_sign + f.of->pattern;
}

}  // namespace

std::string unit_pattern(const std::string& si_unit) {
  const auto unit = units::find_unit(si_unit);
  BRECCIA_ASSERT(unit && "the schema names a unit that exists");
  std::vector<Terms> products;
  Terms none;
  look(unit->dimension, {}, none, 0, 3, products);
  std::string pattern;
  for (const Terms& terms : products) add_orders(terms, pattern);
  if (unit->dimension.empty()) add_ratios(pattern);
  const std::string not_judged =
      "(?![0-9.,_'+*/-])(?:[^\\n]*(?:\\(|[a-z]{5})[^\\n]*|[^\\s./*]+(?:[ ./*]+[^\\s./*]+){3,})";
  return "(?:" + pattern + (pattern.empty() ? "" : "|") + not_judged + ")";
}

}  // namespace breccia
