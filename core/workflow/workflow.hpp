// SPDX-License-Identifier: BSD-3-Clause
/// A workflow: one YAML file that wires the plugins, alone or on top of a base.
#pragma once

#include <filesystem>

#include "breccia/packing.hpp"
#include "breccia/schema.hpp"
#include "engine/bonding.hpp"
#include "engine/simulation.hpp"
#include "workflow/materials.hpp"

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

/// The section `checks:` of a workflow: from where on it is said. None of them has a part in the test itself.
struct ChecksConfig {
  bool implausible_values;  // as they are written: `workflow/plausible.hpp`
  bool negative_porosity;
  double deep_overlap, wide_gap, bond_share, unbonded_share, stray_growth;  // of the specimen before the first step
  double time_step_ratio;
  double wall_overlap, pair_overlap, wall_speed, unbalanced_force, flown_off;  // while it is loaded
  static void describe(Schema<ChecksConfig>& s);
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

const ParamSpec& workflow_schema();

/// What the rules between its sections say of a configuration whose values are each in order.
Issues workflow_issues(const Json& config);

}  // namespace breccia
