// SPDX-License-Identifier: BSD-3-Clause
/// All plugins of all kinds, by the same verbs. Files are found by their names, `breccia_<kind>.<name>.so`, without
/// being opened, and loaded when first asked for. The first found wins, in this order: files and folders named by
/// `add` (the workflow's `plugins:`), the folders of BRECCIA_PLUGIN_PATH, `../lib/breccia` and `plugins` beside the
/// program. A file of any other name is never loaded from a folder; it can be named itself.
///
/// Not for several threads at a time. The plugins that it makes may outlive it.
#pragma once

#include <map>
#include <set>

#include "config/plugin_directory.hpp"
#include "plugin/library.hpp"
#include "plugin/search_path.hpp"

namespace breccia {

/// A file that looks like a plugin and is of no use, and why.
struct PluginProblem {
  std::filesystem::path file;
  std::string text;  ///< whole sentences, with the file's name
};

class Registry final : public PluginDirectory {
 public:
  explicit Registry(std::vector<PluginFolder> folders = default_plugin_folders());

  /// A file, opened at once under any name, or a folder, searched by file names. Hides what folders of the search
  /// path hold. UserError when it is absent or of no use.
  void add(const std::filesystem::path& path);

  const std::vector<std::string>& kinds() const { return plugin_kinds(); }
  /// Sorted. UserError for a kind that does not exist, here and below.
  std::vector<std::string> names(const std::string& kind) const override;
  const Documentation& documentation(const std::string& kind, const std::string& name) const override;
  Issues check(const std::string& kind, const std::string& name, const Json& config) const override;
  const PluginInfo& info(const std::string& kind, const std::string& name) const;

  /// Makes the plugin that the workflow picked; `choice.config` satisfies its documentation.
  template <class P>
  std::unique_ptr<P> create(const PluginChoice& choice) const {
    const PluginLibrary& from = library(P::kind, choice.type);
    std::unique_ptr<Plugin> plugin = from.create(choice.config);
    P* const typed = dynamic_cast<P*>(plugin.get());
    if (!typed) from.refuse_class();
    (void)plugin.release();
    return std::unique_ptr<P>(typed);
  }

  /// Loads everything that was found, and tells what could not be.
  std::vector<PluginProblem> problems() const;
  /// What the user should know although nothing failed: hidden duplicates, missing folders.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Found {
    std::filesystem::path file;
    bool added = false;   ///< by `add`, which goes before the search path
    bool by_name = true;  ///< its file name promised the key
  };

  bool scan(const PluginFolder& folder, bool added);  ///< whether it holds plugins by name
  void enter(const PluginKey& key, Found found);
  const PluginLibrary& library(const std::string& kind, const std::string& name) const;
  const PluginLibrary& load(const PluginKey& key, const Found& found) const;
  [[noreturn]] void unknown(const std::string& kind, const std::string& name) const;
  std::optional<PluginProblem> misnamed(const std::filesystem::path& file) const;

  std::vector<std::filesystem::path> searched_;
  std::map<PluginKey, Found> found_;
  std::set<std::filesystem::path> otherwise_named_;  ///< shared libraries in the folders
  std::vector<std::string> warnings_;
  mutable std::map<std::filesystem::path, std::shared_ptr<const PluginLibrary>> loaded_;
};

}  // namespace breccia
