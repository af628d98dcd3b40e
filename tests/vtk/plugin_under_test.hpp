// SPDX-License-Identifier: BSD-3-Clause
/// Opens one plugin file and makes its plugin from partial parameters, as the program does after checking a workflow.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "breccia/plugin.hpp"
#include "breccia/services.hpp"

namespace breccia::test {

inline const Factory& factory_of(const char* file) {
  void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(dlerror());
  return *static_cast<const BrecciaPluginDescriptor*>(dlsym(library, "breccia_plugin"))->factory();
}

/// Fills in the defaults of absent members.
inline Json completed(const ParamSpec& group, Json given) {
  for (const ParamSpec& p : group.members) {
    if (!given.contains(p.name) && !p.fallback.is_null()) given[p.name] = p.fallback;
    if (!given.contains(p.name)) continue;
    if (p.type == ParamType::group) given[p.name] = completed(p, given[p.name]);
    if (p.type == ParamType::group_list)
      for (Json& item : given[p.name]) item = completed(p, item);
  }
  return given;
}

template <class P>
std::unique_ptr<P> make(const char* file, const Json& given) {
  const Factory& factory = factory_of(file);
  auto plugin = factory.create(completed(factory.documentation().root, given));
  auto* typed = dynamic_cast<P*>(plugin.get());
  if (!typed) throw std::runtime_error("another kind of plugin");
  plugin.release();
  return std::unique_ptr<P>(typed);
}

/// What the plugin says about parameters that contradict each other.
inline Issues issues_of(const char* file, const Json& given) {
  const Factory& factory = factory_of(file);
  return factory.check(completed(factory.documentation().root, given));
}

struct QuietHost final : Host {
  std::vector<std::string> notes, warnings;
  void info(std::string_view text) override { notes.emplace_back(text); }
  void warn(std::string_view text) override { warnings.emplace_back(text); }
  std::vector<double> done;
  int thread_count = 1;
  bool stop = false;  ///< once some progress was told
  void progress(std::string_view, double share) override { done.push_back(share); }
  bool cancelled() const override { return stop && !done.empty(); }
  int threads() const override { return thread_count; }
};

/// A folder that is gone after the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "breccia-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no folder for temporary files");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// The text of the UserError that f throws.
template <class F>
std::string user_error(F&& f) {
  try {
    f();
  } catch (const UserError& e) { return e.what(); }
  return "(no UserError)";
}

}  // namespace breccia::test
