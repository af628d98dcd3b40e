// SPDX-License-Identifier: BSD-3-Clause
/// The cases of a study: one workflow at one of its points each.
#pragma once

#include <map>
#include <memory>

#include "run/load_workflow.hpp"
#include "study/study.hpp"

namespace breccia {

struct SweepCase {
  std::size_t number;           ///< from 1
  std::size_t point, workflow;  ///< indices into the study
  std::string folder;           ///< of its results, below `cases`: the values that vary, as they were written
};

/// What the workflows make of a case.
struct ResolvedCase {
  LoadedWorkflow loaded;
  std::vector<Json> inputs;        ///< the value of each parameter that varies, in SI
  std::vector<std::string> units;  ///< of these; "1" for pure numbers and what is no number
  std::string hash;                ///< of all that the result depends on, but the program
};

class Sweep {
 public:
  /// Reads the study and its workflows. ConfigError with every problem of the study itself.
  explicit Sweep(const std::filesystem::path& file);

  const LoadedStudy& study() const { return study_; }
  const std::vector<SweepCase>& cases() const { return cases_; }
  bool has_workflows() const { return !study_.workflow_names[0].empty(); }
  /// Of the plugins that this case's workflow names, the study's values included. UserError when one is of no use.
  const Registry& registry(const SweepCase& c) const;

  /// The case of that number, or of that folder. UserError when there is none.
  const SweepCase& find(const std::string& name) const;
  /// Checked as `--set` would have it. UserError with what is wrong.
  ResolvedCase resolve(const SweepCase& c) const;

 private:
  ValuesOnTop values_of(const SweepCase& c) const;
  /// Those of one list of paths each: plugins named by one workflow must not help another.
  const Registry& registry_with(const std::vector<std::filesystem::path>& plugins) const;
  void read_workflows();
  void name_cases();
  LoadedStudy study_;
  std::vector<BaseChain> sources_;
  mutable std::map<std::vector<std::filesystem::path>, std::unique_ptr<Registry>> registries_;
  std::vector<SweepCase> cases_;
};

/// A case of a study that is in order as a whole.
struct PlannedCase {
  SweepCase the;
  std::vector<Json> inputs;
  std::string hash;
};

struct SweepPlan {
  std::vector<std::string> input_units;  ///< of each parameter
  std::vector<PlannedCase> cases;
  std::vector<std::string> warnings = {};  ///< of values that are most likely slips, each once
};

/// Resolves all cases. UserError with all problems of all cases, each once.
SweepPlan plan(const Sweep& sweep);

/// The columns before the values: "case,folder,workflow,contact_law.bond_modulus_Pa", and the cells of one case.
std::vector<std::string> input_headers(const Sweep& sweep, const SweepPlan& plan);
std::vector<std::string> input_cells(const Sweep& sweep, const PlannedCase& planned);

/// The listing of `--cases`: those columns and the hash of the inputs.
std::string cases_csv(const Sweep& sweep, const SweepPlan& plan);

}  // namespace breccia
