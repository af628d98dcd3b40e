// SPDX-License-Identifier: BSD-3-Clause
#include "run/on_ranks.hpp"

#include "run/load_workflow.hpp"
#include "run/packing_cache.hpp"
#include "run/run_to_results.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Of a rank behind the first.
class SilentRank final : public RunMonitor {
 public:
  explicit SilentRank(const Terminal& asked) : asked_(asked) {}
  void info(std::string_view) override {}
  void warn(std::string_view) override {}
  void progress(std::string_view, double) override {}
  void status(const RunStatus&) override {}
  bool cancelled() const override { return asked_.cancelled(); }
  int threads() const override { return asked_.threads(); }

 private:
  const Terminal& asked_;
};

}  // namespace

RunOutcome run_beside(const RunRequest& a, Registry& registry, Terminal& terminal) {
  std::optional<ResumePoint> resume;
  SilentRank monitor(terminal);
  if (!a.resume.empty()) resume = find_resume_point(a.resume, monitor, a.link);
  const LoadedWorkflow loaded =
      load_workflow(resume ? resume->resolved : a.file, all_overrides(a), registry, a.variant);
  RunOptions options;
  options.packing_cache = default_cache_folder();
  options.resume = resume ? &*resume : nullptr;
  options.accept_changed_plugins = a.accept_changed_plugins;
  options.link = a.link;
  return run_workflow(loaded, registry, options, monitor);
}

}  // namespace breccia
