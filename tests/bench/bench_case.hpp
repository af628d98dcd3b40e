// SPDX-License-Identifier: BSD-3-Clause
/// A workflow's specimen, and simulations of it that are run in short batches.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "breccia/protocol.hpp"
#include "results/curve_table.hpp"
#include "run/load_workflow.hpp"
#include "run/packing_cache.hpp"
#include "workflow/contact_laws.hpp"

namespace breccia::bench {

/// Only warnings.
class Quiet final : public SilentHost {
 public:
  void warn(std::string_view text) override;
  int threads() const override { return 2; }
};

/// Wall time that it takes [s].
template <class F>
double seconds(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double processor_time();  ///< of all threads of this process [s]
template <class F>
double processor_seconds(F&& f) {
  const double start = processor_time();
  f();
  return processor_time() - start;
}

std::size_t memory_in_use();  ///< what is allocated now [byte]
std::size_t peak_memory();    ///< largest resident size of the process so far [byte]

/// Times of batches [s].
struct Batches {
  std::vector<double> times = {};
  double least() const { return *std::min_element(times.begin(), times.end()); }
  double median() const;
  double sum() const;
};

/// How often a specimen stands side by side along x, y, z.
using Copies = std::array<int, 3>;

/// A workflow read once, with its packing from the cache or made. UserError for copies of what is not in a box.
struct Specimen {
  Specimen(const std::string& file, const std::vector<std::string>& overrides, const Copies& copies);
  Registry registry;
  Workflow workflow;
  PackedParticles packing;
  State assembled() const;
  EngineSettings settings(int threads) const;
};

/// One simulation of a specimen under its protocol.
class Case {
 public:
  static constexpr int steps = 10;  ///< of a batch

  Case(const Specimen& specimen, int threads);

  void batch();
  /// Has the pair list made anew, by walls that leap away: the last thing that is done with a case. From then on there
  /// is a list of before, as in every longer run.
  void rebuild();

  int threads() const { return threads_; }
  const Batches& wall() const { return wall_; }            ///< of batches
  const Batches& processor() const { return processor_; }  ///< the same, all threads together
  double bonding_time() const { return bonding_time_; }    ///< particles put in order and bonded [s]
  double prepare_time() const { return prepare_time_; }    ///< first pair list and time step [s]
  double rebuild_time() const { return rebuild_time_; }    ///< of a new pair list, after `rebuild` [s]
  std::size_t memory() const { return memory_; }           ///< what it has allocated [byte]
  const Simulation& simulation() const { return *sim_; }

 private:
  int threads_;
  std::size_t memory_;
  ContactLaws laws_;
  std::unique_ptr<Protocol> protocol_;
  std::unique_ptr<Simulation> sim_;
  Quiet host_;
  CurveTable curves_;
  Batches wall_, processor_;
  double bonding_time_ = 0, prepare_time_ = 0, rebuild_time_ = 0;
};

/// The engine beside a plain kernel of the same law, pairs, particles and time step, on one thread, in turn: the least
/// time of a step over that of the plain one. An error when the two do not move alike.
double step_over_plain_kernel(const Specimen& specimen);

/// Runs a batch for each line of standard input and answers with its time, see in_turn.py. `file`, if any, gets the
/// particles and bonds.
void serve(const Specimen& specimen, int threads, const std::string& file);

}  // namespace breccia::bench
