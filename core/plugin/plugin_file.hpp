// SPDX-License-Identifier: BSD-3-Clause
/// What a plugin file says of itself, read and checked without running any of its code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace breccia {

struct PluginKey {
  std::string kind, name;
  auto operator<=>(const PluginKey&) const = default;
};

/// Tells whether a file was changed or replaced since.
struct FileStamp {
  std::uint64_t device = 0, number = 0, size = 0;
  std::int64_t seconds = 0, nanoseconds = 0;  ///< of the last change
  bool operator==(const FileStamp&) const = default;
};

struct PluginInfo {
  PluginKey key;
  std::string version;  ///< the author's; shown, never compared
  std::filesystem::path file;
  FileStamp stamp;

  /// Of the whole file, 64 hexadecimal digits. UserError when it is not the one that was inspected any more: what a run
  /// says of its plugins must be what it has loaded.
  std::string sha256() const;
};

/// The kinds that this program knows, in the order in which a workflow uses them.
const std::vector<std::string>& plugin_kinds();

/// `breccia_<kind>.<name>.so`: how a file must be called to be found in a folder.
std::string plugin_file_name(const PluginKey& key);
/// The inverse; empty when the file name has another form.
std::optional<PluginKey> key_of_file_name(const std::filesystem::path& file);

/// Reads the file and does the handshake: it must be a whole shared library for this machine whose descriptor
/// (`breccia/plugin.hpp`) agrees with the SDK that this program was built with. UserError names the file, what was
/// found, what was needed and what to do.
PluginInfo inspect_plugin(const std::filesystem::path& file);

}  // namespace breccia
