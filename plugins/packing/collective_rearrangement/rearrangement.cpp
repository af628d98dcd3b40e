// SPDX-License-Identifier: BSD-3-Clause
#include "rearrangement.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <span>

#include "breccia/images.hpp"
#include "breccia/packing_tools/parallel.hpp"

namespace breccia::collective_rearrangement {

namespace {
constexpr double start_scale = 0.6, scale_step = 0.05;  // of the radii: below 0.6 random places hardly overlap for long
constexpr int growth_iterations = 400;
constexpr double growth_tolerance = 1e-2;
constexpr double longest_move = 0.2;  // of a centre in one iteration, in radii
constexpr double no_overlap = 1e-6;   // over s: nothing is left to do
constexpr int check_every = 50;
constexpr int closing_rounds = 30, closing_iterations = 100;
constexpr double closing_reach = 0.5;  // gaps over s that can be drawn together at all
constexpr double narrowest = 3.2;      // half of a cell that repeats itself, in largest radii: more than any reach
// FIRE, in units in which the stiffest mode has a frequency of order one.
constexpr double usual_stiffness = 3;  // times 1/r^2: of twelve neighbours of the same size
constexpr double first_step = 0.1, longest_step = 1.0, mixing_start = 0.1;

/// Uniform in [0, 1), the same on every platform, unlike std::uniform_real_distribution.
double uniform(std::mt19937_64& generator) { return double(generator() >> 11) * 0x1p-53; }
}  // namespace

Rearrangement::Rearrangement(const Region& region, const Space& space, std::vector<double> radii, std::uint64_t seed,
                             const Settings& settings, Host& host)
    : region_(region), space_(space), settings_(settings), host_(host) {
  // The largest first, so that the order of the particles says nothing of where they are.
  s_.r = std::move(radii);
  std::sort(s_.r.begin(), s_.r.end(), std::greater<>());
  std::mt19937_64 generator(seed);
  for (const double r : s_.r) {
    const double a = uniform(generator), b = uniform(generator), c = uniform(generator);
    s_.x.push_back(region_.place(r, a, b, c));
  }
  const std::size_t n = s_.size();
  for (int k = 0; k < 3; ++k)
    if (space_.cell.repeats(k) && space_.cell.width(k) < 2 * narrowest * s_.r.front())
      throw UserError(
          "the space to be filled repeats itself too soon: it must be at least 6.4 times as long as the "
          "largest radius along the directions of `periodic`");
  velocity_.assign(n, Vec3::Zero());
  force_.assign(n, Vec3::Zero());
  energy_of_.assign(n, 0.0);
  touching_.assign(n, 0);
  room_.assign(n, 0.0);
  skin_ = 0.2 * std::accumulate(s_.r.begin(), s_.r.end(), 0.0) / double(n);
  find_neighbours();
}

Outcome Rearrangement::run() {
  Outcome all;
  for (double scale = start_scale; scale < 1 - 0.5 * scale_step; scale += scale_step) {
    host_.progress("packing", 0.5 * (scale - start_scale) / (1 - start_scale));
    all.iterations += relax(scale, growth_iterations, growth_tolerance).iterations;
  }
  const Outcome last = relax(1.0, settings_.max_iterations, settings_.tolerance);
  host_.progress("packing", 1);
  return {last.converged, all.iterations + last.iterations};
}

/// The set of pairs follows the spheres from round to round.
Outcome Rearrangement::close(std::size_t pairs) {
  closing_ = true;
  Outcome all;
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < closing_rounds && !all.converged; ++round) {
    host_.progress("drawing neighbours together", double(round) / closing_rounds);
    find_nearest(pairs);
    all.iterations += relax(1.0, closing_iterations, settings_.tolerance).iterations;
    all.converged = before - energy_ < settings_.tolerance * before;
    before = energy_;
  }
  host_.progress("drawing neighbours together", 1);
  return all;
}

