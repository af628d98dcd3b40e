// SPDX-License-Identifier: BSD-3-Clause
#include "drive/drive_path.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "breccia/text_file.hpp"
#include "config/suggest.hpp"

namespace breccia {
namespace {

struct ColumnOfPath {
  const char* header;
  double WayPoint::*member;
};
constexpr ColumnOfPath quantities[] = {{"normal_m", &WayPoint::normal},
                                       {"shear_m", &WayPoint::shear},
                                       {"rotation_rad", &WayPoint::rotation},
                                       {"twist_rad", &WayPoint::twist},
                                       {"time_s", &WayPoint::time}};

std::vector<std::string> cells_of(std::string line) {
  std::vector<std::string> cells;
  std::istringstream in(line + ",");
  for (std::string cell; std::getline(in, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t");
    cells.push_back(first == cell.npos ? "" : cell.substr(first, cell.find_last_not_of(" \t") - first + 1));
  }
  return cells;
}

class PathReader {
 public:
  explicit PathReader(const std::filesystem::path& file) : file_(file) {}

  DrivePath operator()() {
    std::istringstream in(read_text_file(file_));
    path_.points.emplace_back();
    for (std::string line; std::getline(in, line);) {
      ++line_;
      const std::vector<std::string> cells = cells_of(line);
      if (cells.size() == 1 && cells[0].empty()) continue;
      if (columns_.empty()) read_header(cells);
      else read_row(cells);
    }
    if (columns_.empty()) refuse("there is nothing in it; " + needed());
    if (path_.points.size() == 1) refuse("there is no way point after the start at zero");
    return std::move(path_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw UserError(file_.string() + ":" + std::to_string(std::max(line_, 1)) + ": " + what);
  }
  static std::string needed() {
    return "the first line names the columns, some of normal_m, shear_m, rotation_rad, twist_rad, and time_s if rates "
           "matter";
  }

  void read_header(const std::vector<std::string>& cells) {
    std::vector<std::string> known;
    for (const ColumnOfPath& q : quantities) known.push_back(q.header);
    for (const std::string& cell : cells) {
      const auto at = std::find(known.begin(), known.end(), cell);
      if (at == known.end())
        refuse("there is no column `" + cell + "`" +
               (std::isalpha(static_cast<unsigned char>(cell[0])) ? suggestion(cell, known) : "; " + needed()));
      const auto member = quantities[at - known.begin()].member;
      if (std::find(columns_.begin(), columns_.end(), member) != columns_.end())
        refuse("the column `" + cell + "` is there twice");
      columns_.push_back(member);
      names_.push_back(cell);
    }
    path_.timed = std::find(columns_.begin(), columns_.end(), &WayPoint::time) != columns_.end();
    if (columns_.size() == (path_.timed ? 1u : 0u)) refuse("nothing moves: " + needed());
  }

  void read_row(const std::vector<std::string>& cells) {
    if (cells.size() != columns_.size())
      refuse(std::to_string(cells.size()) + (cells.size() == 1 ? " value for " : " values for ") +
             std::to_string(columns_.size()) + (columns_.size() == 1 ? " column" : " columns"));
    WayPoint p;
    for (std::size_t k = 0; k < cells.size(); ++k) p.*columns_[k] = number(cells[k], names_[k]);
    const bool at_zero = p.normal == 0 && p.shear == 0 && p.rotation == 0 && p.twist == 0 && p.time == 0;
    if (rows_++ == 0 && at_zero) return;
    if (path_.timed && !(p.time > path_.points.back().time))
      refuse(path_.points.size() == 1
                 ? "the path starts at zero displacement at time 0: the time of this way point must be above 0"
                 : "the time must be above that of the row before");
    path_.points.push_back(p);
  }

  double number(const std::string& cell, const std::string& column) const {
    double value = 0;
    const char *begin = cell.data(), *end = begin + cell.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (cell.empty()) refuse("`" + column + "` has no value");
    if (error != std::errc() || stop != end || !std::isfinite(value))
      refuse("`" + cell + "` is not a number; `" + column +
             "` is one in the unit that its name ends with, without the unit");
    return value;
  }

  std::filesystem::path file_;
  int line_ = 0, rows_ = 0;
  std::vector<double WayPoint::*> columns_;
  std::vector<std::string> names_;
  DrivePath path_;
};

}  // namespace

DrivePath read_drive_path(const std::filesystem::path& file) { return PathReader(file)(); }

}  // namespace breccia
