// SPDX-License-Identifier: BSD-3-Clause
/// A study: one YAML file that says which parameters of which workflows take which values.
#pragma once

#include <optional>

#include "config/problem.hpp"
#include "plugin/registry.hpp"
#include "study/design.hpp"

namespace breccia {

struct StudyWorkflow {
  std::string name;
  std::filesystem::path file;
  static void describe(Schema<StudyWorkflow>& s);
};

/// A quotient of two columns.
struct StudyRatio {
  std::string name, numerator, denominator;
  static void describe(Schema<StudyRatio>& s);
};

struct StudyChartConfig {
  std::string x, y;
  std::optional<std::string> series, name, x_label, y_label;
  std::string file_name() const;
  static void describe(Schema<StudyChartConfig>& s);
};

struct Study {
  std::string name, description;
  std::optional<std::filesystem::path> workflow;
  std::optional<std::vector<StudyWorkflow>> workflows;
  Json fixed, grid, list;
  std::optional<LatinHypercube> latin_hypercube;
  std::vector<std::string> collect;
  std::vector<StudyRatio> derived;
  std::vector<StudyChartConfig> charts;
  std::optional<PluginChoice> renderer;
  static void describe(Schema<Study>& s);
};

const ParamSpec& study_schema();

/// What a chart, or a quotient, may name.
struct StudyTerm {
  enum class Is { parameter, derived, value } is = Is::value;
  std::size_t index = 0;  ///< of the parameter, the derived column, or the workflow of the value
  std::string key;        ///< of a value: its dotted path in summary.json
};

/// A study that is in order; its workflows have not been looked at.
struct LoadedStudy {
  Study study;
  InputFile file;
  std::vector<std::string> workflow_names;  ///< one empty name when there is a single workflow
  std::vector<std::string> workflow_files;  ///< as messages show them
  std::vector<Place> workflow_places;
  std::vector<PlacedValue> fixed;
  std::vector<StudyParameter> parameters;  ///< those that vary
  std::vector<StudyPoint> points;          ///< each has a value of every parameter, in their order
  std::vector<Problem> of_columns;  ///< what is wrong with columns and charts; `plan` tells it with what the cases have

  StudyTerm term(const std::string& name) const;  ///< of a name that was checked when the study was read
};

/// ConfigError with every problem but those `of_columns`. `registry` knows the renderers.
LoadedStudy load_study(const std::filesystem::path& file, const Registry& registry);

}  // namespace breccia
