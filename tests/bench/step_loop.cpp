// SPDX-License-Identifier: BSD-3-Clause
/// Time of the step loop, on the specimens of workflows: see `usage`.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>

#include "bench_case.hpp"

namespace {

using namespace breccia;
using namespace breccia::bench;

constexpr const char* usage =
    "usage: breccia_bench WORKFLOW [THREADS...] [--batches N] [--json FILE] [--set PATH=VALUE]... [--copies NX,NY,NZ]\n"
    "       breccia_bench --roofline WORKFLOW [--set PATH=VALUE]... [--copies NX,NY,NZ]...\n"
    "       breccia_bench --serve WORKFLOW [THREADS] [--write FILE] [--set PATH=VALUE]... [--copies NX,NY,NZ]\n"
    "The first steps of the test, on 1 and 2 threads or on those given; or, with --roofline, the step of the engine\n"
    "beside that of a plain kernel, for each number of copies; or, with --serve, a batch for every line of standard "
    "input.";

struct Arguments {
  std::string file, json, write;
  std::vector<std::string> overrides;
  std::vector<Copies> copies;
  std::vector<int> threads;
  int batches = 100;
  bool roofline = false, serve = false;
};

Copies copies_of(const std::string& text) {
  Copies c;
  char after;
  if (std::sscanf(text.c_str(), "%d,%d,%d%c", &c[0], &c[1], &c[2], &after) != 3 ||
      *std::min_element(c.begin(), c.end()) < 1)
    throw UserError("--copies takes three whole numbers, as 2,2,5");
  return c;
}

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const auto value = [&]() -> std::string {
      if (++k == argc) throw UserError(word + " needs a value\n" + usage);
      return argv[k];
    };
    if (word == "--roofline") a.roofline = true;
    else if (word == "--serve") a.serve = true;
    else if (word == "--write") a.write = value();
    else if (word == "--set") a.overrides.push_back(value());
    else if (word == "--copies") a.copies.push_back(copies_of(value()));
    else if (word == "--json") a.json = value();
    else if (word == "--batches") a.batches = std::max(1, std::stoi(value()));
    else if (word.starts_with("--")) throw UserError("unknown option " + word + "\n" + usage);
    else if (a.file.empty()) a.file = word;
    else a.threads.push_back(std::stoi(word));
  }
  if (a.file.empty() || (!a.roofline && a.copies.size() > 1)) throw UserError(usage);
  if (a.copies.empty()) a.copies = {{1, 1, 1}};
  if (a.threads.empty()) a.threads = {1, 2};
  return a;
}

/// What the workflow's reference says 1000 steps took elsewhere, if it does.
std::string published(const Workflow& w, int threads) {
  if (!w.reference.contains("threads") || !w.reference.contains("seconds_per_1000_steps")) return "";
  const Json &count = w.reference["threads"], &time = w.reference["seconds_per_1000_steps"];
  for (std::size_t k = 0; k < std::min(count.size(), time.size()); ++k)
    if (count[k] == threads) return fmt::format("{:.2f}", time[k].get<double>());
  return "";
}

/// Of 1000 steps [s].
double thousand(double batch) { return 1000.0 / Case::steps * batch; }

/// Minima; `file` empty: nowhere.
void write_json(const std::string& file, const std::vector<std::unique_ptr<Case>>& cases, std::size_t peak) {
  if (file.empty()) return;
  Json all = Json::array();
  for (const auto& c : cases) {
    const State& s = c->simulation().state();
    all.push_back({{"threads", c->threads()},
                   {"particles", s.particles.size()},
                   {"bonds", s.bonds.size()},
                   {"pairs", s.pairs.size()},
                   {"seconds_per_1000_steps", thousand(c->wall().least())},
                   {"ns_per_bond_step", 1e9 * c->wall().least() / Case::steps / double(s.bonds.size())},
                   {"processor_ns_per_bond_step", 1e9 * c->processor().least() / Case::steps / double(s.bonds.size())},
                   {"bonding_seconds", c->bonding_time()},
                   {"prepare_seconds", c->prepare_time()},
                   {"rebuild_seconds", c->rebuild_time()},
                   {"bytes", c->memory()},
                   {"peak_bytes", peak}});
  }
  if (!(std::ofstream(file) << all.dump(2) << "\n")) throw UserError("cannot write " + file);
}

void measure(const Arguments& a) {
  const Specimen specimen(a.file, a.overrides, a.copies.front());
  std::vector<std::unique_ptr<Case>> cases;
  std::size_t peak = 0;
  for (const int t : a.threads) {
    cases.push_back(std::make_unique<Case>(specimen, t));
    if (peak == 0) peak = peak_memory();  // while there is but one
  }
  // In turn, so that other work on the machine is in the way of each alike.
  for (int b = 0; b < a.batches; ++b)
    for (const auto& c : cases) c->batch();
  for (const auto& c : cases) c->rebuild();

  const State& s = cases[0]->simulation().state();
  const double bonds = double(s.bonds.size()), particles = double(s.particles.size());
  const double one = cases[0]->wall().least();
  fmt::print("{}: {} particles, {} bonds, {} pairs; time step {:.4g} us; {} batches of {} steps\n",
             specimen.workflow.name, s.particles.size(), s.bonds.size(), s.pairs.size(), 1e6 * s.time_step, a.batches,
             Case::steps);
  fmt::print("memory: {:.0f} bytes per particle, {:.0f} at the peak of the process\n",
             double(cases[0]->memory()) / particles, double(peak) / particles);
  fmt::print("{:>7}  {:>11} {:>8}  {:>9} {:>9} {:>9} {:>9} {:>10}  {:>8}  {:>7} {:>7} {:>7}\n", "", "ns per bond",
             "and step", "steps", "s per", "1000 steps", "", "", "", "seconds", "to", "");
  fmt::print("{:>7}  {:>11} {:>8}  {:>9} {:>9} {:>9} {:>9} {:>10}  {:>8}  {:>7} {:>7} {:>7}\n", "threads", "minimum",
             "median", "per s", "minimum", "its cpu", "all, wall", "published", "speed-up", "bond", "prepare",
             "rebuild");
  for (const auto& c : cases) {
    const Batches &wall = c->wall(), &processor = c->processor();
    fmt::print(
        "{:>7}  {:>11.2f} {:>8.2f}  {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>10}  {:>8.2f}  {:>7.2f} {:>7.2f} {:>7.3f}\n",
        c->threads(), 1e9 * wall.least() / Case::steps / bonds, 1e9 * wall.median() / Case::steps / bonds,
        Case::steps / wall.least(), thousand(wall.least()), thousand(processor.least()), wall.sum(),
        published(specimen.workflow, c->threads()), one / wall.least(), c->bonding_time(), c->prepare_time(),
        c->rebuild_time());
  }
  write_json(a.json, cases, peak);
}

void roofline(const Arguments& a) {
  std::string line = "step over plain kernel:";
  for (const Copies& copies : a.copies) {
    const Specimen specimen(a.file, a.overrides, copies);
    line += fmt::format(" {:.2f} ({:.0f}k)", step_over_plain_kernel(specimen),
                        1e-3 * double(specimen.packing.radius.size()));
  }
  fmt::print("{}\n", line);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments a = parse(argc, argv);
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    if (a.roofline) roofline(a);
    else if (a.serve) serve(Specimen(a.file, a.overrides, a.copies.front()), a.threads.front(), a.write);
    else measure(a);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
