// SPDX-License-Identifier: BSD-3-Clause
#include "engine/time_step.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numeric>

#include "engine/contact_stiffness.hpp"
#include "engine/neighbours.hpp"

namespace breccia {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What holds one particle, over its masses: M^-1/2 K M^-1/2 [1/s2] and M^-1/2 C M^-1/2 [1/s].
struct Restraint {
  Mat6 stiffness = Mat6::Zero(), damping = Mat6::Zero();
  bool damped = false;
  Mat6 at(double dt) const { return 0.5 * dt * dt * stiffness + dt * damping; }
};

/// The dt at which the largest eigenvalue of `r.at(dt)` is 1.
double step_of(const Restraint& r) {
  if (!r.damped) {
    const double most = Eigen::SelfAdjointEigenSolver<Mat6>(r.stiffness, Eigen::EigenvaluesOnly).eigenvalues()[5];
    return most > 0 ? 2 / std::sqrt(2 * most) : infinity;
  }
  // Any one direction gives a step that is too long or right; that of the largest eigenvalue there gives the next, and
  // the error is squared each time. No eigenvalue is above the Frobenius norm.
  double dt = breccia::step_of(r.stiffness.norm(), r.damping.norm());
  if (!(dt < infinity)) return infinity;
  for (int k = 0; k < 50; ++k) {
    const Vec6 y = Eigen::SelfAdjointEigenSolver<Mat6>(r.at(dt)).eigenvectors().col(5);
    const double next = breccia::step_of(y.dot(r.stiffness * y), y.dot(r.damping * y));
    if (k > 0 && !(next < dt * (1 - 1e-12))) break;
    dt = next;
  }
  return dt;
}

class Restraints {
 public:
  Restraints(State& s, const Interactions& law, const Incidence& incidence, double reach)
      : s_(s),
        law_(law),
        in_(incidence),
        reach_(reach),
        batch_(whole_batch(s, columns_)),
        touch_start_(s.particles.size() + 1, 0) {
    for (const WallTouch& t : s.wall_touches) ++touch_start_[t.particle + 1];
    for (std::size_t a = 0; a < s.particles.size(); ++a) touch_start_[a + 1] += touch_start_[a];
    touch_.resize(s.wall_touches.size());
    std::vector<Index> next(touch_start_.begin(), touch_start_.end() - 1);
    for (Index t = 0; t < touch_.size(); ++t) touch_[next[s.wall_touches[t].particle]++] = t;
  }

  Restraint of(Index a) const {
    const Particles& p = s_.particles;
    Restraint r;
    for (std::size_t e = in_.start[a]; e < in_.start[a + 1]; ++e) {
      const std::size_t q = in_.entry[e] >> 1;
      const bool second = in_.entry[e] & 1;
      const Index i = s_.pairs.i[q], j = s_.pairs.j[q];
      if (s_.branch(p.position()[i], p.position()[j]).norm() <= 0 || !within_reach(s_, q, p.position(), reach_))
        continue;
      PairBatch one = batch_;
      one.begin = q;
      one.end = q + 1;
      ContactStiffness c;
      law_.stiffness(one, &c);
      const ContactEnd end = end_of(s_, q, second, c);
      add_contact(r.stiffness, end);
      if (c.damping > 0 || c.shear_damping > 0) {
        add_contact(r.damping, dashpot_of(end));
        r.damped = true;
      }
    }
    for (Index t = touch_start_[a]; t < touch_start_[a + 1]; ++t)
      if (const WallTouch& touch = s_.wall_touches[touch_[t]]; within_reach(s_, touch, reach_))
        add_contact(r.stiffness, end_of(s_, touch));
    Vec6 scale;
    const double m = 1 / std::sqrt(p.mass()[a]), turn = 1 / std::sqrt(p.inertia()[a]);
    scale << m, m, m, turn, turn, turn;
    for (int c = 0; c < 6; ++c)
      if (p.held[a] >> c & 1) scale[c] = 0;
    r.stiffness = (scale.asDiagonal() * r.stiffness * scale.asDiagonal()).eval();
    r.damping = (scale.asDiagonal() * r.damping * scale.asDiagonal()).eval();
    return r;
  }

 private:
  State& s_;
  const Interactions& law_;
  const Incidence& in_;
  double reach_;
  std::vector<double*> columns_;
  PairBatch batch_;
  std::vector<Index> touch_start_, touch_;  // wall touches by particle
};

}  // namespace

