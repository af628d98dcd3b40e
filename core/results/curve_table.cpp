// SPDX-License-Identifier: BSD-3-Clause
#include "results/curve_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "breccia/utf8.hpp"

namespace breccia {

std::string header_name(const Column& c) { return ResultName(c.name, c.unit).key(); }

std::filesystem::path curve_units_file(std::filesystem::path curves) { return curves.replace_extension(".json"); }

// As data: a header that joins name and unit cannot be taken apart again.
void write_units(const std::filesystem::path& table, const std::vector<Column>& columns) {
  Json described = Json::array();
  for (const Column& c : columns) {
    described.push_back({{"header", header_name(c)}, {"name", c.name}, {"unit", c.unit}, {"doc", c.doc}});
    if (!c.role.empty()) described.back()["role"] = c.role;
  }
  write_file(curve_units_file(table), json_text(described, 1) + "\n");
}

std::size_t CurveTable::add(Column column) {
  BRECCIA_ASSERT(!file_);
  if (!index_.emplace(column.name, columns_.size()).second)
    throw UserError("two plugins of the workflow both write the curve `" + column.name + "`: remove one of them");
  columns_.push_back(std::move(column));
  values_.emplace_back();
  current_.push_back(std::numeric_limits<double>::quiet_NaN());
  return columns_.size() - 1;
}

void CurveTable::set(std::size_t column, double value) { current_.at(column) = value; }

std::span<const double> CurveTable::column(std::string_view name) const {
  if (const auto it = index_.find(name); it != index_.end()) return values_[it->second];
  std::string known;
  for (const auto& [key, at] : index_) known += (known.empty() ? "" : ", ") + key;
  throw UserError(fmt::format("there is no curve `{}`; the curves of this workflow are {}", name, known));
}

void CurveTable::open(const std::filesystem::path& path) {
  write_units(path, columns_);
  file_ = std::make_unique<AtomicFile>(path, true);
  std::string line;
  for (const Column& c : columns_) line += (line.empty() ? "" : ",") + header_name(c);
  file_->write(line + "\n");
}

void CurveTable::end_row() {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    values_[c].push_back(current_[c]);
    current_[c] = std::numeric_limits<double>::quiet_NaN();
  }
  if (!file_) {
    ++rows_;
    return;
  }
  try {
    write_row(rows_);
    if (++rows_ % 20 == 0) file_->flush();
  } catch (...) {
    failed_ = std::current_exception();
    throw;
  }
}

void CurveTable::write_row(std::size_t row) {
  std::string line;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (c) line += ',';
    if (std::isfinite(values_[c][row])) line += fmt::format("{}", values_[c][row]);
  }
  file_->write(line + "\n");
}

void CurveTable::archive(Archive& archive) {
  BRECCIA_ASSERT(file_);
  std::uint64_t rows = rows_;
  archive("rows", rows);
  std::vector<std::string> names, own;
  for (const Column& c : columns_) own.push_back(header_name(c));
  names = own;
  archive("names", names);
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (archive.reading()) values_[c].resize(rows);
    const auto there = std::find(names.begin(), names.end(), own[c]);  // a run that branches off may measure less
    if (there == names.end()) throw UserError("the checkpoint has no curve `" + own[c] + "`, which this run has");
    archive("column_" + std::to_string(there - names.begin()), Strided<double>(values_[c]));
  }
  if (!archive.reading()) return;
  for (rows_ = 0; rows_ < rows; ++rows_) write_row(rows_);
  file_->flush();
}

/// A row that was written in part is not to be followed by others.
void CurveTable::close() {
  if (failed_) std::rethrow_exception(failed_);
  file_->commit();
  file_.reset();
}

}  // namespace breccia
