// SPDX-License-Identifier: BSD-3-Clause
#include "engine/spectral_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

#include "engine/chunks.hpp"
#include "engine/time_step.hpp"

namespace breccia {
namespace {

constexpr double tolerance = 2e-3;  // of the eigenvalue: 1e-3 of the step
/// A random vector sees the largest eigenvalue within 2 % after so many, whatever the spectrum, unless one is unlucky
/// as one in thousands is (Kuczynski and Wozniakowski 1992, Theorem 4.1, at 6e4 degrees of freedom).
constexpr int fewest = 40, most = 200;
constexpr int fewest_again = 8;

/// In [-1, 1), from a counter (Steele et al. 2014, `splitmix64`).
double random_of(std::uint64_t counter) {
  std::uint64_t z = (counter + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return double((z ^ z >> 31) >> 11) * 0x1p-52 - 1;
}

/// Of unit size over the square roots of the masses; zero where held.
void set_random(Vec6& u, const StiffnessOperator& system, std::size_t a, Index id) {
  for (int d = 0; d < 6; ++d)
    u[d] = random_of(6 * std::uint64_t(id) + std::uint64_t(d)) * std::sqrt(system.inverse_mass(a, d));
}

/// A direction with its products.
struct Direction {
  std::vector<Vec6> u, k, c;  // c only with dashpots
  explicit Direction(std::size_t n, bool damped)
      : u(n + 1, Vec6::Zero()), k(n, Vec6::Zero()), c(damped ? n : 0, Vec6::Zero()) {}
};

template <std::size_t N>
using Sums = std::array<double, N>;

/// Sums over own particles, block by block, and over all ranks.
class Summing {
 public:
  Summing(const Particles& p, int threads, RankLink* link) : p_(p), threads_(threads), link_(link) {}
  /// Of what `add(a, sums)` adds.
  template <std::size_t N, class Add>
  Sums<N> of(const Add& add) const {
    std::vector<Sums<N>> blocks(blocks_of(p_), Sums<N>{});
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const std::size_t first = p_.first_own() + b * particle_block;
      for (std::size_t a = first; a < std::min(p_.end_own(), first + particle_block); ++a) add(a, blocks[b]);
    }
    std::vector<ExactSum> sums(N);
    for (const Sums<N>& block : blocks)
      for (std::size_t k = 0; k < N; ++k) sums[k].add(block[k]);
    const std::vector<double> all = totals(sums, link_);
    Sums<N> result;
    std::copy(all.begin(), all.end(), result.begin());
    return result;
  }
  /// Of the vector's rows here, which others may want.
  void share(std::vector<Vec6>& u) const {
    if (link_) link_->forward(u);
  }

 private:
  const Particles& p_;
  int threads_;
  RankLink* link_;
};

/// A symmetric 3 x 3 matrix of products between x, w, p.
Mat3 gram(const double* s) {
  Mat3 m;
  m << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
  return m;
}

/// Coefficients of x, w, p, in the span of the first `n`, with the largest quotient at `dt`.
Vec3 best_of(const Mat3& k, const Mat3& c, const Mat3& m, double dt, int n) {
  const Eigen::MatrixXd a = (0.25 * dt * dt * k + 0.5 * dt * c).topLeftCorner(n, n), b = m.topLeftCorner(n, n);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, b);
  Vec3 y = Vec3::Zero();
  y.head(n) = solver.eigenvectors().col(n - 1);
  return y[0] < 0 ? Vec3(-y) : y;
}

}  // namespace

