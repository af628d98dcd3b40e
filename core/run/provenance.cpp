// SPDX-License-Identifier: BSD-3-Clause
#include "run/provenance.hpp"

#include <fmt/format.h>

#include "breccia/text_file.hpp"
#include "hash/sha256.hpp"

namespace breccia {

Json provenance_of(const Workflow& w, const Registry& registry, const std::string& packing) {
  Json provenance = {{"breccia", BRECCIA_VERSION}, {"packing_content", packing}};
  const auto add = [&](const char* kind, const std::string& name) {
    const PluginInfo& info = registry.info(kind, name);
    provenance["plugins"][std::string(kind) + "/" + name] = info.version + " " + info.sha256();
  };
  add("packing", w.packing.type);
  for (const PluginChoice& c : w.contact_law.plugins) add("contact_law", c.type);
  add("protocol", w.protocol.type);
  for (const PluginChoice& c : w.postprocessors) add("postprocessor", c.type);
  for (const PluginChoice& c : w.outputs) add("output", c.type);
  for (const PluginChoice& c : w.renderers) add("renderer", c.type);
  const auto add_file = [&](const std::filesystem::path& file) {
    const std::string bytes = read_bytes(file);
    provenance["files"][valid_utf8(file.string())] = sha256(bytes);
  };
  if (w.material_of && w.material_of->regions)
    for (const RegionConfig& r : *w.material_of->regions)
      if (r.mesh) add_file(r.mesh->file);
  if (w.from) add_file(w.from->checkpoint);
  return provenance;
}

std::vector<std::string> changes_since(const Json& then, const Json& now) {
  std::vector<std::string> changes;
  if (then.contains("packing_content") && then["packing_content"] != now["packing_content"])
    changes.emplace_back("the packing is not the one this resolved workflow was made with: results will differ");
  const auto compare = [&](const char* section, const char* what) {
    if (!then.contains(section) || !then[section].is_object() || !now.contains(section)) return;
    for (const auto& [name, made_with] : then[section].items())
      if (now[section].contains(name) && now[section][name] != made_with)
        changes.push_back(
            fmt::format("{} {} has changed since this resolved workflow was written: results may differ", what, name));
  };
  compare("plugins", "plugin");
  compare("files", "the file");
  return changes;
}

}  // namespace breccia
