// SPDX-License-Identifier: BSD-3-Clause
/// A simulation made by hand, and a host that keeps what a post-processor says: plugins are tested through their shared
/// library, as the program uses them.
#pragma once

#include <dlfcn.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "breccia/postprocessor.hpp"
#include "check/kept.hpp"
#include "check/made_simulation.hpp"

namespace breccia::test {

using FakeSimulation = MadeSimulation;
using FakeCurves = KeptCurves;
using FakeSummary = KeptSummary;

class FakeHost final : public SilentHost {
 public:
  void warn(std::string_view text) override { warnings.emplace_back(text); }
  std::vector<std::string> warnings;
};

/// A post-processor from its library, configured as the core would: defaults filled in.
class LoadedPostprocessor {
 public:
  explicit LoadedPostprocessor(const std::string& name, Json config = Json::object()) {
    const std::string file = std::string(BRECCIA_POSTPROCESSORS) + "/breccia_postprocessor." + name + ".so";
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) throw std::runtime_error(dlerror());
    const auto* descriptor = static_cast<const BrecciaPluginDescriptor*>(dlsym(library, "breccia_plugin"));
    if (!descriptor) throw std::runtime_error(file + " is no plugin");
    Factory* factory = descriptor->factory();
    for (const ParamSpec& p : factory->documentation().root.members)
      if (!config.contains(p.name) && !p.fallback.is_null()) config[p.name] = p.fallback;
    issues = factory->check(config);
    plugin_ = factory->create(config);
  }
  Postprocessor* operator->() { return static_cast<Postprocessor*>(plugin_.get()); }

  FakeCurves curves;
  FakeHost host;
  Issues issues;

  void begin(const SimulationView& view) { (*this)->begin(view, curves, host); }
  void sample(const SimulationView& view) { (*this)->sample(view, curves); }
  FakeSummary finish(const SimulationView& view) {
    FakeSummary summary;
    (*this)->finish(view, curves, summary);
    return summary;
  }
  std::vector<double> field(const SimulationView& view, const std::string& name) {
    std::vector<Field> all;
    (*this)->fields(view, all);
    for (Field& f : all)
      if (f.name == name) return f.values;
    throw std::logic_error("no field " + name);
  }

 private:
  std::unique_ptr<Plugin> plugin_;
};

}  // namespace breccia::test
