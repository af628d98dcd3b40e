// SPDX-License-Identifier: BSD-3-Clause
#include "run/load_workflow.hpp"

#include "breccia/output.hpp"
#include "breccia/postprocessor.hpp"
#include "breccia/protocol.hpp"
#include "breccia/renderer.hpp"
#include "plugin/guarded.hpp"
#include "run/branch.hpp"
#include "run/columns.hpp"
#include "run/packing_cache.hpp"
#include "workflow/contact_laws.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// What only making the plugins can tell.
void try_plugins(const Workflow& w, const Registry& registry) {
  const auto packing = registry.create<Packing>(w.packing);
  for (const fs::path& input :
       calling({Packing::kind, w.packing.type}, "naming its files", [&] { return packing->inputs(); }))
    if (!fs::is_regular_file(input))
      throw AtPath("packing.file", "packing " + w.packing.type + ": cannot read " + input.string() + ": no such file");
  refuse_what_cannot_be(*packing, w.packing.type, w.packing_request());
  ContactLaws(registry, w.contact_law, w.material_list(), std::uint64_t(w.seed));
  registry.create<Protocol>(w.protocol);
  for (const PluginChoice& c : w.postprocessors) registry.create<Postprocessor>(c);
  for (const PluginChoice& c : w.outputs) registry.create<Output>(c);
  for (const PluginChoice& c : w.renderers) registry.create<Renderer>(c);
  check_dimension(w, registry);
  check_curves(w, registry);
}

LoadedWorkflow tried(LoadedWorkflow loaded, const Registry& registry) {
  loaded.places.placing([&] {
    if (auto& from = loaded.workflow.from) {
      from->checkpoint = checkpoint_of(from->checkpoint);
      loaded.config["from"]["checkpoint"] = from->checkpoint.string();
    }
    try_plugins(loaded.workflow, registry);
  });
  return loaded;
}

}  // namespace

LoadedWorkflow load_workflow(const fs::path& file, const std::vector<std::string>& overrides, Registry& registry,
                             const std::string& variant) {
  return tried(read_workflow(file, overrides, registry, variant), registry);
}

LoadedWorkflow load_workflow(const BaseChain& chain, const ValuesOnTop& on_top, const Registry& registry) {
  return tried(read_workflow(chain, on_top, registry), registry);
}

LoadedWorkflow load_resolved(const std::string& text, const fs::path& file, const Registry& registry) {
  return tried(read_resolved(text, file, registry), registry);
}

}  // namespace breccia
