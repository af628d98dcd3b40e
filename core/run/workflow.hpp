// SPDX-License-Identifier: BSD-3-Clause
/// A workflow: one YAML file that wires the plugins, alone or on top of a base.
#pragma once

#include <filesystem>

#include "breccia/schema.hpp"
#include "config/base_chain.hpp"
#include "config/places.hpp"
#include "engine/bonding.hpp"
#include "engine/simulation.hpp"
#include "plugin/registry.hpp"
#include "run/checks.hpp"
#include "run/materials.hpp"

namespace breccia {

struct PluginPath {
  std::filesystem::path path;
  static void describe(Schema<PluginPath>& s);
};

struct BondingConfig {
  std::optional<double> tolerance, gap, coordination_number;
  GapMeasure nearest_by;
  BondingRule rule() const;
  static void describe(Schema<BondingConfig>& s);
};

struct DampingConfig {
  double translational, rotational;
  static void describe(Schema<DampingConfig>& s);
};

struct EngineConfig {
  TimeStep time_step;
  double time_step_safety, added_mass, skin, energy_error_warning, energy_error_limit;
  static void describe(Schema<EngineConfig>& s);
};

struct SamplingConfig {
  long every_steps;
  double load_change;
  static void describe(Schema<SamplingConfig>& s);
};

struct CurvesConfig {
  bool hdf5;
  static void describe(Schema<CurvesConfig>& s);
};

struct CheckpointsConfig {
  double every;  // [s]
  std::optional<double> every_simulated;
  std::optional<double> every_strain;
  std::optional<long> every_steps;
  long keep;
  bool at_end;
  static void describe(Schema<CheckpointsConfig>& s);
};

enum class BranchProtocol { go_on, begin };

/// `from`: the run begins where another one stood.
struct BranchConfig {
  std::filesystem::path checkpoint;  ///< once the workflow is loaded: a file
  std::optional<BranchProtocol> protocol;
  static void describe(Schema<BranchConfig>& s);
};

struct Workflow {
  std::optional<std::filesystem::path> base;  ///< never set: merged away when the file is read
  std::string name, description;
  long seed, dimension;
  double thickness;
  std::vector<std::string> periodic;
  std::vector<PluginPath> plugins;
  PluginChoice packing, protocol;
  PluginStack contact_law;
  std::optional<MaterialConfig> material;
  std::optional<ByName<MaterialConfig>> materials;
  std::optional<MaterialOfConfig> material_of;
  BondingConfig bonding;
  DampingConfig damping;
  EngineConfig engine;
  SamplingConfig sampling;
  CurvesConfig curves;
  CheckpointsConfig checkpoints;
  std::optional<BranchConfig> from;
  ChecksConfig checks;
  std::vector<PluginChoice> postprocessors, outputs, renderers;
  Json reference, provenance;
  Json variants;  ///< never set: taken out when the file is read

  std::vector<Material> material_list() const;                   ///< of `material` or `materials`
  Materials materials_of(const PackedParticles& packing) const;  ///< and which particle is of which
  Space space() const { return {int(dimension), thickness}; }    ///< how it repeats itself the packing says
  PackingRequest packing_request() const;
  EngineSettings engine_settings(int threads) const;
  static void describe(Schema<Workflow>& s);
};

/// A workflow that is in order, with the configuration it came from (all defaults filled in).
struct LoadedWorkflow {
  Workflow workflow;
  Json config;
  Places places = {};                      ///< of the values in their files
  std::vector<std::string> warnings = {};  ///< of values that are most likely slips, with their places
};

const ParamSpec& workflow_schema();

/// Reads and checks a workflow file and its bases; the plugins named under `plugins:` are added to the registry first.
/// Makes each of its plugins once, and looks for the files that its packing needs. ConfigError with every problem.
LoadedWorkflow load_workflow(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                             Registry& registry, const std::string& variant = {});

/// Whether the first file is a study for `breccia sweep`, by its keys.
bool is_study(const BaseChain& chain);

/// Names of the variants of a workflow file and its bases.
std::vector<std::string> workflow_variants(const std::filesystem::path& file);

/// The same of a chain whose plugins have been added, with the values of a study in it.
LoadedWorkflow load_workflow(const BaseChain& chain, const ValuesOnTop& on_top, const Registry& registry);

/// The text of a resolved.yaml that stands in the file of that name; its plugins are known already.
LoadedWorkflow load_resolved(const std::string& text, const std::filesystem::path& file, const Registry& registry);

}  // namespace breccia
