// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/library.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <boost/dll/shared_library.hpp>

#include "plugin/guarded.hpp"

namespace breccia {

namespace {

/// The loader's own words, with C++ symbols as their author wrote them.
std::string loader_message() {
  const char* raw = dlerror();
  std::string text = raw ? raw : "the system gives no reason";
  constexpr std::string_view marker = "undefined symbol: ";
  const std::size_t found = text.find(marker);
  if (found == std::string::npos) return text;
  const std::size_t begin = found + marker.size(), end = std::min(text.find_first_of(", \n", begin), text.size());
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> plain(
      abi::__cxa_demangle(text.substr(begin, end - begin).c_str(), nullptr, nullptr, &status), &std::free);
  if (status == 0) text.replace(begin, end - begin, plain.get());
  return text;
}

/// Never destroyed, so that no library is ever unloaded.
std::vector<boost::dll::shared_library>& loaded_libraries() {
  static auto& libraries = *new std::vector<boost::dll::shared_library>;
  return libraries;
}

const BrecciaPluginDescriptor& load(const std::filesystem::path& file) {
  namespace load_mode = boost::dll::load_mode;
  boost::dll::shared_library library;
  std::error_code error;
  library.load(std::filesystem::absolute(file), error, load_mode::rtld_now | load_mode::rtld_local);
  if (error) {
    const std::string why = loader_message();
    const auto has = [&](const char* part) { return why.find(part) != why.npos; };
    // Where programs may not be run the loader says so; else nothing but memory is missing.
    const bool memory = has("llocate memory") || (has("failed to map segment") && !has("not permitted"));
    throw UserError(fmt::format(
        "plugin {} cannot be loaded: {}; {}", file.string(), why,
        memory ? "there is not enough memory (ulimit -v, -d)" : "install or link what it needs, or build it again"));
  }
  const auto& descriptor = library.get<const BrecciaPluginDescriptor>("breccia_plugin");
  loaded_libraries().push_back(std::move(library));
  return descriptor;
}

}  // namespace

template <class F>
decltype(auto) PluginLibrary::call(const char* doing, F&& f) const {
  const std::string file = info_.file.string();
  return calling({info_.key.kind, info_.key.name, {}, file}, doing, std::forward<F>(f));
}

PluginLibrary::PluginLibrary(const std::filesystem::path& file, const std::optional<PluginKey>& expected)
    : info_(inspect_plugin(file)) {
  if (expected && info_.key != *expected)
    throw UserError(fmt::format("plugin {} holds {} `{}`, which its file name does not say: name it {}", file.string(),
                                info_.key.kind, info_.key.name, plugin_file_name(info_.key)));
  const BrecciaPluginDescriptor& descriptor = load(file);
  factory_ = call("describing itself", [&] { return descriptor.factory(); });
  if (!factory_)
    throw UserError(fmt::format("{} `{}` gave no factory (plugin {}): a fault of the plugin, tell its author",
                                info_.key.kind, info_.key.name, file.string()));
}

const Documentation& PluginLibrary::documentation() const {
  return call("describing itself", [&]() -> const Documentation& { return factory_->documentation(); });
}

Issues PluginLibrary::check(const Json& config) const {
  return call("checking its parameters", [&] { return factory_->check(config); });
}

std::unique_ptr<Plugin> PluginLibrary::create(const Json& config) const {
  auto plugin = call("being set up", [&] { return factory_->create(config); });
  if (!plugin)
    throw UserError(
        fmt::format("{} `{}` made nothing when it was set up (plugin {}): a fault of the plugin, tell its "
                    "author",
                    info_.key.kind, info_.key.name, info_.file.string()));
  return plugin;
}

void PluginLibrary::refuse_class() const {
  throw UserError(
      fmt::format("{} `{}` does not behave as a {} (plugin {}): its last line names the wrong kind, tell "
                  "its author",
                  info_.key.kind, info_.key.name, info_.key.kind, info_.file.string()));
}

}  // namespace breccia
