// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/elf_probe.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "breccia/error.hpp"

namespace breccia {

namespace {

#if defined(__x86_64__)
constexpr Elf64_Half this_machine = EM_X86_64;
constexpr const char* machine_name = "64-bit x86";
constexpr std::uint32_t relocation_relative = R_X86_64_RELATIVE, relocation_symbol = R_X86_64_64;
#elif defined(__aarch64__)
constexpr Elf64_Half this_machine = EM_AARCH64;
constexpr const char* machine_name = "64-bit ARM";
constexpr std::uint32_t relocation_relative = R_AARCH64_RELATIVE, relocation_symbol = R_AARCH64_ABS64;
#else
#error "name this machine's ELF constants here"
#endif

[[noreturn]] void incomplete(const std::string& file, std::size_t has, std::uint64_t needs) {
  throw UserError(fmt::format("{} is incomplete: it has {} bytes and its own headers need {}; copy or build it again",
                              file, has, needs));
}

/// `T`s copied out of the file, which need not be aligned.
template <class T>
std::vector<T> copy_table(std::span<const std::byte> bytes) {
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

}  // namespace

ElfProbe::ElfProbe(std::span<const std::byte> bytes, const std::string& file) : bytes_(bytes) {
  if (bytes.empty()) throw UserError(file + " is empty; copy or build it again");
  if (bytes.size() < SELFMAG || std::memcmp(bytes.data(), ELFMAG, SELFMAG) != 0)
    throw UserError(file + " is not a shared library: it does not begin like one (ELF)");
  const auto damaged = [&] {
    throw UserError(file + " is damaged: its headers make no sense; copy or build it again");
  };
  const auto whole = [&](std::uint64_t offset, std::uint64_t size) {
    if (size > UINT64_MAX - offset) damaged();
    if (offset + size > bytes.size()) incomplete(file, bytes.size(), offset + size);
    return bytes.subspan(offset, size);
  };
  const auto header = copy_table<Elf64_Ehdr>(whole(0, sizeof(Elf64_Ehdr)))[0];
  const bool native = std::endian::native == std::endian::little;
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_ident[EI_DATA] != (native ? ELFDATA2LSB : ELFDATA2MSB) ||
      header.e_machine != this_machine)
    throw UserError(fmt::format("{} was built for another machine; this one is {}", file, machine_name));
  if (header.e_type != ET_DYN) throw UserError(file + " is not a shared library but an object file or a program");
  // The section headers stand at the end: without them a file that was cut short cannot be told from a whole one.
  if (header.e_shnum == 0 || header.e_shentsize != sizeof(Elf64_Shdr) || header.e_phentsize != sizeof(Elf64_Phdr))
    throw UserError(file + " has no section headers, so that it cannot be checked; build it without removing them");

  const auto sections =
      copy_table<Elf64_Shdr>(whole(header.e_shoff, std::uint64_t(header.e_shnum) * sizeof(Elf64_Shdr)));
  // A tail that was lost leaves zeros where the names of the sections should be.
  if (header.e_shstrndx >= sections.size() || sections[header.e_shstrndx].sh_type != SHT_STRTAB) damaged();
  segments_ = copy_table<Elf64_Phdr>(whole(header.e_phoff, std::uint64_t(header.e_phnum) * sizeof(Elf64_Phdr)));
  for (const Elf64_Phdr& segment : segments_) whole(segment.p_offset, segment.p_filesz);
  for (const Elf64_Shdr& section : sections) {
    if (section.sh_type == SHT_NOBITS || section.sh_type == SHT_NULL) continue;
    const auto content = whole(section.sh_offset, section.sh_size);
    if (section.sh_type == SHT_RELA && (section.sh_flags & SHF_ALLOC)) {
      const auto some = copy_table<Elf64_Rela>(content);
      relocations_.insert(relocations_.end(), some.begin(), some.end());
    } else if (section.sh_type == SHT_DYNSYM && section.sh_link < sections.size()) {
      symbols_ = copy_table<Elf64_Sym>(content);
      const Elf64_Shdr& strings = sections[section.sh_link];
      const auto names = whole(strings.sh_offset, strings.sh_size);
      names_.assign(reinterpret_cast<const char*>(names.data()), names.size());
    }
  }
}

std::optional<ElfProbe::Symbol> ElfProbe::exported_object(const std::string& name) const {
  for (const Elf64_Sym& s : symbols_) {
    if (s.st_shndx == SHN_UNDEF || ELF64_ST_TYPE(s.st_info) != STT_OBJECT || s.st_name >= names_.size()) continue;
    if (name == names_.c_str() + s.st_name) return Symbol{s.st_value, s.st_size};
  }
  return std::nullopt;
}

std::span<const std::byte> ElfProbe::constant(std::uint64_t address, std::uint64_t size) const {
  for (const Elf64_Phdr& s : segments_) {
    if (s.p_type != PT_LOAD || address < s.p_vaddr || address - s.p_vaddr >= s.p_filesz) continue;
    const std::uint64_t at = address - s.p_vaddr;
    if (size <= s.p_filesz - at) return bytes_.subspan(s.p_offset + at, size);
  }
  return {};
}

std::uint64_t ElfProbe::pointer(std::uint64_t address) const {
  for (const Elf64_Rela& r : relocations_) {
    if (r.r_offset != address) continue;
    if (ELF64_R_TYPE(r.r_info) == relocation_relative) return std::uint64_t(r.r_addend);
    const std::uint64_t symbol = ELF64_R_SYM(r.r_info);
    if (ELF64_R_TYPE(r.r_info) != relocation_symbol || symbol >= symbols_.size()) return 0;
    return symbols_[symbol].st_shndx == SHN_UNDEF ? 0 : symbols_[symbol].st_value + std::uint64_t(r.r_addend);
  }
  // Packed relative relocations (DT_RELR) keep the value in place.
  const auto stored = copy_table<std::uint64_t>(constant(address, sizeof(std::uint64_t)));
  return stored.empty() ? 0 : stored[0];
}

std::optional<std::string> ElfProbe::text(std::uint64_t address) const {
  constexpr std::uint64_t longest = 256;  // names and versions; more is damage
  const std::uint64_t begin = pointer(address);
  if (begin == 0) return std::nullopt;
  std::string out;
  while (out.size() < longest) {
    const auto c = constant(begin + out.size(), 1);
    if (c.empty()) return std::nullopt;
    if (c[0] == std::byte{0}) return out;
    out += char(c[0]);
  }
  return std::nullopt;
}

}  // namespace breccia
