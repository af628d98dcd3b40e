// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/plugin_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "breccia/contact_law.hpp"
#include "breccia/output.hpp"
#include "breccia/packing.hpp"
#include "breccia/postprocessor.hpp"
#include "breccia/protocol.hpp"
#include "breccia/renderer.hpp"
#include "breccia/search.hpp"
#include "hash/sha256.hpp"
#include "plugin/elf_probe.hpp"

namespace fs = std::filesystem;

namespace breccia {

namespace {

constexpr std::string_view prefix = "breccia_", suffix = ".so";
constexpr const char* rebuild = "rebuild the plugin against this Breccia's SDK";

constexpr std::size_t chunk = std::size_t(1) << 16;  // of reading [bytes]

FileStamp stamp_of(const fs::path& file) {
  struct stat about {};
  if (stat(file.c_str(), &about) != 0) return {};
  return {std::uint64_t(about.st_dev), std::uint64_t(about.st_ino), std::uint64_t(about.st_size),
          std::int64_t(about.st_mtim.tv_sec), std::int64_t(about.st_mtim.tv_nsec)};
}

std::vector<std::byte> read_file(const fs::path& file) {
  const auto refuse = [&](const std::string& why) {
    return UserError(fmt::format("plugin {} cannot be read: {}", file.string(), why));
  };
  // Opening a pipe or a device could block for ever: look before.
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) throw refuse("there is no such file");
  if (error) throw refuse(error.message());
  if (fs::is_directory(status)) throw refuse("it is a folder");
  if (!fs::is_regular_file(status)) throw refuse("it is not an ordinary file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!stream) throw refuse(std::strerror(errno));
  std::vector<std::byte> bytes;
  bytes.reserve(fs::file_size(file, error) + chunk);
  for (std::size_t got = 1; got > 0;) {
    const std::size_t old = bytes.size();
    bytes.resize(old + chunk);
    got = std::fread(bytes.data() + old, 1, bytes.size() - old, stream.get());
    bytes.resize(old + got);
  }
  if (std::ferror(stream.get())) throw refuse(std::strerror(errno));
  return bytes;
}

void agree(const std::string& file, const char* what, const std::string& found, const std::string& needed) {
  if (found != needed)
    throw UserError(fmt::format("plugin {} has {} {}, this program needs {}: {}", file, what, found, needed, rebuild));
}

/// The descriptor, as far as it is plain numbers; its pointers are still to be looked up.
BrecciaPluginDescriptor read_descriptor(const ElfProbe& elf, const ElfProbe::Symbol& symbol, const std::string& file) {
  BrecciaPluginDescriptor d{};
  constexpr std::size_t head = offsetof(BrecciaPluginDescriptor, compiler);  // never changes place
  const auto begin = elf.constant(symbol.address, head);
  if (begin.empty() || std::memcmp(begin.data(), "BRECCIA", sizeof d.magic) != 0)
    throw UserError(
        fmt::format("plugin {} has a `breccia_plugin` that is not a Breccia descriptor: declare the "
                    "plugin with BRECCIA_PLUGIN or BRECCIA_CONTACT_LAW",
                    file));
  std::memcpy(&d, begin.data(), head);
  agree(file, "SDK ABI", std::to_string(d.sdk_abi), std::to_string(BRECCIA_SDK_ABI));
  agree(file, "a descriptor of", fmt::format("{} bytes", d.descriptor_size), fmt::format("{} bytes", sizeof d));
  const auto all = elf.constant(symbol.address, sizeof d);
  if (all.empty()) throw UserError(fmt::format("plugin {} has a descriptor that is cut short: {}", file, rebuild));
  std::memcpy(&d, all.data(), sizeof d);
  return d;
}

}  // namespace

const std::vector<std::string>& plugin_kinds() {
  static const std::vector<std::string> kinds = {Packing::kind, ContactLaw::kind, Protocol::kind, Postprocessor::kind,
                                                 Output::kind,  Renderer::kind,   Search::kind};
  return kinds;
}

std::string plugin_file_name(const PluginKey& key) {
  return fmt::format("{}{}.{}{}", prefix, key.kind, key.name, suffix);
}

std::optional<PluginKey> key_of_file_name(const fs::path& file) {
  const std::string whole = file.filename().string();
  if (!whole.starts_with(prefix) || !whole.ends_with(suffix) || whole.size() <= prefix.size() + suffix.size())
    return std::nullopt;
  const std::string middle = whole.substr(prefix.size(), whole.size() - prefix.size() - suffix.size());
  const std::size_t dot = middle.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == middle.size()) return std::nullopt;
  return PluginKey{middle.substr(0, dot), middle.substr(dot + 1)};
}

