// SPDX-License-Identifier: BSD-3-Clause
/// The tables that Breccia writes (curves.csv and those of tables/), read back.
#pragma once

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "breccia/text_file.hpp"

namespace breccia {

class TableFile {
 public:
  /// UserError with the line when the file is no table of numbers. An empty cell, which was not measured, is NaN.
  explicit TableFile(const std::filesystem::path& file) : file_(file) {
    std::istringstream in(read_text_file(file));
    std::string line;
    std::getline(in, line);
    headers_ = cells_of(line);
    columns_.resize(headers_.size());
    for (std::size_t number = 2; std::getline(in, line); ++number) {
      const std::vector<std::string> cells = cells_of(line);
      const std::string where = file.string() + ":" + std::to_string(number) + ": ";
      if (cells.size() != headers_.size())
        throw UserError(where + std::to_string(cells.size()) + " values for " + std::to_string(headers_.size()) +
                        " columns");
      for (std::size_t c = 0; c < cells.size(); ++c) {
        double value = std::numeric_limits<double>::quiet_NaN();
        const char* const end = cells[c].data() + cells[c].size();
        if (!cells[c].empty() && std::from_chars(cells[c].data(), end, value).ptr != end)
          throw UserError(where + "`" + cells[c] + "` is not a number");
        columns_[c].push_back(value);
      }
    }
  }

  const std::vector<std::string>& headers() const { return headers_; }
  std::size_t rows() const { return columns_.front().size(); }
  /// By its header, which ends in the unit ("axial_stress_Pa"). UserError with what there is.
  const std::vector<double>& column(const std::string& header) const {
    const auto at = std::find(headers_.begin(), headers_.end(), header);
    if (at != headers_.end()) return columns_[std::size_t(at - headers_.begin())];
    std::string known;
    for (const std::string& h : headers_) known += (known.empty() ? "`" : ", `") + h + "`";
    throw UserError(file_.string() + " has no column `" + header + "`; it has " + known);
  }
  /// In row 0, 1, ...
  double at(const std::string& header, std::size_t row) const {
    const std::vector<double>& values = column(header);
    if (row < values.size()) return values[row];
    throw UserError(file_.string() + " has " + std::to_string(values.size()) + " rows, and no row " +
                    std::to_string(row) + " counted from 0");
  }
  double last(const std::string& header) const { return at(header, rows() - 1); }

 private:
  static std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line)
      if (c == ',') cells.emplace_back();
      else cells.back() += c;
    return cells;
  }

  std::filesystem::path file_;
  std::vector<std::string> headers_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace breccia