double critical_time_step(State& s, const Interactions& law, const Incidence& incidence,
                          const std::vector<Index>& particles, double reach, int threads) {
  if (particles.empty()) return infinity;
  const Restraints restraints(s, law, incidence, reach);
  double least = infinity;
#pragma omp parallel num_threads(threads)
  {
    double mine = infinity;
#pragma omp for schedule(static)
    for (std::ptrdiff_t k = 0; k < std::ptrdiff_t(particles.size()); ++k) {
      const Restraint r = restraints.of(particles[k]);
      // A factorisation tells whether the particle allows the step found so far; nearly all do. The margin keeps the
      // result the same in whatever order, and by however many threads, they are looked at.
      const double slack = 1 - 1e-9;
      if (!r.stiffness.allFinite() || !r.damping.allFinite()) {
        mine = 0;  // no step is short enough
        continue;
      }
      if (mine < infinity && (slack * Mat6::Identity() - r.at(mine)).llt().info() == Eigen::Success) continue;
      mine = std::min(mine, step_of(r));
    }
#pragma omp critical
    least = std::min(least, mine);
  }
  return least;
}

std::vector<double> time_step_of_each(State& s, const Interactions& law, const Incidence& incidence, double reach,
                                      int threads) {
  const Restraints restraints(s, law, incidence, reach);
  std::vector<double> steps(s.particles.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t a = 0; a < steps.size(); ++a) {
    const Restraint r = restraints.of(Index(a));
    steps[a] = r.stiffness.allFinite() && r.damping.allFinite() ? step_of(r) : 0;
  }
  return steps;
}

std::optional<StepSetter> find_step_setter(State& s, const Interactions& law, const Incidence& incidence, double reach,
                                           double critical, double ratio, int threads, RankLink* link) {
  const Particles& p = s.particles;
  const std::size_t own = p.end_own() - p.first_own();
  const auto of_all = [&](std::size_t here) {
    if (!link) return here;
    const auto each = link->numbers_of_all(here);
    return std::accumulate(each.begin(), each.end(), std::size_t(0));
  };
  const std::size_t n = of_all(own);
  const double far = ratio * critical;
  if (n < 10 || !std::isfinite(far) || !(far > 0)) return std::nullopt;  // of so few none is the bulk
  const Restraints restraints(s, law, incidence, reach);
  std::vector<std::uint8_t> short_of(p.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t a = std::ptrdiff_t(p.first_own()); a < std::ptrdiff_t(p.end_own()); ++a)
    short_of[a] = (Mat6::Identity() - restraints.of(Index(a)).at(far)).llt().info() != Eigen::Success;
  std::vector<Index> few, rest;
  for (Index a = Index(p.first_own()); a < p.end_own(); ++a) (short_of[a] ? few : rest).push_back(a);
  const std::size_t count = of_all(few.size());
  if (count == 0 || count > std::max<std::size_t>(1, n / 100)) return std::nullopt;
  StepSetter found{0, count - 1, infinity, critical_time_step(s, law, incidence, rest, reach, threads)};
  for (const Index a : few)
    if (const double step = step_of(restraints.of(a)); step < found.step) {
      found.step = step;
      found.particle = p.row_of(a);
    }
  if (link) {  // the first of those with the least
    found.without = link->least_of(found.without);
    const double here = found.step;
    found.step = link->least_of(found.step);
    found.particle = Index(link->least_of(here == found.step ? double(found.particle) : 1e300));
  }
  if (!std::isfinite(found.without)) return std::nullopt;  // nothing else is held by anything stiff
  return found;
}

std::vector<Index> newly_within_reach(const State& s, double reach, const std::vector<WallTouch>* known) {
  const auto now = s.particles.position();
  const auto& then = s.positions_at_look;
  std::vector<std::uint8_t> is_new(now.size(), 0);
  for (std::size_t k = 0; k < s.pairs.size(); ++k)
    if (within_reach(s, k, now, reach) && (then.empty() || !within_reach(s, k, then, reach)))
      is_new[s.pairs.i[k]] = is_new[s.pairs.j[k]] = 1;
  const auto before = [](const WallTouch& a, const WallTouch& b) {
    return a.wall != b.wall ? a.wall < b.wall : a.particle < b.particle;
  };
  for (const WallTouch& t : s.wall_touches)
    if (within_reach(s, t, reach) && !(known && std::binary_search(known->begin(), known->end(), t, before)))
      is_new[t.particle] = 1;
  std::vector<Index> particles;
  for (Index a = Index(s.particles.first_own()); a < s.particles.end_own(); ++a)
    if (is_new[a]) particles.push_back(a);
  return particles;
}

}  // namespace breccia