std::string PluginInfo::sha256() const {
  const std::vector<std::byte> bytes = stamp_of(file) == stamp ? read_file(file) : std::vector<std::byte>();
  if (bytes.empty() || stamp_of(file) != stamp)
    throw UserError(fmt::format("the plugin {} was changed or removed after this program had loaded it: start again",
                                file.string()));
  return breccia::sha256(bytes);
}

PluginInfo inspect_plugin(const fs::path& path) {
  const FileStamp stamp = stamp_of(path);
  const std::vector<std::byte> bytes = read_file(path);
  const std::string file = path.string();
  const ElfProbe elf(bytes, file);
  const auto symbol = elf.exported_object("breccia_plugin");
  if (!symbol)
    throw UserError(
        fmt::format("{} is not a Breccia plugin: it does not export `breccia_plugin`; end its source with "
                    "BRECCIA_PLUGIN or BRECCIA_CONTACT_LAW",
                    file));
  const BrecciaPluginDescriptor d = read_descriptor(elf, *symbol, file);
  const auto text = [&](std::size_t offset) { return elf.text(symbol->address + offset).value_or(""); };
  const auto in_ticks = [&](std::size_t offset) { return fmt::format("`{}`", text(offset)); };
  agree(file, "the compiler", in_ticks(offsetof(BrecciaPluginDescriptor, compiler)), "`" BRECCIA_COMPILER_ABI "`");
  agree(file, "the standard library", in_ticks(offsetof(BrecciaPluginDescriptor, standard_library)),
        "`" BRECCIA_STDLIB_ABI "`");
  const auto size = [&](const char* type, std::uint32_t found, std::size_t needed) {
    const std::string what = fmt::format("{} of", type);
    agree(file, what.c_str(), fmt::format("{} bytes", found), fmt::format("{} bytes", needed));
  };
  size("JSON values", d.size_of_json, sizeof(Json));
  size("strings", d.size_of_string, sizeof(std::string));
  size("vectors", d.size_of_vec3, sizeof(Vec3));
  size("parameter specifications", d.size_of_param_spec, sizeof(ParamSpec));

  const PluginKey key{text(offsetof(BrecciaPluginDescriptor, kind)), text(offsetof(BrecciaPluginDescriptor, name))};
  const auto& kinds = plugin_kinds();
  if (std::find(kinds.begin(), kinds.end(), key.kind) == kinds.end())
    throw UserError(fmt::format("plugin {} is of the kind `{}`, which this program does not know; it knows: {}", file,
                                key.kind, fmt::join(kinds, ", ")));
  if (key.name.empty()) throw UserError(fmt::format("plugin {} has no name in its descriptor", file));
  if (elf.pointer(symbol->address + offsetof(BrecciaPluginDescriptor, factory)) == 0)
    throw UserError(
        fmt::format("plugin {} has no factory in its descriptor: declare the plugin with BRECCIA_PLUGIN or "
                    "BRECCIA_CONTACT_LAW",
                    file));
  return {key, text(offsetof(BrecciaPluginDescriptor, version)), path, stamp};
}

}  // namespace breccia
