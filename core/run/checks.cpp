// SPDX-License-Identifier: BSD-3-Clause
#include "run/checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "breccia/result_tools/connected.hpp"

namespace breccia {
namespace {

struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  void add(const Vec3& x, double r) {
    low = low.cwiseMin(x - Vec3::Constant(r));
    high = high.cwiseMax(x + Vec3::Constant(r));
  }
  /// Around those of all parts.
  void meet(const SimulationView& v) {
    double most[6] = {-low.x(), -low.y(), -low.z(), high.x(), high.y(), high.z()};
    v.max(most);
    low = -Vec3(most[0], most[1], most[2]);
    high = Vec3(most[3], most[4], most[5]);
  }
};

/// Returns how many there are.
std::size_t check_bonds(const SimulationView& v, const ChecksConfig& limits, Host& host) {
  ExactSumOf<Eigen::Vector3d> counts;  // all, those that overlap deeply, those across wide gaps
  Eigen::Vector3d here = Eigen::Vector3d::Zero();
  const auto& r = v.particles.radius;
  for (const std::size_t k : v.own_bonds()) {
    const double touching = r[v.bonds.i[k]] + r[v.bonds.j[k]], distance = v.bonds.initial_distance[k];
    here +=
        Eigen::Vector3d(1, distance<(1 - limits.deep_overlap) * touching, distance>(1 + limits.wide_gap) * touching);
  }
  counts.add(here);
  const Eigen::Vector3d of_all = v.sum(counts);
  const double all = of_all[0], deep = of_all[1], wide = of_all[2];
  if (deep > limits.bond_share * all)
    host.warn(
        fmt::format("{:.3g} % of the bonded pairs overlap by more than {:.3g} % of the sum of their radii: are "
                    "the radii right (not diameters)?",
                    100 * deep / all, 100 * limits.deep_overlap));
  if (wide > limits.bond_share * all)
    host.warn(fmt::format(
        "{:.3g} % of the bonds span a gap wider than {:.3g} times the sum of the two radii: is the bonding gap "
        "or tolerance right?",
        100 * wide / all, limits.wide_gap));
  return std::size_t(all);
}

/// The body of the most particles, of several the first of the packing.
Body main_body(const SimulationView& v, const Bodies& bodies) {
  const auto smaller = [](const Body& a, const Body& b) {
    return a.size != b.size ? a.size < b.size : a.first > b.first;
  };
  std::vector<Body> best;  // of each part
  if (!bodies.here.empty()) best = {*std::max_element(bodies.here.begin(), bodies.here.end(), smaller)};
  best = v.all(best);
  best.insert(best.end(), bodies.shared.begin(), bodies.shared.end());
  return *std::max_element(best.begin(), best.end(), smaller);
}

void check_unbonded(const SimulationView& v, const ChecksConfig& limits, Host& host) {
  ExactSumOf<std::size_t> particles;
  particles.add(v.own_particles().size());
  const std::size_t n = v.sum(particles);
  const Bodies bodies = find_bodies(v);
  const Body body = main_body(v, bodies);
  const std::size_t loose = n - body.size;
  if (loose == 0) return;
  const auto bonded = [&](std::size_t a) { return bodies.of[a] == body.first; };
  Box all, held;
  for (const std::size_t a : v.own_particles()) {
    all.add(v.particles.position[a], v.particles.radius[a]);
    if (bonded(a)) held.add(v.particles.position[a], v.particles.radius[a]);
  }
  all.meet(v);
  held.meet(v);
  for (int k = 0; k < (v.dimension == 2 ? 2 : 3); ++k) {
    if (v.cell.repeats(k)) continue;
    const double with = all.high[k] - all.low[k], without = held.high[k] - held.low[k];
    if (with <= (1 + limits.stray_growth) * without) continue;
    struct Far {
      double off;
      Index id;
    };
    std::vector<Far> farthest;  // here, then of each part
    for (const std::size_t a : v.own_particles()) {
      if (bonded(a)) continue;
      const double x = v.particles.position[a][k], r = v.particles.radius[a];
      const double beyond = std::max(x + r - held.high[k], held.low[k] - x + r);
      if (farthest.empty()) farthest.push_back({beyond, v.particles.id[a]});
      else if (beyond > farthest[0].off) farthest[0] = {beyond, v.particles.id[a]};
    }
    farthest = v.all(farthest);
    const Far most = *std::max_element(farthest.begin(), farthest.end(),
                                       [](const Far& one, const Far& other) { return one.off < other.off; });
    host.warn(
        fmt::format("particles without a bond to the rest make the specimen {:.3g} times as long in {} as it is "
                    "without them (particle {} of the packing reaches {:.3g} m beyond): its area, stress and porosity "
                    "are measured with them; remove strays from the packing",
                    with / without, "xyz"[k], most.id, most.off));
    break;
  }
  if (double(loose) > limits.unbonded_share * double(n))
    host.warn(fmt::format(
        "{} of {} particles have no bond to the rest: is the packing dense enough, and the bonding tolerance "
        "wide enough?",
        loose, n));
}

}  // namespace

// Dense random packings of the shipped workflows stay far from these.
void check_specimen(const SimulationView& view, double porosity, const ChecksConfig& limits, Host& host) {
  if (limits.negative_porosity && porosity < 0)
    host.warn(
        fmt::format("the porosity is {:.3g}, below zero: the particles have more volume than the specimen. Are "
                    "diameters given where radii are meant?",
                    porosity));
  if (check_bonds(view, limits, host) > 0) check_unbonded(view, limits, host);  // without any a test knows what it does
}

}  // namespace breccia