SpectralStep::Result SpectralStep::climb(const StiffnessOperator& system, const Particles& particles, int threads,
                                         int at_least, RankLink* link) {
  const Summing sum_over(particles, threads, link);
  const std::size_t n = system.size();
  const bool damped = system.damped();
  Direction x(n, damped), w(n, damped), p(n, damped);
  x.u.swap(mode_);
  const auto mass = [&](std::size_t a) {
    Vec6 m;
    for (int d = 0; d < 6; ++d) {
      const double inverse = system.inverse_mass(a, d);
      m[d] = inverse > 0 ? 1 / inverse : 0;
    }
    return m;
  };
  Vec6 none = Vec6::Zero();
  sum_over.share(x.u);
  // Products of x, and its size.
  const Sums<3> first = sum_over.of<3>([&](std::size_t a, Sums<3>& s) {
    system.row(a, x.u.data(), x.k[a], damped ? x.c[a] : none);
    const Vec6 m = mass(a).cwiseProduct(x.u[a]);
    s[0] += m.dot(x.u[a]);
    s[1] += m.dot(x.k[a]);
    if (damped) s[2] += m.dot(x.c[a]);
  });
  Result result{std::numeric_limits<double>::infinity(), 0, 1};
  if (!(first[0] > 0)) {
    mode_.swap(x.u);
    return result;
  }
  double dt = step_of(0.5 * first[1] / first[0], 0.5 * first[2] / first[0]);
  Vec3 y(1 / std::sqrt(first[0]), 0, 0);  // the next x of x, w, p
  for (;; ++result.products) {
    // x and p move on; w is the residual of x.
    const bool bounded = dt < std::numeric_limits<double>::infinity();
    const double qk = bounded ? 0.25 * dt * dt : 0, qc = bounded ? 0.5 * dt : 0;
    const auto move = [&](Vec6& xa, const Vec6& wa, Vec6& pa) {
      pa = y[1] * wa + y[2] * pa;
      xa = y[0] * xa + pa;
    };
    const Sums<2> sizes = sum_over.of<2>([&](std::size_t a, Sums<2>& s) {
      move(x.u[a], w.u[a], p.u[a]);
      move(x.k[a], w.k[a], p.k[a]);
      if (damped) move(x.c[a], w.c[a], p.c[a]);
      w.u[a] = qk * x.k[a] - x.u[a];
      if (damped) w.u[a] += qc * x.c[a];
      const Vec6 m = mass(a);
      s[0] += m.dot(w.u[a].cwiseAbs2());
      s[1] += m.dot(p.u[a].cwiseAbs2());
    });
    result.residual = std::sqrt(sizes[0]);
    result.step = dt;
    if (!bounded || result.residual < 1e-10 || result.products >= most ||
        (result.products >= at_least && result.residual < tolerance))
      break;
    sum_over.share(w.u);
    const double unit_w = 1 / result.residual, unit_p = sizes[1] > 0 ? 1 / std::sqrt(sizes[1]) : 0;
    const Sums<18> s = sum_over.of<18>([&](std::size_t a, Sums<18>& sum) {
      system.row(a, w.u.data(), w.k[a], damped ? w.c[a] : none);
      const Vec6 m = mass(a), mx = m.cwiseProduct(x.u[a]), mw = m.cwiseProduct(w.u[a]), mp = m.cwiseProduct(p.u[a]);
      const auto add = [&](double* to, const Vec6& xa, const Vec6& wa, const Vec6& pa) {
        to[0] += mx.dot(xa);
        to[1] += mx.dot(wa);
        to[2] += mx.dot(pa);
        to[3] += mw.dot(wa);
        to[4] += mw.dot(pa);
        to[5] += mp.dot(pa);
      };
      add(&sum[0], x.u[a], w.u[a], p.u[a]);
      add(&sum[6], x.k[a], w.k[a], p.k[a]);
      if (damped) add(&sum[12], x.c[a], w.c[a], p.c[a]);
    });
    const Vec3 unit(1, unit_w, unit_p);
    const auto scaled = [&](const double* of) { return Mat3(unit.asDiagonal() * gram(of) * unit.asDiagonal()); };
    const Mat3 m = scaled(&s[0]), k = scaled(&s[6]), c = scaled(&s[12]);
    const bool apart = unit_p > 0 && m.determinant() > 1e-10;  // else p says nothing that x and w do not
    y = best_of(k, c, m, dt, apart ? 3 : 2);
    const double size = y.dot(m * y), next = step_of(0.5 * y.dot(k * y) / size, 0.5 * y.dot(c * y) / size);
    dt = std::min(dt, next);
    y = (unit.asDiagonal() * y).eval() / std::sqrt(size);
  }
  mode_.swap(x.u);
  products_ += result.products;
  // dt^2 K + dt C falls at least as dt, and without C as dt^2.
  result.step /= damped ? 1 + result.residual : std::sqrt(1 + result.residual);
  return result;
}

void SpectralStep::remember(const State& s, double reach) {
  std::vector<WallTouch> near;
  for (const WallTouch& t : s.wall_touches)
    if (within_reach(s, t, reach)) near.push_back(t);
  known_touches_.swap(near);
}

std::vector<Index> SpectralStep::changed(const State& s, double reach) const {
  return newly_within_reach(s, reach, &known_touches_);
}

SpectralStep::Result SpectralStep::estimate(State& s, const Interactions& law, const Incidence& in, double reach,
                                            int threads, RankLink* link) {
  const StiffnessOperator system(s, law, in, reach, threads, link);
  mode_.assign(system.size() + 1, Vec6::Zero());
  for (std::size_t a = 0; a < system.size(); ++a) set_random(mode_[a], system, a, s.particles.id[a]);
  remember(s, reach);
  return climb(system, s.particles, threads, fewest, link);
}

SpectralStep::Result SpectralStep::look(State& s, const Interactions& law, const Incidence& in, double reach,
                                        int threads, const std::vector<Index>& changed, double bound_of_changed,
                                        double step, RankLink* link) {
  remember(s, reach);
  const Result unchanged{step, 0, 0};
  if (!any_rank(link, !changed.empty())) return unchanged;
  const StiffnessOperator system(s, law, in, reach, threads, link);
  const Summing sum_over(s.particles, threads, link);
  const bool damped = system.damped();
  if (bound_of_changed >= step) {
    sum_over.share(mode_);
    const Sums<3> sums = sum_over.of<3>([&](std::size_t a, Sums<3>& sum) {
      Vec6 k, c = Vec6::Zero(), m;
      system.row(a, mode_.data(), k, c);
      for (int d = 0; d < 6; ++d) {
        const double inverse = system.inverse_mass(a, d);
        m[d] = inverse > 0 ? mode_[a][d] / inverse : 0;
      }
      sum[0] += m.dot(mode_[a]);
      sum[1] += m.dot(k);
      if (damped) sum[2] += m.dot(c);
    });
    ++products_;
    if (step_of(0.5 * sums[1] / sums[0], 0.5 * sums[2] / sums[0]) >= step) return unchanged;
  }
  // The old mode and, as large, a random vector of those that changed.
  std::vector<ExactSum> sizes(1);
  std::vector<Vec6> fresh(changed.size());
  for (std::size_t k = 0; k < changed.size(); ++k) {
    set_random(fresh[k], system, changed[k], s.particles.id[changed[k]]);
    for (int d = 0; d < 6; ++d)
      if (const double inverse = system.inverse_mass(changed[k], d); inverse > 0)
        sizes[0].add(fresh[k][d] * fresh[k][d] / inverse);
  }
  const double size = totals(sizes, link)[0];
  if (size > 0)
    for (std::size_t k = 0; k < changed.size(); ++k) mode_[changed[k]] += fresh[k] / std::sqrt(size);
  return climb(system, s.particles, threads, fewest_again, link);
}

}  // namespace breccia
