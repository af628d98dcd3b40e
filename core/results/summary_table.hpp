// SPDX-License-Identifier: BSD-3-Clause
/// summary.json: headline numbers, what each plugin adds under its own name, and the reference values; and the tables
/// that plugins add beside it.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "breccia/services.hpp"

namespace breccia {

class SummaryTable {
 public:
  /// Of summary.json: another number when what stands in it means something else, not when something is added.
  static constexpr int format = 1;

  /// The view of it that one plugin gets; `owner` names its own section.
  class Section final : public Summary {
   public:
    Section(SummaryTable& table, std::string owner) : table_(table), owner_(std::move(owner)) {}
    void headline(const ResultName& name, Json value) override { table_.set(name, std::move(value), owner_); }
    void own(const ResultName& name, Json value) override { table_.set_below(owner_, name, std::move(value)); }
    void table(Table table) override { table_.add(std::move(table), owner_); }

   private:
    SummaryTable& table_;
    std::string owner_;
  };

  /// UserError when two owners set one key: the workflow then lists two plugins for the same thing.
  void set(const ResultName& name, Json value, const std::string& owner = "breccia");
  /// One of the core's own numbers that is not yet final: may be set again.
  void update(const ResultName& name, Json value) { put(name, std::move(value)); }
  void add(Table table, const std::string& owner);  ///< the same for two tables of one name
  /// With `format`; `units`: the unit of each key that has one, by its dotted name; and `values`: each number again, by
  /// its dotted name without the unit, as {value, unit}.
  Json json() const;
  /// summary.json, and for each table tables/<name>.csv with tables/<name>.json, as curves have it, in this folder.
  void write(const std::filesystem::path& folder) const;

 private:
  void put(const ResultName& name, Json value);
  void put_value(const std::string& name, const std::string& unit, const Json& value);
  void set_below(const std::string& owner, const ResultName& name, Json value);

  Json json_ = Json::object(), units_ = Json::object(), values_ = Json::object();
  std::map<std::string, std::string> owner_;
  std::vector<Table> tables_;
};

}  // namespace breccia