Outcome Rearrangement::relax(double scale, int max_iterations, double tolerance) {
  const std::size_t n = s_.size();
  constexpr double least = 0.25 * no_overlap * no_overlap;
  double step = first_step, mixing = mixing_start;
  int downhill = 0;
  std::fill(velocity_.begin(), velocity_.end(), Vec3::Zero());
  forces(scale);
  double before = energy_;
  for (int k = 1; k <= max_iterations; ++k) {
    if (host_.cancelled()) throw Cancelled();
    if (largest_energy_ <= least) return {true, std::size_t(k)};
    const double power = ordered_sum(n, settings_.threads, [&](std::size_t i) { return force_[i].dot(velocity_[i]); });
    double ratio = 0;
    if (power < 0) {
      std::fill(velocity_.begin(), velocity_.end(), Vec3::Zero());
      step *= 0.5;
      mixing = mixing_start;
      downhill = 0;
    } else {
      const double vv =
          ordered_sum(n, settings_.threads, [&](std::size_t i) { return velocity_[i].squaredNorm() / mobility_[i]; });
      const double ff =
          ordered_sum(n, settings_.threads, [&](std::size_t i) { return force_[i].squaredNorm() * mobility_[i]; });
      ratio = ff > 0 ? std::sqrt(vv / ff) : 0;
      if (++downhill > 5) {
        step = std::min(1.1 * step, longest_step);
        mixing *= 0.99;
      }
    }
    if (advance(step, mixing, ratio) && !closing_) find_neighbours();
    forces(scale);
    if (k % check_every == 0) {
      if (before - energy_ < tolerance * before) return {true, std::size_t(k)};
      before = energy_;
      if (scale == 1 && !closing_) host_.progress("packing", 0.5 + 0.5 * double(k) / max_iterations);
    }
  }
  return {largest_energy_ <= least, std::size_t(max_iterations)};
}

/// One step of motion; true when the neighbours may no longer be all.
bool Rearrangement::advance(double step, double mixing, double ratio) {
  const std::size_t n = s_.size();
  for_all(n, settings_.threads, [&](std::size_t i) {
    const double r = s_.r[i];
    Vec3& v = velocity_[i];
    v = (1 - mixing) * v + (mixing * ratio + step) * mobility_[i] * force_[i];
    Vec3 d = step * v;
    const double length = d.norm();
    if (length > longest_move * r) d *= longest_move * r / length;
    const Vec3 wanted = s_.x[i] + d;
    room_[i] -= d.norm();
    if (room_[i] > 0 && touching_[i] == 0) {
      s_.x[i] = wanted;
      return;
    }
    confine(i, wanted);
    // What the wall took from the motion it takes from the velocity: no pressing on against it.
    const Vec3 push = s_.x[i] - wanted;
    const double size = push.norm();
    if (size > 1e-12 * r) {
      const Vec3 inward = push / size;
      const double outward = std::min(0.0, v.dot(inward));
      v -= outward * inward;
    }
  });
  double farthest = 0;
  for (std::size_t i = 0; i < n; ++i) farthest = std::max(farthest, (s_.x[i] - listed_at_[i]).squaredNorm());
  return farthest > 0.25 * skin_ * skin_;
}

/// Puts a sphere where it keeps inside; where it is, when there is no such place nearby.
void Rearrangement::confine(std::size_t i, const Vec3& wanted) {
  const Confined got = region_.confine(wanted, s_.r[i], touching_[i]);
  room_[i] = got.room;
  if (got.room >= -1e-9 * s_.r[i]) s_.x[i] = got.x;
}

/// The spheres are sorted, so that those of about one size, up to a factor of two, are a range with a grid of its own.
/// Each sphere looks for larger ones only: a large one would meet a crowd of small ones in its cells.
void Rearrangement::find_neighbours() {
  const std::size_t n = s_.size();
  listed_at_ = s_.x;
  near_.resize(n);
  for (auto& row : near_) row.clear();
  for (std::size_t first = 0; first < n;) {
    std::size_t end = first;
    while (end < n && 2 * s_.r[end] > s_.r[first]) ++end;
    const double reach = 2 * s_.r[first] + skin_;
    const Images images(space_, std::span<const Vec3>(listed_at_).subspan(first, end - first), reach);
    const CellGrid grid(images.position, reach);
    for_all(n - first, settings_.threads, [&](std::size_t k) {
      const std::size_t i = first + k;
      const Vec3 at = images.folded(s_.x[i]);
      grid.for_each_near(at, [&](Index m) {
        const std::size_t j = first + images.of[m];
        const double limit = s_.r[i] + s_.r[j] + skin_;
        if (j < i && (at - images.position[m]).squaredNorm() < limit * limit) near_[i].push_back(Index(j));
      });
    });
    first = end;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t larger = near_[i].size();  // before those that follow enter themselves
    std::sort(near_[i].begin(), near_[i].end());
    for (std::size_t k = 0; k < larger; ++k) near_[near_[i][k]].push_back(Index(i));
  }
  find_mobilities();
}

