// SPDX-License-Identifier: BSD-3-Clause
/// An archive that is kept in memory: written first, then read back, all of it or a rank's share.
#pragma once

#include <cstring>
#include <map>

#include "breccia/archive.hpp"
#include "engine/shared_lists.hpp"

namespace breccia {

class MemoryArchive : public Archive, public SharedLists {
 public:
  bool reading() const final { return reading_; }
  void read_back() { reading_ = true; }
  /// What another one was written with, to be read.
  void read_back(const MemoryArchive& other) {
    entries_ = other.entries_;
    reading_ = true;
  }
  /// The first name under which two have other bytes; empty when there is none.
  std::string difference(const MemoryArchive& other) const {
    for (const auto* both : {&entries_, &other.entries_})
      for (const auto& [name, entry] : *both) {
        const auto a = entries_.find(name), b = other.entries_.find(name);
        if (a == entries_.end() || b == other.entries_.end() || a->second.bytes != b->second.bytes) return name;
      }
    return {};
  }

 protected:
  static std::size_t size_of(archived::Element e) {
    using archived::Element;
    return e == Element::u8 || e == Element::text ? 1 : e == Element::i32 || e == Element::u32 ? 4 : 8;
  }
  void write(const std::string& path, archived::Element element, const void* data, std::size_t rows,
             std::size_t columns, std::size_t stride) override {
    const std::size_t row = columns * size_of(element);
    Entry entry{element, rows, columns, std::vector<char>(rows * row)};
    for (std::size_t k = 0; k < rows && row > 0; ++k)
      std::memcpy(entry.bytes.data() + k * row, static_cast<const char*>(data) + k * stride, row);
    if (!entries_.emplace(path, std::move(entry)).second) refuse(path, "it is written twice");
  }
  [[noreturn]] void refuse(const std::string& path, const std::string& why) const final {
    throw UserError("the archive's `" + path + "`: " + why);
  }

 private:
  struct Entry {
    archived::Element element;
    std::size_t rows, columns;
    std::vector<char> bytes;
  };
  const Entry& entry(const std::string& path, archived::Element element, std::size_t columns) const {
    const auto it = entries_.find(path);
    if (it == entries_.end()) refuse(path, "it was not written");
    if (it->second.element != element || it->second.columns != columns)
      refuse(path, "it was written as something else");
    return it->second;
  }
  ListShare wanted(const std::string& path, const Entry& from) {
    const auto share = share_of(from.rows);
    if (!share) refuse(path, "it has another length");
    return *share;
  }
  std::size_t rows(const std::string& path, archived::Element element, std::size_t columns) final {
    return wanted(path, entry(path, element, columns)).rows;
  }
  void read(const std::string& path, archived::Element element, void* data, std::size_t rows, std::size_t columns,
            std::size_t stride) final {
    const Entry& from = entry(path, element, columns);
    const ListShare share = wanted(path, from);
    if (share.rows != rows) refuse(path, "it has another length");
    const std::size_t row = columns * size_of(element);
    for (std::size_t k = 0; k < rows && row > 0; ++k)
      std::memcpy(static_cast<char*>(data) + k * stride, from.bytes.data() + (share.first + k) * row, row);
  }
  void open(const std::string&) final {}

  std::map<std::string, Entry> entries_;
  bool reading_ = false;
};

}  // namespace breccia
