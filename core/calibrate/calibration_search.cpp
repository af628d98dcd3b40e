// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/calibration_search.hpp"

#include <algorithm>

#include "config/reader.hpp"
#include "config/suggest.hpp"
#include "workflow/read_workflow.hpp"

namespace breccia {

namespace {

/// What a user can do where the usual search is not installed.
std::string why_no_usual_search(const Registry& registry) {
  const std::vector<std::string> others = registry.names("search");
  return "the search `kriging` is not installed, since this Breccia was built without OpenTURNS. Install OpenTURNS "
         "(Debian's libopenturns-dev) and build Breccia again with -DBRECCIA_OPENTURNS=ON, or name " +
         (others.empty() ? "a search of your own under `search` (`breccia new search NAME` begins one)"
                         : "another one under `search`: " + list_of(others));
}

}  // namespace

bool has_usual_search(const Registry& registry) {
  const std::vector<std::string> names = registry.names("search");
  return std::find(names.begin(), names.end(), usual_search) != names.end();
}

void refuse_missing_usual_search(const InputFile& file, const Registry& registry) {
  const YamlEntry* search = file.tree->find("search");
  const YamlEntry* type = search ? search->value->find("type") : nullptr;
  if (type && type->value->text == usual_search && !has_usual_search(registry))
    refuse({{type->value->place, "search.type", why_no_usual_search(registry)}}, {file});
}

PluginChoice search_of(const LoadedCalibration& loaded, const Registry& registry) {
  if (loaded.config.search) return *loaded.config.search;
  const std::string file = loaded.path.string();
  if (loaded.search.empty()) throw UserError(file + ": nothing proposes the points: " + why_no_usual_search(registry));
  struct Config {
    PluginChoice search;
  };
  Schema<Config> schema;
  schema.param("search", &Config::search).kind("search").doc("what proposes the points");
  const std::string text = "search: {type: " + loaded.search + "}\n";
  return schema.load(read_config(text, file, schema.documentation().root, registry)).search;
}

}  // namespace breccia
