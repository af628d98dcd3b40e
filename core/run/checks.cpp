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
void ChecksConfig::describe(Schema<ChecksConfig>& s) {
  s.param("implausible_values", &ChecksConfig::implausible_values)
      .fallback(true)
      .doc(
          "warns of moduli, strengths, densities, velocities and coefficients of friction that are far from any rock "
          "or test, as when a unit was mistaken; `validate` says it, too");
  s.param("negative_porosity", &ChecksConfig::negative_porosity)
      .fallback(true)
      .doc("warns when the particles have more volume than the specimen, as when diameters are given for radii");
  s.param("deep_overlap", &ChecksConfig::deep_overlap)
      .above(0)
      .fallback(0.2)
      .doc("bonded pairs that overlap by more than this share of the sum of their radii are deep ones; 1: none is");
  s.param("wide_gap", &ChecksConfig::wide_gap)
      .above(0)
      .fallback(1.0)
      .doc(
          "bonds across gaps of more than this many times the sum of the two radii are wide ones; very large: none is");
  s.param("bond_share", &ChecksConfig::bond_share)
      .at_least(0)
      .at_most(1)
      .fallback(0.1)
      .doc("warns when more than this share of the bonds have deep overlaps, or wide gaps; 1: never");
  s.param("unbonded_share", &ChecksConfig::unbonded_share)
      .at_least(0)
      .at_most(1)
      .fallback(0.05)
      .doc("warns when more than this share of the particles have no bond to the largest bonded piece; 1: never");
  s.param("stray_growth", &ChecksConfig::stray_growth)
      .at_least(0)
      .fallback(0.02)
      .doc(
          "warns when particles without a bond to that piece make the specimen longer, in any direction, by more than "
          "this share of its length; very large: never");
  s.param("time_step_ratio", &ChecksConfig::time_step_ratio)
      .at_least(1)
      .fallback(3.0)
      .doc(
          "warns when one particle, or at most 1 % of them, makes the time step more than this many times shorter than "
          "it were without them; very large: never");
  s.param("wall_overlap", &ChecksConfig::wall_overlap)
      .above(0)
      .fallback(0.3)
      .doc("warns when a particle stands deeper in a wall than this share of its radius; very large: never");
  s.param("pair_overlap", &ChecksConfig::pair_overlap)
      .above(0)
      .fallback(0.5)
      .doc(
          "warns when two particles without an intact bond are pressed into each other by more than this share of the "
          "sum of their radii; 1: never");
  s.param("wall_speed", &ChecksConfig::wall_speed)
      .above(0)
      .fallback(0.01)
      .doc(
          "warns when a wall, or a particle that the test leads, moves faster than this share of the speed of waves in "
          "the bonded specimen; very large: never");
  s.param("unbalanced_force", &ChecksConfig::unbalanced_force)
      .above(0)
      .fallback(0.2)
      .doc(
          "warns when the unbalanced force ratio (mean resultant on a particle over mean contact force) exceeds this "
          "while the load rises from 10 to 90 % of its peak: the test is not quasi-static; very large: never");
  s.param("flown_off", &ChecksConfig::flown_off)
      .above(0)
      .fallback(1.0)
      .doc("warns when particles end farther outside the specimen than this many times its length; very large: never");
}

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
