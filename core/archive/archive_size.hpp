// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "breccia/archive.hpp"
#include "engine/shared_lists.hpp"

namespace breccia {

/// Keeps nothing of what is written to it but how much it is.
class ArchiveSize final : public Archive, public SharedLists {
 public:
  /// `first`: of several ranks, who gives what is the same on all of them.
  explicit ArchiveSize(bool first = true) : first_(first) {}
  bool reading() const override { return false; }
  bool wants_values() const override { return false; }
  std::size_t bytes() const { return bytes_; }  ///< of a file, of lists those of this rank; rather too many

 private:
  static constexpr std::size_t of_a_name = 4096;  // what HDF5 keeps of an array beside its numbers
  void write(const std::string&, archived::Element element, const void*, std::size_t rows, std::size_t columns,
             std::size_t) override {
    using archived::Element;
    const bool small = element == Element::u8 || element == Element::text;
    if (first_ || share()) bytes_ += rows * columns * (small ? 1 : 8);
    if (first_) bytes_ += of_a_name;
  }
  std::size_t rows(const std::string&, archived::Element, std::size_t) override { return 0; }
  void read(const std::string&, archived::Element, void*, std::size_t, std::size_t, std::size_t) override {}
  void open(const std::string&) override { bytes_ += first_ ? of_a_name : 0; }
  [[noreturn]] void refuse(const std::string& path, const std::string& why) const override {
    throw UserError("no checkpoint can be made: " + path + ": " + why);
  }

  bool first_;
  std::size_t bytes_ = 0;
};

}  // namespace breccia
