// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/registry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "config/suggest.hpp"

namespace fs = std::filesystem;

namespace breccia {

namespace {

/// One name for a file, whatever links lead to it.
fs::path identity(const fs::path& file) {
  std::error_code error;
  const fs::path real = fs::canonical(file, error);
  return error ? fs::absolute(file).lexically_normal() : real;
}

/// What goes between "no such name" and "known: ...".
std::string did_you_mean(const std::string& name, const std::vector<std::string>& known) {
  const std::string guess = closest(name, known);
  return guess.empty() ? ";" : fmt::format("; did you mean `{}`?", guess);
}

void require_kind(const std::string& kind) {
  const auto& kinds = plugin_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw UserError(fmt::format("no kind of plugin called `{}`{} known: {}", kind, did_you_mean(kind, kinds),
                                fmt::join(kinds, ", ")));
}

}  // namespace

Registry::Registry(std::vector<PluginFolder> folders) {
  for (const PluginFolder& folder : folders) {
    searched_.push_back(folder.path);
    std::error_code error;
    if (fs::is_directory(folder.path, error)) scan(folder, false);
    else if (!folder.named_by.empty())
      warnings_.push_back(fmt::format("{} names {}, which is not a folder", folder.named_by, folder.path.string()));
  }
}

void Registry::add(const fs::path& given) {
  fs::path path = fs::absolute(given).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "folder/"
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    const auto opened = std::make_shared<const PluginLibrary>(path, std::nullopt);
    loaded_.emplace(identity(path), opened);
    enter(opened->info().key, {path, true, false});
    return;
  }
  const bool any = scan({path, ""}, true);
  searched_.insert(searched_.begin(), path);
  if (any) return;
  std::string text =
      fmt::format("the folder {} holds no plugin: plugins are files named breccia_<kind>.<name>.so", path.string());
  for (const fs::path& file : otherwise_named_)
    if (file.parent_path() == path)
      if (const auto problem = misnamed(file)) text += "; " + problem->text;
  throw UserError(text);
}

bool Registry::scan(const PluginFolder& folder, bool added) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder.path, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".so") files.push_back(at->path());
  if (error) {
    const std::string text =
        fmt::format("the plugin folder {} cannot be read: {}", folder.path.string(), error.message());
    if (added) throw UserError(text);
    warnings_.push_back(text);
  }
  std::sort(files.begin(), files.end());
  bool any = false;
  for (const fs::path& file : files) {
    if (const auto key = key_of_file_name(file)) {
      enter(*key, {file, added, true});
      any = true;
    } else {
      otherwise_named_.insert(file);
    }
  }
  return any;
}

void Registry::enter(const PluginKey& key, Found found) {
  const auto [it, fresh] = found_.try_emplace(key, found);
  if (fresh) return;
  if (identity(it->second.file) == identity(found.file)) {
    it->second.added |= found.added;
    return;
  }
  fs::path hidden = found.file;
  if (found.added && !it->second.added) {
    hidden = it->second.file;
    it->second = std::move(found);
  }
  warnings_.push_back(fmt::format("{} `{}` is there twice: {} is used and hides {}", key.kind, key.name,
                                  it->second.file.string(), hidden.string()));
}

std::vector<std::string> Registry::names(const std::string& kind) const {
  require_kind(kind);
  std::vector<std::string> names;
  for (const auto& [key, found] : found_)
    if (key.kind == kind) names.push_back(key.name);
  return names;
}

const Documentation& Registry::documentation(const std::string& kind, const std::string& name) const {
  return library(kind, name).documentation();
}

Issues Registry::check(const std::string& kind, const std::string& name, const Json& config) const {
  return library(kind, name).check(config);
}

const PluginInfo& Registry::info(const std::string& kind, const std::string& name) const {
  return library(kind, name).info();
}

std::vector<PluginProblem> Registry::problems() const {
  std::vector<PluginProblem> problems;
  for (const auto& [key, found] : found_) {
    try {
      load(key, found).documentation();
    } catch (const std::exception& e) { problems.push_back({found.file, e.what()}); }
  }
  for (const fs::path& file : otherwise_named_)
    if (auto problem = misnamed(file)) problems.push_back(std::move(*problem));
  return problems;
}

const PluginLibrary& Registry::library(const std::string& kind, const std::string& name) const {
  const auto it = found_.find({kind, name});
  if (it == found_.end()) unknown(kind, name);
  return load(it->first, it->second);
}

const PluginLibrary& Registry::load(const PluginKey& key, const Found& found) const {
  auto& slot = loaded_[identity(found.file)];
  if (!slot)
    slot = std::make_shared<const PluginLibrary>(found.file, found.by_name ? std::optional(key) : std::nullopt);
  return *slot;
}

void Registry::unknown(const std::string& kind, const std::string& name) const {
  const std::vector<std::string> known = names(kind);
  std::vector<std::string> folders;
  for (const fs::path& folder : searched_) folders.push_back(folder.string());
  std::string text = fmt::format("no {} named `{}`{} known: {}; searched: {}", kind, name, did_you_mean(name, known),
                                 known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")),
                                 folders.empty() ? "no folder" : fmt::format("{}", fmt::join(folders, ", ")));
  for (const fs::path& file : otherwise_named_)
    if (const auto problem = misnamed(file)) text += "; " + problem->text;
  throw UserError(text);
}

std::optional<PluginProblem> Registry::misnamed(const fs::path& file) const {
  try {
    const PluginInfo info = inspect_plugin(file);
    const auto used = found_.find(info.key);
    if (used != found_.end() && identity(used->second.file) == identity(file)) return std::nullopt;
    return PluginProblem{
        file, fmt::format("plugin {} holds {} `{}`, which is not found under this file name: name it {}, or name the "
                          "file itself under `plugins:`",
                          file.string(), info.key.kind, info.key.name, plugin_file_name(info.key))};
  } catch (const UserError&) {
    return std::nullopt;  // some other library: none of our business
  }
}

}  // namespace breccia
