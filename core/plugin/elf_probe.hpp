// SPDX-License-Identifier: BSD-3-Clause
/// Reads constants out of a shared library without loading it. Loading runs the library's static constructors, and a
/// truncated file kills the process inside dlopen (SIGBUS): both are too late to find out what a plugin is.
/// Source: System V ABI, chapters 4 and 5; AMD64 supplement, section 4.4 (relocations).
#pragma once

#include <elf.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace breccia {

class ElfProbe {
 public:
  /// `bytes` is the whole file and must outlive the probe; `file` is its name for messages.
  /// UserError when it is not a shared library for this machine, or not all of one.
  ElfProbe(std::span<const std::byte> bytes, const std::string& file);

  struct Symbol {
    std::uint64_t address;  ///< as linked, before loading
    std::uint64_t size;     // [bytes]
  };
  /// A variable that the library defines and exports.
  std::optional<Symbol> exported_object(const std::string& name) const;

  /// `size` constant bytes at an address as linked; empty when the file does not hold them.
  std::span<const std::byte> constant(std::uint64_t address, std::uint64_t size) const;
  /// Where the pointer stored at `address` will point, as linked; 0 for null and for what another library defines.
  std::uint64_t pointer(std::uint64_t address) const;
  /// The C string that the pointer stored at `address` will point to.
  std::optional<std::string> text(std::uint64_t address) const;

 private:
  std::span<const std::byte> bytes_;
  std::vector<Elf64_Phdr> segments_;
  std::vector<Elf64_Sym> symbols_;
  std::vector<Elf64_Rela> relocations_;
  std::string names_;  ///< string table of the symbols
};

}  // namespace breccia
