// SPDX-License-Identifier: BSD-3-Clause
/// Packing `from_file`, as a run uses it: reads a table (or, built with FUZZ_VTP, a file of VTK) and checks its
/// spheres.
#include "breccia/packing.hpp"

#include <cmath>

#include "fuzz.hpp"

#ifdef FUZZ_VTP
#include <vtkLogger.h>

// With the plugin's sources, since the plugin of this build may be one without VTK.
extern "C" const BrecciaPluginDescriptor breccia_plugin;
#else
#include "plugin/registry.hpp"
#endif

namespace breccia {
namespace {

#ifdef FUZZ_VTP
constexpr const char* file = "packing.vtp";
std::unique_ptr<Packing> made(const Json& config) {
  static const auto factory = [] {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    return breccia_plugin.factory();
  }();
  std::unique_ptr<Plugin> plugin = factory->create(config);
  return std::unique_ptr<Packing>(dynamic_cast<Packing*>(plugin.release()));
}
#else
constexpr const char* file = "packing.csv";
std::unique_ptr<Packing> made(const Json& config) {
  static const Registry registry;
  return registry.create<Packing>({"from_file", config});
}
#endif

/// What the file is read for goes by its length, so that the bytes are those of the file alone.
void read(std::size_t way) {
  PackingRequest request{{way == 1 ? 2 : 3, 1.0}, 1};
  Json config = {{"file", file}, {"outline", "box"}};
#ifndef FUZZ_VTP
  config["length_unit"] = way == 1 ? "m" : "mm";
#endif
  if (way == 2) {
    config["period"] = {0.01, 0.0, 0.02};
    request.periodic = {true, false, true};
  }
  SilentHost host;
  const PackedParticles p = made(config)->generate(request, host);
  if (p.radius.empty() || p.position.size() != p.radius.size()) fuzz::fail("not as many radii as centres");
  for (std::size_t k = 0; k < p.radius.size(); ++k)
    if (!p.position[k].allFinite() || !(p.radius[k] > 0) || !std::isfinite(p.radius[k])) fuzz::fail("no sphere");
  for (const auto& column : p.columns)
    if (column.second.size() != p.radius.size()) fuzz::fail("a column of another length");
}

}  // namespace
}  // namespace breccia

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace breccia;
  fuzz::write(file, fuzz::text(data, size));
  fuzz::is_read([&] { read(size % 3); });
  return 0;
}
