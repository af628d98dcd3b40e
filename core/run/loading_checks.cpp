// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "breccia/block_sum.hpp"
#include "breccia/result_tools/order_statistics.hpp"
#include "run/checks.hpp"

namespace breccia {
namespace {

/// Those that have left are no part of what is measured, and yet in all sums. Each rank looks at its own.
void look_for_flown_off(const SimulationView& part, std::size_t n, double limit, Host& host) {
  if (n < 8) return;
  const auto& position = part.particles.position;
  const OwnRows own = part.own_particles();
  Vec3 middle;
  double length = 0;
  const std::size_t quarters[] = {n / 4, n - 1 - n / 4};  // half of them; the whole is twice as long
  for (int k = 0; k < 3; ++k) {
    std::vector<double> x;
    x.reserve(own.size());
    for (const std::size_t a : own) x.push_back(position[a][k]);
    const std::vector<double> at = numbers_behind(std::move(x), quarters, [&](std::span<std::int64_t> counts) {
      std::vector<ExactSum> sums(counts.size());
      for (std::size_t c = 0; c < counts.size(); ++c) sums[c].add(double(counts[c]));
      const std::vector<double> all = part.sums(sums);
      std::copy(all.begin(), all.end(), counts.begin());
    });
    middle[k] = (at[0] + at[1]) / 2;
    length = std::max(length, 2 * (at[1] - at[0]));
  }
  struct Far {
    double off;
    Index id;
  };
  ExactSumOf<std::size_t> flown;
  std::vector<Far> farthest;  // here, then of each part
  for (const std::size_t a : own) {
    const double off = (position[a] - middle).cwiseAbs().maxCoeff();
    if (off > (0.5 + limit) * length) flown.add(1);
    if (farthest.empty()) farthest.push_back({off, part.particles.id[a]});
    else if (off > farthest[0].off) farthest[0] = {off, part.particles.id[a]};
  }
  const std::size_t all_flown = part.sum(flown);
  if (all_flown == 0) return;
  farthest = part.all(farthest);
  const Far most = *std::max_element(farthest.begin(), farthest.end(),
                                     [](const Far& one, const Far& other) { return one.off < other.off; });
  host.warn(fmt::format(
      "{} of {} particles have flown off: particle {} of the packing, the farthest, is {:.3g} m from the middle of "
      "the specimen, which is {:.3g} m long. Kinetic energy, volumes and strains of the whole are measured with them",
      all_flown, n, most.id, most.off, length));
}

}  // namespace

void check_time_step(Simulation& simulation, const ChecksConfig& limits, Host& host) {
  const auto found = simulation.step_setter(limits.time_step_ratio);
  if (!found) return;
  const Vec3& x = found->position;
  host.warn(fmt::format(
      "particle {} of the packing (radius {:.4g} m, at {:.4g}, {:.4g}, {:.4g} m){} makes the time step {:.3g} times "
      "shorter than it were without {}: the critical one, by the bound of single particles, is {:.3g} s instead of "
      "{:.3g} s. Is it too small, or does it "
      "overlap others or a wall too much?",
      found->id, found->radius, x.x(), x.y(), x.z(), found->others ? fmt::format(", with {} more,", found->others) : "",
      found->without / found->step, found->others ? "them" : "it", found->step, found->without));
}

double unbalanced_on_the_rise(const std::vector<LoadedRow>& rows, double peak) {
  constexpr double drop = 0.02;  // a load that waves by less still rises
  double most = 0, highest = 0;
  for (const LoadedRow& row : rows) {
    if (row.load >= 0.9 * peak) break;
    highest = std::max(highest, row.load);
    if (row.load > 0.1 * peak && row.load >= (1 - drop) * highest) most = std::max(most, row.unbalanced);
  }
  return most;
}

void LoadingChecks::sample(Simulation& simulation, const SimulationView& part, double load, Host& host) {
  look_for_speed(simulation, host);
  look_for_overlaps(part);
  if (simulation.loading_started()) rows_.push_back({load, simulation.unbalanced_force_ratio()});
}

void LoadingChecks::look_for_speed(Simulation& simulation, Host& host) {
  const double speed = simulation.fastest_boundary();
  if (fast_ || speed <= walls_speed_) return;
  walls_speed_ = speed;
  if (wave_speed_ < 0) wave_speed_ = simulation.bond_stiffness().wave_speed;
  if (!(wave_speed_ > 0) || speed <= limits_.wall_speed * wave_speed_) return;
  fast_ = true;
  host.warn(
      fmt::format("a boundary moves at {:.3g} m/s, that is {:.3g} % of the speed of waves in the bonded specimen "
                  "({:.4g} m/s): its load does not reach the whole specimen at once; lower the velocity of the "
                  "platens, or the rate of strain",
                  speed, 100 * speed / wave_speed_, wave_speed_));
}

void LoadingChecks::look_for_overlaps(const SimulationView& part) {
  const ParticlesView& p = part.particles;
  wall_overlap_.resize(part.walls.size(), 0);
  for (const WallContact& c : part.wall_contacts)
    wall_overlap_[c.wall] =
        std::max(wall_overlap_[c.wall], 1 - (c.point - p.position[c.particle]).norm() / p.radius[c.particle]);
  BlockSum<double> sum(part);
  BlockSum<std::size_t> pressed(part);
  double deepest = 0;
  for (const std::size_t k : part.own_pairs()) {
    if (part.pairs.state[k] == BondState::intact) continue;
    const Index i = part.pairs.i[k], j = part.pairs.j[k];
    const double overlap =
        (part.pairs.rest_length[k] - part.branch(p.position[i], p.position[j]).norm()) / (p.radius[i] + p.radius[j]);
    if (overlap <= 0) continue;
    sum.add(i, overlap);
    pressed.add(i, 1);
    deepest = std::max(deepest, overlap);
  }
  std::vector<double> most = wall_overlap_;
  most.push_back(deepest);
  part.max(most);
  deepest = most.back();
  most.pop_back();
  wall_overlap_.swap(most);
  if (deepest <= pair_overlap_) return;
  pair_overlap_ = deepest;
  const auto [all, count] = part.sum(sum.exact(), pressed.exact());
  pair_mean_ = all / double(count);
}

void LoadingChecks::finish(const Simulation& simulation, double peak, Host& host) const {
  const auto& walls = simulation.state().walls;
  for (std::size_t w = 0; w < wall_overlap_.size(); ++w)
    if (wall_overlap_[w] > limits_.wall_overlap)
      host.warn(
          fmt::format("wall `{}` of {:.3g} N/m is penetrated: a particle stood {:.3g} % of its radius deep in it; "
                      "strains and areas measured by that wall are wrong by so much: give it more stiffness",
                      walls[w].name, walls[w].normal_stiffness, 100 * wall_overlap_[w]));
  if (pair_overlap_ > limits_.pair_overlap)
    host.warn(
        fmt::format("particles without an intact bond are pressed {:.3g} % of the sum of their radii into each other "
                    "at the deepest ({:.3g} % in the mean at that time): the contact law is too soft, or the load too "
                    "high, for particles that keep their shape",
                    100 * pair_overlap_, 100 * pair_mean_));
  const double most = unbalanced_on_the_rise(rows_, peak);
  if (most > limits_.unbalanced_force)
    host.warn(
        fmt::format("the test is not quasi-static: before the peak of the load the unbalanced force ratio rises to "
                    "{:.3g} (the limit is {:.3g}): strength and moduli contain inertia; lower the velocity of the "
                    "platens, or raise the damping",
                    most, limits_.unbalanced_force));
  if (simulation.state().cell.repeats()) return;
  look_for_flown_off(simulation.particles_here(), simulation.all_particles(), limits_.flown_off, host);
}

void LoadingChecks::archive(Archive& archive) {
  archive("rows", rows_);
  archive("wall_overlap", wall_overlap_);
  archive("pair_overlap", pair_overlap_);
  archive("pair_mean", pair_mean_);
  archive("wave_speed", wave_speed_);
  archive("walls_speed", walls_speed_);
  archive("fast", fast_);
}

}  // namespace breccia
