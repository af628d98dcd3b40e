// SPDX-License-Identifier: BSD-3-Clause
#include "workflow/read_workflow.hpp"

#include "breccia/text_file.hpp"
#include "breccia/utf8.hpp"
#include "config/reader.hpp"
#include "config/result_name.hpp"
#include "workflow/plausible.hpp"
#include "workflow/plugin_section.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

/// The results go into a folder of that name below results/, and nowhere else.
void check_name(const std::string& name, const BaseChain& chain, const std::vector<std::string>& overrides) {
  const std::string why = why_not_a_file_name(name);
  if (why.empty()) return;
  Problem problem{chain.files[0].name, 1, 1, "name",
                  "`" + name + "` cannot be the name of the result folder, it " + why};
  for (std::size_t k = chain.files.size(); k-- > 0;)  // the workflow's own name goes before those of its bases
    if (const YamlEntry* given = chain.files[k].tree ? chain.files[k].tree->find("name") : nullptr) {
      problem.file = chain.files[k].name;
      problem.line = given->value->place.line;
      problem.column = given->value->place.column;
    }
  for (std::size_t k = 0; k < overrides.size(); ++k)
    if (overrides[k].starts_with("name=")) {
      problem.file = "--set";
      problem.line = int(k) + 1;
      problem.column = 6;
    }
  throw ConfigError({problem});
}

LoadedWorkflow loaded_from(Json config, Places places, const BaseChain& chain, const Registry& registry,
                           const std::vector<std::string>& overrides = {}, const std::string& variant = {}) {
  const fs::path file = chain.files[0].name;
  LoadedWorkflow loaded;
  loaded.config = std::move(config);
  loaded.config.erase("variants");
  if (loaded.config["name"] == "") loaded.config["name"] = valid_utf8(file.stem().string());
  if (!variant.empty()) loaded.config["name"] = loaded.config["name"].get<std::string>() + "_" + variant;
  check_name(loaded.config["name"], chain, overrides);
  Schema<Workflow> schema;
  Workflow::describe(schema);
  loaded.workflow = schema.load(loaded.config);
  loaded.places = std::move(places);
  if (loaded.workflow.checks.implausible_values)
    for (const auto& [path, text] : implausible_values(loaded.config, workflow_schema(), registry))
      loaded.warnings.push_back(loaded.places.with_place(path, text));
  return loaded;
}

/// What a person who mixes the two up should read, in place of a list of unknown keys.
BaseChain not_a_study(BaseChain chain, const fs::path& file) {
  if (is_calibration(chain))
    throw UserError(file.string() + ": this is a calibration, not a workflow: `breccia calibrate " + file.string() +
                    "` runs it");
  if (is_study(chain))
    throw UserError(file.string() + ": this is a study, not a workflow: `breccia sweep " + file.string() + "` runs it");
  return chain;
}

}  // namespace

bool is_calibration(const BaseChain& chain) {
  const YamlPtr tree = chain.files.empty() ? nullptr : chain.files[0].tree;
  return tree && tree->find("targets") && (tree->find("parameters") || tree->find("workflows"));
}

bool is_study(const BaseChain& chain) {
  const YamlPtr tree = chain.files.empty() ? nullptr : chain.files[0].tree;
  if (is_calibration(chain)) return false;
  return tree && (tree->find("workflow") || tree->find("workflows")) && !tree->find("packing") &&
         !tree->find("protocol");
}

std::vector<std::string> workflow_variants(const fs::path& file) {
  return variants_of(follow_bases(read_text(file), file.string()));
}

LoadedWorkflow read_workflow(const fs::path& file, const std::vector<std::string>& overrides, Registry& registry,
                             const std::string& variant) {
  const BaseChain chain = not_a_study(follow_bases(read_text(file), file.string()), file);
  for (const fs::path& path : plugin_paths(chain, overrides, variant)) registry.add(path);
  Places places;
  Json config = read_config(chain, workflow_schema(), registry, overrides, workflow_issues, variant, &places);
  return loaded_from(std::move(config), std::move(places), chain, registry, overrides, variant);
}

LoadedWorkflow read_workflow(const BaseChain& chain, const ValuesOnTop& on_top, const Registry& registry) {
  Places places;
  Json config = read_config(chain, workflow_schema(), registry, on_top, workflow_issues, &places);
  return loaded_from(std::move(config), std::move(places), chain, registry, {}, on_top.variant);
}

LoadedWorkflow read_resolved(const std::string& text, const fs::path& file, const Registry& registry) {
  const BaseChain chain = follow_bases(text, file.string());
  Places places;
  Json config =
      read_config(chain, workflow_schema(), registry, std::vector<std::string>(), workflow_issues, "", &places);
  return loaded_from(std::move(config), std::move(places), chain, registry);
}

}  // namespace breccia
