// SPDX-License-Identifier: BSD-3-Clause
#include "curves_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "breccia/text_file.hpp"

namespace breccia::pictures {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') cells.emplace_back();
    else if (c != '"') cells.back() += c;
  }
  return cells;
}

/// Divides "axial_stress_Pa" into name and unit; what does not end in a unit is a pure number.
Curve curve_named(const std::string& header) {
  for (const char* unit : {"Pa", "s", "m", "N", "J", "kg", "m2", "m3", "rad"})
    if (header.size() > std::char_traits<char>::length(unit) + 1 && header.ends_with(std::string("_") + unit))
      return {header.substr(0, header.size() - std::char_traits<char>::length(unit) - 1), unit, {}};
  return {header, "", {}};
}

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

CurvesFile::CurvesFile(const std::filesystem::path& file) : file_(file) {
  std::istringstream in(read_text_file(file));
  std::string line;
  if (!std::getline(in, line)) throw UserError("renderer pictures: " + file.string() + " is empty");
  headers_ = split(line);
  for (const std::string& h : headers_) curves_.push_back(curve_named(h));
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    const auto cells = split(line);
    const auto where = [&] {
      return "renderer pictures: " + file.string() + ", line " + std::to_string(number) + ": ";
    };
    if (cells.size() != headers_.size())
      throw UserError(where() + std::to_string(cells.size()) + " values for " + std::to_string(headers_.size()) +
                      " columns");
    for (std::size_t c = 0; c < cells.size(); ++c) {
      double value = std::numeric_limits<double>::quiet_NaN();  // an empty cell: not measured
      const char *begin = cells[c].data(), *end = begin + cells[c].size();
      if (begin != end && std::from_chars(begin, end, value).ptr != end)
        throw UserError(where() + "`" + cells[c] + "` is not a number");
      curves_[c].value.push_back(value);
    }
  }
}

const Curve* CurvesFile::find(const std::string& name) const {
  for (std::size_t c = 0; c < curves_.size(); ++c)
    if (headers_[c] == name || curves_[c].name == name) return &curves_[c];
  return nullptr;
}

const Curve& CurvesFile::at(const std::string& name) const {
  if (const Curve* c = find(name)) return *c;
  std::string nearest, all;
  std::size_t least = 1 + name.size() / 3;
  for (std::size_t c = 0; c < headers_.size(); ++c) {
    all.append(all.empty() ? "" : ", ").append(headers_[c]);
    const std::size_t d = std::min(edits(name, headers_[c]), edits(name, curves_[c].name));
    if (d <= least) {
      least = d;
      nearest = headers_[c];
    }
  }
  throw UserError(file_.string() + " has no column `" + name + "`; " +
                  (nearest.empty() ? "" : "did you mean `" + nearest + "`? ") + "it has: " + all);
}

}  // namespace breccia::pictures
