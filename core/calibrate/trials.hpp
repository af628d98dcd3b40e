// SPDX-License-Identifier: BSD-3-Clause
/// The runs of a calibration: a workflow with values of the parameters and a seed.
#pragma once

#include <map>
#include <memory>

#include "breccia/search.hpp"
#include "calibrate/calibration.hpp"
#include "workflow/read_workflow.hpp"

namespace breccia {

/// Values of the parameters, in their order, as a user would write them.
using TrialPoint = std::vector<std::string>;

struct Trial {
  static constexpr std::size_t no_stage = std::size_t(-1);  ///< the workflow as the user has it
  std::size_t stage = 0, workflow = 0;
  long seed = 1;
  TrialPoint values;
};

/// A run that is in order.
struct ResolvedTrial {
  LoadedWorkflow loaded;
  std::string hash;    ///< of all that the result depends on, but the program
  std::string folder;  ///< below `cases`: the workflow's name and the beginning of the hash
};

class CalibrationTrials {
 public:
  /// Reads the calibration and its workflows. ConfigError with every problem of the calibration itself.
  explicit CalibrationTrials(const std::filesystem::path& file);

  const LoadedCalibration& calibration() const { return calibration_; }
  /// That of the calibration, made anew. UserError where it names none and the usual one is not installed.
  std::unique_ptr<Search> search() const;
  const Registry& registry(const Trial& t) const;
  /// Checked as `--set` would have it. UserError with what is wrong.
  ResolvedTrial resolve(const Trial& t) const;
  /// For the process that runs it, and back. UserError when it is none of this calibration.
  Json described(const Trial& t) const;
  Trial from(const Json& described) const;

  /// The workflow with these values, on `base:` itself: a file for the folder `at`. What the calibration sets for its
  /// own purposes (stages) is not in it.
  std::string ready_workflow(std::size_t workflow, const TrialPoint& values, const std::filesystem::path& at) const;

  /// SI unit of each parameter, as the workflows have it; "1" for pure numbers.
  const std::vector<std::string>& parameter_units() const { return units_; }
  /// Values that are most likely slips, each once, of the first guess.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  ValuesOnTop values_of(const Trial& t) const;
  const Registry& registry_with(const std::vector<std::filesystem::path>& plugins) const;
  void read_workflows();
  void try_the_range();
  Registry own_;  ///< of the calibration itself
  LoadedCalibration calibration_;
  std::vector<BaseChain> sources_;
  std::vector<std::string> units_, warnings_;
  mutable std::map<std::vector<std::filesystem::path>, std::unique_ptr<Registry>> registries_;
};

}  // namespace breccia
