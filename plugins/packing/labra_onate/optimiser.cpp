// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser.hpp"

#include <algorithm>
#include <numeric>

#include "breccia/packing_tools/parallel.hpp"
#include "size_correlation.hpp"

namespace breccia::labra_onate {

namespace {
constexpr double longest_move = 0.5;  // of a centre in one step, in radii
constexpr double start_scale = 0.3;   // of the radii at the random places
constexpr int growth_steps = 15, growth_iterations = 3;
constexpr double first_damping = 0.1, least_damping = 1e-4, most_damping = 1e6;
constexpr double solver_tolerance = 0.05;  // of the linear system: a better step does not pay
constexpr int solver_iterations = 60;

/// Uniform in [0, 1), the same on every platform, unlike std::uniform_real_distribution.
double uniform(std::mt19937_64& generator) { return double(generator() >> 11) * 0x1p-53; }
}  // namespace

Spheres Optimiser::arrange(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<double> full = radii_;
  for (std::size_t k = full.size() - 1; k > 0; --k)
    std::swap(full[k], full[std::min(k, std::size_t(uniform(generator) * double(k + 1)))]);
  Spheres s;
  s.r = full;
  for (const double r : full) {
    const double a = uniform(generator), b = uniform(generator), c = uniform(generator);
    s.x.push_back(box_.place(r, a, b, c));
  }
  for (int g = 0; g < growth_steps; ++g) {
    const double scale = start_scale + (1 - start_scale) * double(g) / (growth_steps - 1);
    for (std::size_t i = 0; i < full.size(); ++i) s.r[i] = scale * full[i];
    run(s, {Residual::distance, false, 0, growth_iterations, 0.15 * g / growth_steps, 0.15 * (g + 1) / growth_steps});
  }
  s.r = full;
  run(s, {Residual::distance, false, 0, settings_.max_iterations, 0.15, 0.5});
  if (settings_.size_correlation) {
    correlate_sizes(s, finder_.find(s, settings_.pairs), *settings_.size_correlation, seed);
    run(s, {Residual::distance, false, 0, settings_.max_iterations, 0.5, 0.5});
  }
  return s;
}

StageRecord Optimiser::optimise_all(Spheres& s) {
  return run(s, {Residual::squared_distance, true, settings_.pairs, settings_.max_iterations, 0.5, 0.8});
}

StageRecord Optimiser::optimise_centres(Spheres& s) {
  return run(s, {Residual::squared_distance, false, settings_.pairs, settings_.max_iterations, 0.8, 1.0});
}

/// Looks up the neighbours, puts the spheres inside (or on the walls they want to touch) and measures the energy.
Optimiser::Candidate Optimiser::settle(Spheres s, const Stage& stage) {
  Candidate c{std::move(s), {}, 0};
  c.set = finder_.find(c.s, stage.pairs);
  if (stage.pairs == 0) std::fill(c.set.tangent.begin(), c.set.tangent.end(), std::uint8_t(0));
  for_all(c.s.size(), settings_.threads,
          [&](std::size_t i) { c.s.x[i] = box_.project(c.s.x[i], c.s.r[i], c.set.tangent[i]); });
  c.energy = LeastSquares::energy(c.s, c.set, stage.form, settings_.threads);
  return c;
}

Spheres Optimiser::moved(const Candidate& from, const std::vector<Vec4>& step, const Stage& stage) const {
  Spheres s = from.s;
  for_all(s.size(), settings_.threads, [&](std::size_t i) {
    Vec3 d = step[i].head<3>();
    const double length = d.norm(), limit = longest_move * s.r[i];
    s.x[i] += length > limit ? Vec3(d * (limit / length)) : d;
  });
  if (stage.radii_free) {
    std::vector<double> wish(s.size());
    for (std::size_t i = 0; i < s.size(); ++i) wish[i] = s.r[i] + step[i][3];
    std::vector<std::size_t> order(s.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return wish[a] != wish[b] ? wish[a] < wish[b] : a < b; });
    for (std::size_t k = 0; k < order.size(); ++k) s.r[order[k]] = radii_[k];
  }
  for_all(s.size(), settings_.threads,
          [&](std::size_t i) { s.x[i] = box_.project(s.x[i], s.r[i], from.set.tangent[i]); });
  return s;
}

StageRecord Optimiser::run(Spheres& s, const Stage& stage) {
  StageRecord record;
  Candidate now = settle(std::move(s), stage);
  record.energy.push_back(now.energy);
  double damping = first_damping;
  int slow = 0;
  bool stuck = false;
  for (int k = 0; k < stage.max_iterations && slow < 3 && now.energy > 0; ++k) {
    if (host_.cancelled()) throw Cancelled();
    host_.progress("packing", stage.share_begin + (stage.share_end - stage.share_begin) * k / stage.max_iterations);
    const LeastSquares problem(now.s, box_, now.set, stage.form, stage.radii_free, settings_.threads);
    bool better = false;
    for (; !better && damping < most_damping; damping *= better ? 1.0 / 3 : 4.0) {
      Candidate next = settle(moved(now, problem.step(damping, solver_tolerance, solver_iterations), stage), stage);
      better = next.energy < now.energy;
      if (!better) continue;
      slow = now.energy - next.energy < settings_.tolerance * now.energy ? slow + 1 : 0;
      now = std::move(next);
      record.energy.push_back(now.energy);
    }
    stuck = !better;
    if (stuck) break;
    damping = std::max(damping, least_damping);
  }
  // No shorter step lowers the energy either: a minimum.
  record.converged = slow >= 3 || stuck || !(now.energy > 0);
  s = std::move(now.s);
  return record;
}

}  // namespace breccia::labra_onate
