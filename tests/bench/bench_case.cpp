// SPDX-License-Identifier: BSD-3-Clause
#include "bench_case.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <ctime>
#include <numeric>

#include "../../plugins/shared/copies.hpp"

namespace breccia::bench {

void Quiet::warn(std::string_view text) { fmt::print(stderr, "{}\n", text); }

double processor_time() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

std::size_t memory_in_use() {
  const struct mallinfo2 m = mallinfo2();
  return m.uordblks + m.hblkhd;
}

std::size_t peak_memory() {
  rusage u;
  getrusage(RUSAGE_SELF, &u);
  return std::size_t(u.ru_maxrss) * 1024;
}

double Batches::median() const {
  std::vector<double> sorted = times;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2];
}

double Batches::sum() const { return std::accumulate(times.begin(), times.end(), 0.0); }

namespace {

PackedParticles copied(const PackedParticles& one, const Json& config, const Copies& copies) {
  const Json container = config.value("container", Json::object());
  if (container.value("shape", "") != "box") throw UserError("copies stand side by side only of what is in a box");
  const Json& edge = container.at("size");
  PackedParticles all = one;
  all.position.clear();
  all.radius.clear();
  for (auto& column : all.columns) column.second.clear();
  const CopyNumbers numbers{{}, {copies[0], copies[1], copies[2]}};
  const Vec3 edges(edge[0].get<double>(), edge[1].get<double>(), edge[2].get<double>());
  for (std::size_t c = 0; c < numbers.all(); ++c)
    for (std::size_t k = 0; k < one.radius.size(); ++k) append_moved(one, k, shift_of(numbers.of(c), edges), all);
  all.container_volume *= double(copies[0] * copies[1] * copies[2]);
  return all;
}

}  // namespace

Specimen::Specimen(const std::string& file, const std::vector<std::string>& overrides, const Copies& copies)
    : workflow(load_workflow(file, overrides, registry).workflow) {
  Quiet host;
  const PackingRequest request = workflow.packing_request();
  packing = obtain_packing(registry, workflow.packing, request, default_cache_folder(), host).particles;
  if (copies != Copies{1, 1, 1}) packing = copied(packing, workflow.packing.config, copies);
}

State Specimen::assembled() const {
  return assemble(packing, workflow.materials_of(packing), int(workflow.dimension), workflow.thickness);
}

EngineSettings Specimen::settings(int threads) const {
  EngineSettings s;
  s.damping = {workflow.damping.translational, workflow.damping.rotational};
  s.time_step = workflow.engine.time_step;
  s.safety = workflow.engine.time_step_safety;
  s.added_mass = workflow.engine.added_mass;
  s.skin = workflow.engine.skin;
  s.threads = threads;
  return s;
}

Case::Case(const Specimen& specimen, int threads)
    : threads_(threads),
      memory_(memory_in_use()),
      laws_(specimen.registry, specimen.workflow.contact_law, specimen.workflow.material_list(),
            std::uint64_t(specimen.workflow.seed)),
      protocol_(specimen.registry.create<Protocol>(specimen.workflow.protocol)) {
  bonding_time_ = seconds([&] {
    sim_ = std::make_unique<Simulation>(specimen.assembled(), laws_.interactions(), specimen.settings(threads));
    sim_->bond(specimen.workflow.bonding.rule());
  });
  protocol_->setup(sim_->view(), *sim_, curves_, host_);
  prepare_time_ = seconds([&] { sim_->prepare(); });
  batch();  // memory is touched, files are read
  wall_.times.clear();
  processor_.times.clear();
  memory_ = memory_in_use() - memory_;
}

void Case::batch() {
  processor_.times.push_back(processor_seconds([&] {
    wall_.times.push_back(seconds([&] {
      for (int k = 0; k < steps; ++k) {
        protocol_->step(*sim_);
        sim_->forces(false);
        sim_->advance();
      }
    }));
  }));
}

void Case::rebuild() {
  const std::size_t before = memory_in_use();
  const State& s = sim_->state();
  const std::uint64_t lists = sim_->rebuilds();
  const auto r = s.particles.radius();
  const double away = std::accumulate(r.begin(), r.end(), 0.0) / double(r.size());
  for (std::size_t w = 0; w < s.walls.size(); ++w) sim_->set_wall_velocity(w, -away / s.time_step * s.walls[w].normal);
  sim_->forces(false);
  sim_->advance();
  rebuild_time_ = seconds([&] { sim_->forces(false); }) - wall_.least() / steps;
  BRECCIA_ASSERT(sim_->rebuilds() == lists + 1);
  memory_ += memory_in_use() - before;
}

}  // namespace breccia::bench
