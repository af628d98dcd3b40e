// SPDX-License-Identifier: BSD-3-Clause
/// A post-processor that is shown one state after the other, as a run would.
#pragma once

#include <memory>
#include <optional>

#include "breccia/postprocessor.hpp"
#include "check/kept.hpp"
#include "check/made_simulation.hpp"
#include "plugin/registry.hpp"

namespace breccia {

using States = std::vector<MadeSimulation>;

class PostprocessorRun {
 public:
  /// Set up on the first state; what the plugin throws comes out as it is.
  PostprocessorRun(const Registry& registry, const PluginChoice& choice, const MadeSimulation& first, int threads = 1);
  void start(const MadeSimulation& state) { plugin_->start_of_loading(state.view()); }
  /// A row, and the fields of a frame. `times`: the row is measured that often.
  void sample(const MadeSimulation& state, int times = 1);
  void finish(const MadeSimulation& last) { plugin_->finish(last.view(), rows, summary); }
  /// The first `count` states, or all; then the end.
  void whole(const States& states);
  bool archive(Archive& archive) { return plugin_->archive(archive); }
  bool sees_parts() const { return plugin_->sees_parts(); }

  KeptCurves rows;  ///< those that the plugin asks for and does not add itself come last: see `own_columns`
  std::size_t own_columns = 0;
  KeptSummary summary;
  std::vector<std::vector<Field>> fields;  ///< of each row

 private:
  std::unique_ptr<Postprocessor> plugin_;
};

/// What is not as it must be: a name or unit, a value that nobody set or that is no number, lengths that differ; empty
/// when all is in order.
std::string fault_of_names(const PostprocessorRun& run);
std::string fault_of_values(const PostprocessorRun& run, const States& states);

/// Those of own rows of two halves, one behind the other.
std::vector<std::vector<Field>> joined_fields(const PostprocessorRun& low, const States& of_low,
                                              const PostprocessorRun& high, const States& of_high);

/// Where two runs differ; empty when they do not. `order`: of particles in the second (`reordered`), compared to
/// rounding; none: bit by bit.
std::string difference(const PostprocessorRun& a, const PostprocessorRun& b, const std::vector<Index>* order = nullptr);

}  // namespace breccia
