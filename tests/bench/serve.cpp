// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <numeric>

#include "bench_case.hpp"

namespace breccia::bench {
namespace {

/// Particles and bonds as they are before the first step, for another program.
void write_specimen(const std::string& file, const Specimen& specimen, const State& now) {
  const Particles start = specimen.assembled().particles;
  const auto radius = start.radius();
  const double mean_radius = std::accumulate(radius.begin(), radius.end(), 0.0) / double(start.size());
  Json all = {{"steps", Case::steps},
              {"time_step", now.time_step},
              {"skin", specimen.workflow.engine.skin * mean_radius},
              {"particles", Json::array()},
              {"bonds", Json::array()}};
  for (std::size_t a = 0; a < start.size(); ++a) {
    const Vec3& x = start.position()[a];
    all["particles"].push_back({x.x(), x.y(), x.z(), start.radius()[a]});
  }
  for (std::size_t k = 0; k < now.bonds.size(); ++k) all["bonds"].push_back({now.bonds.i[k], now.bonds.j[k]});
  for (const Wall& w : now.walls) all[w.normal.z() > 0 ? "bottom" : "top"] = (w.point - w.displacement).z();
  if (!(std::ofstream(file) << all.dump() << "\n")) throw UserError("cannot write " + file);
}

}  // namespace

void serve(const Specimen& specimen, int threads, const std::string& file) {
  Case one(specimen, threads);
  const State& s = one.simulation().state();
  if (!file.empty()) write_specimen(file, specimen, s);
  const Json has = {{"particles", s.particles.size()},
                    {"bonds", s.bonds.size()},
                    {"pairs", s.pairs.size()},
                    {"bytes", one.memory()},
                    {"steps", Case::steps}};
  fmt::print("READY {}\n", has.dump());
  std::fflush(stdout);
  for (std::string line; std::getline(std::cin, line);) {
    one.batch();
    fmt::print("SECONDS {}\n", one.processor().times.back());
    std::fflush(stdout);
  }
}

}  // namespace breccia::bench
