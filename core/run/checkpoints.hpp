// SPDX-License-Identifier: BSD-3-Clause
/// When a run writes checkpoints, and which are kept. On several ranks the first decides, and all write.
#pragma once

#include <chrono>
#include <functional>

#include "archive/checkpoint_file.hpp"
#include "run/run_ranks.hpp"
#include "workflow/workflow.hpp"

namespace breccia {

/// How much of the test there is already.
struct RunProgress {
  double time = 0;  ///< simulated [s]
  std::uint64_t step = 0;
};

class Checkpoints {
 public:
  /// `folder`: of the results, on the first rank; the files go to `checkpoints` in it. `write`: gives an archive all
  /// that the run is made of, and returns who has no place in it. `curves`: with all their columns, on the first rank.
  /// AtPath when these have no strain and it is asked for.
  Checkpoints(const CheckpointsConfig& config, const std::filesystem::path& folder, const Curves& curves,
              std::function<std::vector<std::string>(Archive&)> write, const RunRanks& ranks, Host& host);

  /// On the first rank, before each step: whether it is time for one. `stop`: it is the last moment.
  bool due(const RunProgress& now, bool stop);
  void write(const RunProgress& now);  ///< all ranks together
  /// The test is over, or the run went on from here.
  void start_from(const RunProgress& now);

 private:
  using Clock = std::chrono::steady_clock;
  bool is_time(const RunProgress& now);
  double strain();
  void save(const RunProgress& now);
  void remove_what_never_arrived() const;
  void save(const std::filesystem::path& file, std::size_t bytes);
  void save_together(const std::filesystem::path& file, std::size_t bytes);
  void make_folder() const;
  void missed(const RunProgress& now, const std::string& why);

  CheckpointsConfig config_;
  std::filesystem::path folder_;
  const Curves& curves_;
  std::function<std::vector<std::string>(Archive&)> write_;
  const RunRanks& ranks_;
  Host& host_;
  Clock::time_point last_ = Clock::now();
  RunProgress from_;
  std::optional<std::string> strain_curve_;
  std::size_t rows_ = 0;                 ///< of the curves, when the strain was looked at
  double strain_ = 0, from_strain_ = 0;  ///< axial; when the last one was written
  bool impossible_ = false, failing_ = false;
};

}  // namespace breccia
