// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "spheres.hpp"
#include "text_share.hpp"

namespace breccia::sphere_file {
namespace {

constexpr std::array<const char*, 4> names{"x", "y", "z", "radius"};
using Columns = std::array<std::optional<std::size_t>, 4>;

std::string_view trimmed(std::string_view s) {
  constexpr std::string_view blank = " \t";
  const auto first = s.find_first_not_of(blank);
  if (first == s.npos) return {};
  s = s.substr(first, s.find_last_not_of(blank) - first + 1);
  if (s.size() >= 2 && s.front() == '"' && s.back() == '"') s = s.substr(1, s.size() - 2);
  return s;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0;;) {
    const auto end = line.find(separator, at);
    cells.push_back(trimmed(line.substr(at, end - at)));
    if (end == line.npos) return cells;
    at = end + 1;
  }
}

[[noreturn]] void fail(const std::filesystem::path& file, std::size_t line, const std::string& text) {
  throw UserError(file.string() + ", line " + std::to_string(line) + ": " + text);
}

Columns find_columns(const std::filesystem::path& file, std::size_t line, const std::vector<std::string_view>& header,
                     bool needs_z, std::vector<std::pair<std::string, std::size_t>>& others) {
  Columns columns;
  std::string found;
  for (std::size_t c = 0; c < header.size(); ++c) {
    found.append(c ? ", `" : "`").append(header[c]).append("`");
    const auto known = std::find(names.begin(), names.end(), header[c]);
    if (known == names.end()) {
      others.emplace_back(header[c], c);
      continue;
    }
    auto& column = columns[std::size_t(known - names.begin())];
    if (column) fail(file, line, "there are two columns `" + std::string(header[c]) + "`");
    column = c;
  }
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!columns[k] && (k != 2 || needs_z))
      fail(file, line,
           "no column `" + std::string(names[k]) +
               "`: the first line must name the columns x, y, z and "
               "radius, in any order; it names " +
               found);
  return columns;
}

std::optional<double> value_of(std::string_view text) {
  double value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (text.empty() || error != std::errc() || stop != end) return std::nullopt;
  return value;
}

double number(const std::filesystem::path& file, std::size_t line, const char* column, std::string_view text) {
  if (const auto value = value_of(text)) return *value;
  fail(file, line, std::string(column) + " is `" + std::string(text) + "`, which is not a number");
}

}  // namespace

namespace {

std::string_view without_comment(std::string_view line) {
  line = line.substr(0, line.find('#'));
  return trimmed(line).empty() ? std::string_view() : line;
}

/// Calls f(content, number) for each line that is not empty, its comment cut off.
template <class F>
void for_each_line(const TextShare& share, F&& f) {
  const std::string_view text = share.text;
  std::size_t line = share.before;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ++line;
    if (const std::string_view content = without_comment(text.substr(at, end - at)); !content.empty())
      if (!f(content, line)) return;
    at = end + 1;
  }
}

}  // namespace

Spheres read_csv(const std::filesystem::path& file, double unit, bool needs_z, const PackingRequest& request) {
  const TextShare share = read_text_share(file, request);
  // The line that names the columns is the first of all.
  std::string own_first;
  std::size_t first_line = 0, teller = 0;
  for_each_line(share, [&](std::string_view content, std::size_t line) {
    own_first = content;
    first_line = line;
    return false;
  });
  const std::string names_line = told_by_first(request.share, own_first, teller);
  if (names_line.empty())
    throw UserError(file.string() + " is empty: its first line must name the columns x, y, z and radius");
  const bool is_here = !request.share.part || std::size_t(request.share.part->number) == teller;
  char separator = ',';
  for (const char c : {',', ';', '\t'})
    if (names_line.find(c) != names_line.npos) {
      separator = c;
      break;
    }
  Spheres spheres;
  std::vector<std::pair<std::string, std::size_t>> others;
  const auto header = cells_of(names_line, separator);
  const std::size_t lines_of_first = std::size_t(request.share.max(is_here ? double(first_line) : 0));
  const Columns columns = find_columns(file, lines_of_first, header, needs_z, others);
  for (const auto& [name, cell] : others) spheres.columns.push_back({name, {}});

  for_each_line(share, [&](std::string_view content, std::size_t line) {
    if (is_here && line == first_line) return true;
    const auto cells = cells_of(content, separator);
    if (cells.size() != header.size())
      fail(file, line,
           std::to_string(cells.size()) + " values, where the first line names " + std::to_string(header.size()) +
               " columns");
    double value[4] = {0, 0, 0, 0};
    for (std::size_t k = 0; k < names.size(); ++k)
      if (columns[k]) value[k] = unit * number(file, line, names[k], cells[*columns[k]]);
    spheres.position.emplace_back(value[0], value[1], value[2]);
    spheres.radius.push_back(value[3]);
    spheres.line.push_back(line);
    for (std::size_t c = 0; c < others.size(); ++c)
      if (const auto other = value_of(cells[others[c].second])) spheres.columns[c].second.push_back(*other);
    return true;
  });
  // A column counts where all of it, in all shares, is numbers.
  std::vector<double> missing;
  for (const auto& column : spheres.columns) missing.push_back(double(spheres.radius.size() - column.second.size()));
  request.share.max(missing);
  std::size_t c = 0;
  std::erase_if(spheres.columns, [&](const auto& column) {
    const bool is_whole = missing[c++] == 0;
    if (!is_whole) spheres.ignored.push_back(column.first);
    return !is_whole;
  });
  return spheres;
}

}  // namespace breccia::sphere_file
