// SPDX-License-Identifier: BSD-3-Clause
/// curves.csv: one row per sample, columns from the core, the protocol and the post-processors.
#pragma once

#include <exception>
#include <map>
#include <memory>

#include "breccia/archive.hpp"
#include "breccia/atomic_file.hpp"
#include "breccia/services.hpp"

namespace breccia {

/// Name as it stands in the CSV header: with the unit, unless a pure number ("axial_stress_Pa").
std::string header_name(const Column& column);

/// Beside `curves.csv` the file `curves.json`: header, name, SI unit, meaning and role of each column.
std::filesystem::path curve_units_file(std::filesystem::path curves);
/// Writes that file: header, name, unit and meaning of each column.
void write_units(const std::filesystem::path& table, const std::vector<Column>& columns);

class CurveTable final : public Recorder, public Curves {
 public:
  std::size_t add(Column column) override;
  void set(std::size_t column, double value) override;
  const std::vector<Column>& columns() const override { return columns_; }
  std::span<const double> column(std::string_view name) const override;
  std::size_t rows() const override { return rows_; }

  /// Writes the file of the units, and starts that of the curves; no column can be added afterwards.
  void open(const std::filesystem::path& path);
  /// Ends the current row and writes it, where there is a file; columns that nobody set are NaN (empty in the file).
  void end_row();
  void close();                    ///< the file takes its final name
  void archive(Archive& archive);  ///< the rows; read after `open`, they are written to the file anew

 private:
  void write_row(std::size_t row);

  std::vector<Column> columns_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::vector<std::vector<double>> values_;
  std::vector<double> current_;
  std::size_t rows_ = 0;
  std::unique_ptr<AtomicFile> file_;
  std::exception_ptr failed_;  ///< why a row could not be written
};

}  // namespace breccia
