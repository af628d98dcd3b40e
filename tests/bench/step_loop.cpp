// SPDX-License-Identifier: BSD-3-Clause
/// Time of the first 1000 steps on the specimen of a workflow: breccia_bench WORKFLOW [THREADS...] [--json FILE]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>

#include "breccia/contact_law.hpp"
#include "breccia/protocol.hpp"
#include "engine/assembly.hpp"
#include "engine/simulation.hpp"
#include "output/curve_table.hpp"
#include "run/contact_laws.hpp"
#include "run/packing_cache.hpp"
#include "run/workflow.hpp"

namespace {

using namespace breccia;

class Quiet final : public Host {
 public:
  void info(std::string_view) override {}
  void warn(std::string_view text) override { fmt::print(stderr, "{}\n", text); }
  void progress(std::string_view, double) override {}
  bool cancelled() const override { return false; }
  int threads() const override { return 2; }
};

template <class F>
double seconds(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of all threads of this process [s].
double processor_time() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// One simulation, run in batches.
class Case {
 public:
  static constexpr int batches = 100, steps = 10;

  Case(const Workflow& w, const Registry& registry, const PackedParticles& packing, int threads)
      : threads_(threads),
        laws_(registry, w.contact_law, w.material_list(), std::uint64_t(w.seed)),
        protocol_(registry.create<Protocol>(w.protocol)),
        sim_(assemble(packing, w.materials_of(packing), int(w.dimension), w.thickness), laws_.interactions(),
             settings(w, threads)) {
    sim_.bond(w.bonding.rule());
    protocol_->setup(sim_.view(), sim_, curves_, host_);
    sim_.prepare();
    time_step_ = sim_.state().time_step;
  }

  void batch() {
    const double before = processor_time();
    times_.push_back(seconds([&] {
      for (int k = 0; k < steps; ++k) {
        protocol_->step(sim_);
        sim_.forces(false);
        sim_.advance();
      }
    }));
    processor_times_.push_back(processor_time() - before);
  }
  void rebuild_lists() {
    for (int k = 0; k < 5; ++k) rebuild_ = std::min(rebuild_, seconds([&] { sim_.prepare(); }));
  }

  int threads() const { return threads_; }
  double wall_time() const {
    double sum = 0;
    for (const double t : times_) sum += t;
    return sum;
  }
  double processor() const {
    return *std::min_element(processor_times_.begin(), processor_times_.end()) / steps;
  }                                                                                         // [s] per step
  double least() const { return *std::min_element(times_.begin(), times_.end()) / steps; }  // [s] per step
  double median() const {
    std::vector<double> sorted = times_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2] / steps;
  }
  double rebuild() const { return rebuild_; }
  double time_step() const { return time_step_; }
  const Simulation& simulation() const { return sim_; }

 private:
  static EngineSettings settings(const Workflow& w, int threads) {
    EngineSettings s;
    s.damping = {w.damping.translational, w.damping.rotational};
    s.threads = threads;
    return s;
  }
  int threads_;
  ContactLaws laws_;
  std::unique_ptr<Protocol> protocol_;
  Simulation sim_;
  Quiet host_;
  CurveTable curves_;
  std::vector<double> times_, processor_times_;
  double rebuild_ = 1e300, time_step_;
};

/// What the workflow's reference says 1000 steps took elsewhere, if it does.
std::string published(const Workflow& w, int threads) {
  if (!w.reference.contains("threads") || !w.reference.contains("seconds_per_1000_steps")) return "";
  const Json &count = w.reference["threads"], &time = w.reference["seconds_per_1000_steps"];
  for (std::size_t k = 0; k < std::min(count.size(), time.size()); ++k)
    if (count[k] == threads) return fmt::format("{:.2f}", time[k].get<double>());
  return "";
}

/// Minima; `file` empty: nowhere.
void write_json(const std::string& file, const std::vector<std::unique_ptr<Case>>& cases) {
  if (file.empty()) return;
  Json all = Json::array();
  for (const auto& c : cases) all.push_back({{"threads", c->threads()}, {"seconds_per_1000_steps", 1e3 * c->least()}});
  if (!(std::ofstream(file) << all.dump(2) << "\n")) throw UserError("cannot write " + file);
}

void measure(const Workflow& w, const Registry& registry, const std::vector<int>& threads, const std::string& file) {
  Quiet host;
  const PackingOutcome packing = obtain_packing(registry, w.packing, w.packing_request(), default_cache_folder(), host);
  std::vector<std::unique_ptr<Case>> cases;
  for (const int t : threads) cases.push_back(std::make_unique<Case>(w, registry, packing.particles, t));
  // In turn, so that other work on the machine is in the way of each alike.
  for (int b = 0; b < Case::batches; ++b)
    for (const auto& c : cases) c->batch();
  for (const auto& c : cases) c->rebuild_lists();

  const State& s = cases[0]->simulation().state();
  const double bonds = double(s.bonds.size()), one = cases[0]->least();
  fmt::print("{}: {} particles, {} bonds, {} pairs; time step {:.4g} us; {} batches of {} steps\n", w.name,
             s.particles.size(), s.bonds.size(), s.pairs.size(), 1e6 * cases[0]->time_step(), Case::batches,
             Case::steps);
  fmt::print("{:>7}  {:>11} {:>8}  {:>9} {:>9} {:>9} {:>10}  {:>8}  {:>10}\n", "", "ns per bond", "and step", "s per",
             "1000 steps", "", "", "", "pair list");
  fmt::print("{:>7}  {:>11} {:>8}  {:>9} {:>9} {:>9} {:>10}  {:>8}  {:>10}\n", "threads", "minimum", "median",
             "minimum", "its cpu", "all, wall", "published", "speed-up", "made in ms");
  for (const auto& c : cases)
    fmt::print("{:>7}  {:>11.2f} {:>8.2f}  {:>9.2f} {:>9.2f} {:>9.2f} {:>10}  {:>8.2f}  {:>10.1f}\n", c->threads(),
               1e9 * c->least() / bonds, 1e9 * c->median() / bonds, 1e3 * c->least(), 1e3 * c->processor(),
               c->wall_time(), published(w, c->threads()), one / c->least(), 1e3 * c->rebuild());
  write_json(file, cases);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw UserError("usage: breccia_bench WORKFLOW [THREADS...] [--json FILE]");
    std::vector<int> threads;
    std::string file;
    for (int k = 2; k < argc; ++k) {
      if (std::string_view(argv[k]) != "--json") threads.push_back(std::stoi(argv[k]));
      else if (++k < argc) file = argv[k];
    }
    if (threads.empty()) threads = {1, 2};
    Registry registry;
    measure(load_workflow(argv[1], {}, registry).workflow, registry, threads, file);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
