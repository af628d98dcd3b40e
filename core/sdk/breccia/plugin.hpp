// SPDX-License-Identifier: BSD-3-Clause
/// What makes a shared library a Breccia plugin: one descriptor in C, read before any C++ type is touched,
/// and a factory behind it. Plugin authors only need BRECCIA_PLUGIN at the end of their source.
#pragma once

#include <cstdint>
#include <memory>

#include "breccia/archive.hpp"
#include "breccia/schema.hpp"
#include "breccia/sdk_abi.hpp"

namespace breccia {

/// Base of all plugin kinds.
class BRECCIA_API Plugin {
 public:
  virtual ~Plugin() = default;
  /// What changes in the plugin while a test runs, for checkpoints: writes it, or reads it back into a plugin that was
  /// made and set up anew, from the same workflow, for the same specimen. Asked of protocols, post-processors and
  /// outputs. True: that is all there is, or there is nothing; false: it is not known here, and runs with this plugin
  /// have no checkpoints. What is kept for speed alone is left out.
  virtual bool archive(Archive&) { return false; }
};

/// Makes and documents the plugin of one shared library.
class BRECCIA_API Factory {
 public:
  virtual ~Factory() = default;
  virtual const Documentation& documentation() const = 0;
  /// The rules between parameters that ranges cannot state; `config` already satisfies the documentation.
  virtual Issues check(const Json& config) const = 0;
  virtual std::unique_ptr<Plugin> create(const Json& config) const = 0;
};

/// `P` has a nested `Config`, `static void describe(Schema<Config>&)` and a constructor from `const Config&`.
template <class P>
class FactoryOf final : public Factory {
 public:
  FactoryOf() { P::describe(schema_); }
  const Documentation& documentation() const override { return schema_.documentation(); }
  Issues check(const Json& config) const override { return schema_.check(config); }
  std::unique_ptr<Plugin> create(const Json& config) const override {
    return std::make_unique<P>(schema_.load(config));
  }

 private:
  Schema<typename P::Config> schema_;
};

}  // namespace breccia

extern "C" {

/// Plain C: readable whatever the compiler that made it. The first four members never change place.
struct BrecciaPluginDescriptor {
  char magic[8];  ///< "BRECCIA" and a zero
  std::uint32_t sdk_abi;
  std::uint32_t descriptor_size;
  const char* compiler;  ///< family and ABI version of the compiler
  const char* standard_library;
  std::uint32_t size_of_json, size_of_string, size_of_vec3, size_of_param_spec;
  const char* kind;
  const char* name;
  const char* version;
  ::breccia::Factory* (*factory)();  ///< owned by the library; called only once all the above agrees
};
}

#define BRECCIA_STRINGIFY_(x) #x
#define BRECCIA_STRINGIFY(x) BRECCIA_STRINGIFY_(x)
#define BRECCIA_COMPILER_ABI "gxx-abi-" BRECCIA_STRINGIFY(__GXX_ABI_VERSION)
#ifdef _GLIBCXX_USE_CXX11_ABI
#define BRECCIA_STDLIB_ABI "libstdc++-cxx11-" BRECCIA_STRINGIFY(_GLIBCXX_USE_CXX11_ABI)
#else
#define BRECCIA_STDLIB_ABI "unknown"
#endif

namespace breccia {
constexpr BrecciaPluginDescriptor make_descriptor(const char* kind, const char* name, const char* version,
                                                  Factory* (*factory)()) {
  return {{'B', 'R', 'E', 'C', 'C', 'I', 'A', 0},
          BRECCIA_SDK_ABI,
          sizeof(BrecciaPluginDescriptor),
          BRECCIA_COMPILER_ABI,
          BRECCIA_STDLIB_ABI,
          sizeof(Json),
          sizeof(std::string),
          sizeof(Vec3),
          sizeof(ParamSpec),
          kind,
          name,
          version,
          factory};
}
}  // namespace breccia

#ifndef BRECCIA_PLUGIN_VERSION
#define BRECCIA_PLUGIN_VERSION "unversioned"  // set by breccia_add_plugin() in CMake
#endif

/// Last line of a plugin: its class, its kind and the name it has in workflows.
#define BRECCIA_PLUGIN(Class, kind, name)                              \
  static ::breccia::Factory* breccia_make_factory() {                  \
    static ::breccia::FactoryOf<Class> factory;                        \
    return &factory;                                                   \
  }                                                                    \
  extern "C" BRECCIA_API const BrecciaPluginDescriptor breccia_plugin; \
  const BrecciaPluginDescriptor breccia_plugin =                       \
      ::breccia::make_descriptor(kind, name, BRECCIA_PLUGIN_VERSION, &breccia_make_factory);
