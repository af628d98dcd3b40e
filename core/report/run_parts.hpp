// SPDX-License-Identifier: BSD-3-Clause
/// The parts of a run's report, each the body of a section; empty where the run's files say nothing of it.
#pragma once

#include <string>

#include "plugin/registry.hpp"
#include "report/run_files.hpp"

namespace breccia::report {

/// Of the numbers at the top of a summary: stands behind strength and stiffness, which readers look for first.
bool is_secondary(const std::string& key);

// What was measured (run_results.cpp).
std::string tiles(const RunFiles& run);           ///< a few numbers at a glance
std::string results_table(const RunFiles& run);   ///< beside the reference values, which are said to be what they are
std::string specimen_table(const RunFiles& run);  ///< asked and achieved
std::string damage_part(const RunFiles& run);
std::string energy_part(const RunFiles& run);
std::string other_numbers(const RunFiles& run);  ///< all others that plugins have measured, foldable
std::string warnings_part(const RunFiles& run);
std::string warnings_list(const Json& warnings);  ///< an array of texts; empty when there are none

// What was asked for (run_model.cpp).
std::string model_part(const RunFiles& run, const Registry& registry);

// Where it comes from (sources.cpp).
std::string computation_part(const RunFiles& run);
/// `more`: sources besides those of the run's models.
std::string citation_part(const RunFiles& run, const Registry& registry,
                          const std::vector<std::pair<std::string, std::string>>& more = {});
std::string citation_text(const std::string& version);
/// "0.2.0"; empty when the results do not say.
std::string program_version(const RunFiles& run);
/// "search `kriging`" and its source; nothing where no such plugin is installed.
std::vector<std::pair<std::string, std::string>> search_source(const std::string& search, const Registry& registry);
/// Papers and equations of the packing, the laws and the test: pairs of name ("contact law `linear`") and source.
std::vector<std::pair<std::string, std::string>> model_sources(const RunFiles& run, const Registry& registry);

}  // namespace breccia::report
