// SPDX-License-Identifier: BSD-3-Clause
#include "run/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  void add(const Vec3& x, double r) {
    low = low.cwiseMin(x - Vec3::Constant(r));
    high = high.cwiseMax(x + Vec3::Constant(r));
  }
};

void check_bonds(const SimulationView& v, const ChecksConfig& limits, Host& host) {
  std::size_t deep = 0, wide = 0;
  const auto& r = v.particles.radius;
  for (std::size_t k = 0; k < v.bonds.size(); ++k) {
    const double touching = r[v.bonds.i[k]] + r[v.bonds.j[k]], distance = v.bonds.initial_distance[k];
    deep += distance < (1 - limits.deep_overlap) * touching;
    wide += distance > (1 + limits.wide_gap) * touching;
  }
  const double all = double(v.bonds.size());
  if (double(deep) > limits.bond_share * all)
    host.warn(
        fmt::format("{:.3g} % of the bonded pairs overlap by more than {:.3g} % of the sum of their radii: are "
                    "the radii right (not diameters)?",
                    100 * double(deep) / all, 100 * limits.deep_overlap));
  if (double(wide) > limits.bond_share * all)
    host.warn(fmt::format(
        "{:.3g} % of the bonds span a gap wider than {:.3g} times the sum of the two radii: is the bonding gap "
        "or tolerance right?",
        100 * double(wide) / all, limits.wide_gap));
}

/// Whether each particle belongs to the largest piece that the bonds hold together.
std::vector<std::uint8_t> main_body(const SimulationView& v) {
  std::vector<Index> root(v.particles.size());
  for (Index a = 0; a < root.size(); ++a) root[a] = a;
  const auto find = [&](Index a) {
    while (root[a] != a) a = root[a] = root[root[a]];
    return a;
  };
  for (std::size_t k = 0; k < v.bonds.size(); ++k) root[find(v.bonds.i[k])] = find(v.bonds.j[k]);
  std::vector<std::size_t> size(root.size(), 0);
  for (Index a = 0; a < root.size(); ++a) ++size[find(a)];
  const Index largest = Index(std::max_element(size.begin(), size.end()) - size.begin());
  std::vector<std::uint8_t> in(root.size());
  for (Index a = 0; a < root.size(); ++a) in[a] = find(a) == largest;
  return in;
}

void check_unbonded(const SimulationView& v, const ChecksConfig& limits, Host& host) {
  const std::size_t n = v.particles.size();
  const std::vector<std::uint8_t> bonded = main_body(v);
  const std::size_t loose = std::size_t(std::count(bonded.begin(), bonded.end(), std::uint8_t(0)));
  if (v.bonds.size() == 0 || loose == 0) return;  // a test without bonds knows what it does
  Box all, held;
  for (std::size_t a = 0; a < n; ++a) {
    all.add(v.particles.position[a], v.particles.radius[a]);
    if (bonded[a]) held.add(v.particles.position[a], v.particles.radius[a]);
  }
  for (int k = 0; k < (v.dimension == 2 ? 2 : 3); ++k) {
    if (v.cell.repeats(k)) continue;
    const double with = all.high[k] - all.low[k], without = held.high[k] - held.low[k];
    if (with <= (1 + limits.stray_growth) * without) continue;
    std::size_t farthest = 0;
    double off = -1;
    for (std::size_t a = 0; a < n; ++a) {
      const double x = v.particles.position[a][k], r = v.particles.radius[a];
      const double beyond = std::max(x + r - held.high[k], held.low[k] - x + r);
      if (!bonded[a] && beyond > off) {
        off = beyond;
        farthest = a;
      }
    }
    host.warn(
        fmt::format("particles without a bond to the rest make the specimen {:.3g} times as long in {} as it is "
                    "without them (particle {} of the packing reaches {:.3g} m beyond): its area, stress and porosity "
                    "are measured with them; remove strays from the packing",
                    with / without, "xyz"[k], v.particles.id[farthest], off));
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
  check_bonds(view, limits, host);
  check_unbonded(view, limits, host);
}

}  // namespace breccia
