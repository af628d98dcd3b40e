// SPDX-License-Identifier: BSD-3-Clause
/// Curves and summary that are kept in memory: of trials and tests, which look at them afterwards.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "breccia/services.hpp"

namespace breccia {

class KeptCurves final : public Recorder, public Curves {
 public:
  std::size_t add(Column column) override {
    for (const Column& c : columns_)
      if (c.name == column.name) throw UserError("two curves are called `" + c.name + "`");
    columns_.push_back(std::move(column));
    values_.emplace_back();
    return columns_.size() - 1;
  }
  void set(std::size_t column, double value) override { values_.at(column).push_back(value); }
  const std::vector<Column>& columns() const override { return columns_; }
  std::span<const double> column(std::string_view name) const override {
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (columns_[k].name == name) return values_[k];
    throw UserError("there is no curve called `" + std::string(name) + "`");
  }
  std::size_t rows() const override { return values_.empty() ? 0 : values_[0].size(); }

  /// Where rows are counted: what nobody has set is no number, of what was set twice the last one counts.
  void end_row() {
    ++ended_;
    for (auto& v : values_) {
      if (v.size() < ended_) v.push_back(std::numeric_limits<double>::quiet_NaN());
      v[ended_ - 1] = v.back();
      v.resize(ended_);
    }
  }
  const std::vector<double>& values(std::size_t column) const { return values_.at(column); }
  double last(std::string_view name) const { return column(name).back(); }
  void add_column(const std::string& name, std::vector<double> values) {
    add({name, "1", "", std::string(role::of_name(name))});
    values_.back() = std::move(values);
  }

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<double>> values_;
  std::size_t ended_ = 0;
};

class KeptSummary final : public Summary {
 public:
  void headline(const ResultName& name, Json value) override {
    note(name, value);
    if (!headlines.emplace(name.key(), std::move(value)).second)
      throw std::logic_error("headline given twice: " + name.key());
  }
  void own(const ResultName& name, Json value) override {
    const std::string key = name.key();
    if (!given_.insert(key).second) throw std::logic_error("key given twice: " + key);
    note(name, value);
    const std::size_t dot = key.find('.');
    if (dot == key.npos) owned[key] = std::move(value);
    else owned[key.substr(0, dot)][Json::json_pointer(pointer(key.substr(dot)))] = std::move(value);
  }
  void table(Table table) override {
    const std::string name = table.name;
    if (!tables.emplace(name, std::move(table)).second) throw std::logic_error("table given twice: " + name);
  }
  std::map<std::string, Json> headlines, owned;  ///< the second with a mapping for each section
  std::map<std::string, Json> all;               ///< by dotted key
  std::map<std::string, Table> tables;
  std::vector<ResultName> names;  ///< in the order in which they came

 private:
  void note(const ResultName& name, const Json& value) {
    names.push_back(name);
    all[name.key()] = value;
  }
  static std::string pointer(std::string dotted) {
    for (char& c : dotted) c = c == '.' ? '/' : c;
    return dotted;
  }
  std::set<std::string> given_;
};

}  // namespace breccia
