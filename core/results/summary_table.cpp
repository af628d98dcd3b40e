// SPDX-License-Identifier: BSD-3-Clause
#include "results/summary_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "breccia/atomic_file.hpp"
#include "breccia/utf8.hpp"
#include "results/curve_table.hpp"

namespace breccia {

namespace {

bool is_of_numbers(const Json& value) {
  return value.is_number() || value.is_null() ||
         (value.is_array() && !value.empty() && std::all_of(value.begin(), value.end(), is_of_numbers));
}

}  // namespace

void SummaryTable::put_value(const std::string& name, const std::string& unit, const Json& value) {
  if (is_of_numbers(value)) values_[name] = {{"value", value}, {"unit", unit}};
}

void SummaryTable::put(const ResultName& name, Json value) {
  const std::string key = name.key();
  if (name.unit != "1") units_[key] = name.unit;
  put_value(name.name, name.unit, value);
  json_[key] = std::move(value);
}

void SummaryTable::set_below(const std::string& owner, const ResultName& name, Json value) {
  const std::string path = name.key();
  if (name.unit != "1") units_[owner + "." + path] = name.unit;
  put_value(owner + "." + name.name, name.unit, value);
  Json* at = &json_[owner];
  std::size_t begin = 0;
  for (std::size_t dot; (dot = path.find('.', begin)) != path.npos; begin = dot + 1)
    at = &(*at)[path.substr(begin, dot - begin)];
  (*at)[path.substr(begin)] = std::move(value);
}

Json SummaryTable::json() const {
  Json all{{"format", format}};
  all.update(json_);
  if (!units_.empty()) all["units"] = units_;
  all["values"] = values_;
  return all;
}

void SummaryTable::set(const ResultName& name, Json value, const std::string& owner) {
  const std::string key = name.key();
  const auto [it, is_new] = owner_.emplace(key, owner);
  if (!is_new)
    throw UserError("`" + it->second + "` and `" + owner + "` both report " + key +
                    " in the summary: keep one of them in the workflow");
  put(name, std::move(value));
}

void SummaryTable::add(Table table, const std::string& owner) {
  BRECCIA_ASSERT(table.columns.size() == table.values.size());
  for (const auto& column : table.values) BRECCIA_ASSERT(column.size() == table.values[0].size());
  if (std::any_of(tables_.begin(), tables_.end(), [&](const Table& t) { return t.name == table.name; }))
    throw UserError("`" + owner + "` writes the table " + table.name +
                    ", which is there already: keep one of the two "
                    "in the workflow");
  tables_.push_back(std::move(table));
}

void SummaryTable::write(const std::filesystem::path& folder) const {
  for (const Table& table : tables_) {
    std::error_code error;
    std::filesystem::create_directory(folder / "tables", error);  // not the folder: it was removed for a reason
    if (error) throw UserError("cannot make the folder " + (folder / "tables").string() + ": " + error.message());
    std::string text;
    for (const Column& c : table.columns) text += (text.empty() ? "" : ",") + header_name(c);
    for (std::size_t row = 0; row < (table.values.empty() ? 0 : table.values[0].size()); ++row) {
      text += '\n';
      for (std::size_t c = 0; c < table.values.size(); ++c)
        text += (c ? "," : "") + (std::isfinite(table.values[c][row]) ? fmt::format("{}", table.values[c][row]) : "");
    }
    const std::filesystem::path file = folder / "tables" / (table.name + ".csv");
    write_units(file, table.columns);
    write_file(file, text + "\n");
  }
  write_file(folder / "summary.json", json_text(json(), 2) + "\n");
}

}  // namespace breccia