void Rearrangement::find_mobilities() {
  mobility_.resize(s_.size());
  for_all(s_.size(), settings_.threads, [&](std::size_t i) {
    double stiffness = 0;
    for (const Index j : near_[i]) stiffness += 1 / ((s_.r[i] + s_.r[j]) * (s_.r[i] + s_.r[j]));
    const double r = s_.r[i];
    mobility_[i] = r * r / std::max(1.0, r * r * stiffness / usual_stiffness);
  });
}

/// All overlapping pairs, and of the others those with the smallest gaps over s, until there are `pairs`. Walls within
/// the same gap are to be touched.
void Rearrangement::find_nearest(std::size_t pairs) {
  const std::size_t n = s_.size();
  const double reach = (1 + closing_reach) * 2 * s_.r.front();
  const Images images(space_, s_.x, reach);
  const CellGrid grid(images.position, reach);
  const auto gap = [&](std::size_t i, std::size_t j) {
    return space_.branch(s_.x[j], s_.x[i]).norm() / (s_.r[i] + s_.r[j]) - 1;
  };
  for_all(n, settings_.threads, [&](std::size_t i) {
    near_[i].clear();
    grid.for_each_near(images.position[i], [&](Index m) {
      const Index j = images.of[m];
      if (j != i && (images.position[i] - images.position[m]).norm() / (s_.r[i] + s_.r[j]) - 1 < closing_reach)
        near_[i].push_back(j);
    });
    std::sort(near_[i].begin(), near_[i].end());
  });
  std::vector<double> gaps;
  for (std::size_t i = 0; i < n; ++i)
    for (const Index j : near_[i])
      if (j > i) gaps.push_back(gap(i, j));
  double limit = closing_reach;
  if (pairs > 0 && gaps.size() > pairs) {
    std::nth_element(gaps.begin(), gaps.begin() + std::ptrdiff_t(pairs - 1), gaps.end());
    limit = std::max(0.0, gaps[pairs - 1]);
  }
  for_all(n, settings_.threads,
          [&](std::size_t i) { std::erase_if(near_[i], [&](Index j) { return gap(i, j) > limit; }); });
  for_all(n, settings_.threads, [&](std::size_t i) {
    touching_[i] = std::uint8_t(region_.walls_near(s_.x[i], s_.r[i], limit));
    confine(i, s_.x[i]);
  });
  find_mobilities();
}

/// Each sphere adds up its own pairs in a fixed order: every pair is met twice, and no result depends on the threads.
void Rearrangement::forces(double scale) {
  for_all(s_.size(), settings_.threads, [&](std::size_t i) {
    Vec3 force = Vec3::Zero();
    double energy = 0;
    for (const Index j : near_[i]) {
      const double s = scale * (s_.r[i] + s_.r[j]);
      const Vec3 d = space_.branch(s_.x[j], s_.x[i]);
      const double square = d.squaredNorm();
      if ((square >= s * s && !closing_) || square == 0) continue;
      const double distance = std::sqrt(square), overlap = 1 - distance / s;
      energy += 0.25 * overlap * overlap;
      force += d * (overlap / (s * distance));
    }
    force_[i] = force;
    energy_of_[i] = energy;
  });
  energy_ = ordered_sum(s_.size(), settings_.threads, [&](std::size_t i) { return energy_of_[i]; });
  largest_energy_ = *std::max_element(energy_of_.begin(), energy_of_.end());
}

}  // namespace breccia::collective_rearrangement
