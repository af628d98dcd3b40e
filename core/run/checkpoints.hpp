// SPDX-License-Identifier: BSD-3-Clause
/// When a run writes checkpoints, and which are kept.
#pragma once

#include <chrono>
#include <functional>

#include "archive/checkpoint_file.hpp"
#include "run/workflow.hpp"

namespace breccia {

/// How much of the test there is already.
struct RunProgress {
  double time = 0;  ///< simulated [s]
  std::uint64_t step = 0;
  double strain = 0;  ///< axial, of the last row of the curves
};

class Checkpoints {
 public:
  /// `folder`: of the results; the files go to `checkpoints` in it. `write`: gives an archive all that the run is made
  /// of, and returns who has no place in it.
  Checkpoints(const CheckpointsConfig& config, const std::filesystem::path& folder,
              std::function<std::vector<std::string>(Archive&)> write, Host& host);

  /// Before each step: writes one if it is time. `stop`: it is the last moment.
  void at(const RunProgress& now, bool stop);
  /// The test is over, or the run went on from here.
  void start_from(const RunProgress& now);

 private:
  using Clock = std::chrono::steady_clock;
  bool due(const RunProgress& now) const;
  void save(const RunProgress& now);
  void missed(const RunProgress& now, const std::string& why);

  CheckpointsConfig config_;
  std::filesystem::path folder_;
  std::function<std::vector<std::string>(Archive&)> write_;
  Host& host_;
  Clock::time_point last_ = Clock::now();
  RunProgress from_;
  bool impossible_ = false, failing_ = false;
};

}  // namespace breccia
