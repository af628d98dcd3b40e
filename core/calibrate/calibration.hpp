// SPDX-License-Identifier: BSD-3-Clause
/// A calibration: one YAML file that says which parameters of which workflows are sought, and what was measured.
#pragma once

#include <optional>

#include "breccia/schema.hpp"
#include "config/base_chain.hpp"
#include "plugin/registry.hpp"
#include "study/design.hpp"
#include "study/run_time.hpp"
#include "workflow/workflow.hpp"

namespace breccia {

struct CalibrationWorkflow {
  std::filesystem::path file;
  std::optional<std::string> variant;
  Json set;
  static void describe(Schema<CalibrationWorkflow>& s);
};

enum class TargetScale { linear, log };

struct CalibrationTarget {
  std::optional<std::string> workflow, scatter;
  std::optional<double> weight;
  std::optional<TargetScale> scale;
  std::string key, value;
  static void describe(Schema<CalibrationTarget>& s);
};

struct CalibrationParameter {
  std::optional<std::string> path, start, scales_with;
  std::optional<std::vector<std::string>> paths, workflows;
  std::string from, to;
  LatinScale scale;
  static void describe(Schema<CalibrationParameter>& s);
};

/// A share of the budget that is spent on other specimens: smaller ones, say.
struct CalibrationStage {
  std::string name;
  double share;
  std::optional<std::string> variant;
  Json set;
  static void describe(Schema<CalibrationStage>& s);
};

struct CalibrationBudget {
  long runs, packings, start_packings, check_packings, batch;
  std::optional<double> run_time;  ///< [s]
  std::optional<std::vector<CalibrationStage>> stages;
  static void describe(Schema<CalibrationBudget>& s);
};

struct Calibration {
  std::string name, description;
  ByName<CalibrationWorkflow> workflows;
  ByName<CalibrationTarget> targets;
  ByName<CalibrationParameter> parameters;
  CalibrationBudget budget;
  std::vector<PluginPath> plugins;
  std::optional<PluginChoice> search, renderer;
  std::optional<long> jobs;
  long seed;
  static void describe(Schema<Calibration>& s);
};

const ParamSpec& calibration_schema();

/// One parameter between its ends, 0 to 1. Values are texts as a user would write them, in the unit of the range.
struct ParameterScale {
  double from = 0, to = 1;
  std::string unit;  ///< with the blank before it; empty for a pure number
  bool log = false;
  std::string text(double share) const;  ///< to six digits, and within the range
  double share(const std::string& text) const;
  double number(double share) const;  ///< in the unit of the range
};

/// One target: a number that is compared with what runs give, and the scale on which they are compared.
struct TargetMeasure {
  double value = 0, scatter = 0;  ///< SI
  std::string unit;               ///< SI; "1" for a pure number
  std::string written;            ///< unit as the file has it, for tables
  double factor = 1;              ///< from the written unit to SI
  bool log = false;
  double of(double si) const;          ///< on the scale; NaN where a logarithm has none
  double back(double on_scale) const;  ///< SI
  double scatter_on_scale() const;
};

/// A calibration that is in order; its workflows have not been looked at.
struct LoadedCalibration {
  Calibration config;
  InputFile file;
  std::filesystem::path path;
  struct Workflow {
    std::string name, file;  ///< the file as messages show it
    Place place;
    std::vector<PlacedValue> set;
    std::string variant;
    Place variant_place;
  };
  struct Target {
    std::string name, key;
    std::size_t workflow;
    TargetMeasure measure;
    Place place;  ///< of the key
  };
  struct Parameter {
    std::string name;
    std::vector<std::string> paths;
    Place place, from;              ///< of the path; of the range's lower end
    std::vector<bool> of_workflow;  ///< which of the workflows have it
    ParameterScale scale;
    std::optional<double> start;           ///< share of the range
    std::vector<std::size_t> scales_with;  ///< targets; of the moduli, or of the stresses
  };
  struct Stage {
    std::string name, variant;
    double share;
    std::vector<PlacedValue> set;
  };
  std::vector<Workflow> workflows;
  std::vector<Target> targets;
  std::vector<Parameter> parameters;
  std::vector<Stage> stages;  ///< at least one
  RunTime run_time;
  std::string search;  ///< what proposes the points; empty where the file names none and the usual one is not installed
};

/// ConfigError with every problem of the file itself. The plugins that it names are added to the registry first.
LoadedCalibration load_calibration(const std::filesystem::path& file, Registry& registry);

}  // namespace breccia
