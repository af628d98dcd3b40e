// SPDX-License-Identifier: BSD-3-Clause
#include "check/made_specimen.hpp"

#include <algorithm>
#include <array>
#include <random>

#include "breccia/images.hpp"
#include "engine/specimen.hpp"

namespace breccia {
namespace {

using Outline = SpecimenShape::Outline;
constexpr double spring = 1e7;  // [N/m]

/// How many along x, y, z.
std::array<int, 3> counts(const MadeForm& f) {
  if (f.periodic) return f.dimension == 2 ? std::array{8, 10, 1} : std::array{5, 5, 6};
  if (f.dimension == 2) return f.outline == Outline::box ? std::array{7, 13, 1} : std::array{13, 13, 1};
  return f.outline == Outline::box ? std::array{5, 5, 9} : std::array{7, 7, 9};
}

}  // namespace

const std::vector<MadeForm>& made_forms() {
  static const std::vector<MadeForm> all = {
      {"3D, box", 3, Outline::box, false},       {"3D, cylinder", 3, Outline::cylinder, false},
      {"2D, rectangle", 2, Outline::box, false}, {"2D, disc", 2, Outline::ellipsoid, false},
      {"3D, periodic", 3, Outline::box, true},   {"2D, periodic", 2, Outline::box, true}};
  return all;
}

PackedParticles made_packing(const MadeForm& form, bool disorder) {
  constexpr double r = made_radius;
  const auto n = counts(form);
  const bool flat = form.dimension == 2;
  std::mt19937_64 random(5);
  const auto uniform = [&] { return disorder ? double(random() >> 11) * 0x1p-52 - 1 : 0.0; };  // -1 to 1
  PackedParticles p;
  p.outline = form.outline;
  p.axis = flat ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 size = 2 * r * Vec3(n[0], n[1], flat ? 0 : n[2]);
  const Vec3 low(-0.5 * size.x(), flat ? 0 : -0.5 * size.y(), 0);
  const Vec3 middle = low + 0.5 * size;
  for (int c = 0; c < n[2]; ++c)
    for (int b = 0; b < n[1]; ++b)
      for (int a = 0; a < n[0]; ++a) {
        Vec3 x = low + r * Vec3(2 * a + 1, 2 * b + 1, flat ? 0 : 2 * c + 1);
        const Vec3 off = x - middle;
        if (form.outline == Outline::cylinder && std::hypot(off.x(), off.y()) + r > 0.5 * size.x() + 1e-9) continue;
        if (form.outline == Outline::ellipsoid && off.norm() + r > 0.5 * size.x() + 1e-9) continue;
        for (int k = 0; k < form.dimension; ++k) x[k] += 0.08 * r * uniform();
        p.position.push_back(x);
        p.radius.push_back(r * (1 + 0.05 * uniform()));
      }
  if (form.periodic) p.period = size;
  return p;
}

MadeSimulation made_simulation(const PackedParticles& packing, int dimension) {
  MadeSimulation s;
  s.dimension = dimension;
  s.thickness = dimension == 2 ? made_thickness : 1;
  s.cell = Cell::box(packing.period);
  const Space space{dimension, s.thickness, s.cell};
  double most = 0;
  for (std::size_t k = 0; k < packing.radius.size(); ++k) {
    s.add_particle(packing.position[k], packing.radius[k]);
    s.mass.back() = 2650 * space.solid_volume(packing.radius[k]);
    most = std::max(most, packing.radius[k]);
  }
  for_each_pair_within(space, s.position, 2 * most * (1 + made_bonding_gap), [&](Index i, Index j) {
    if (space.branch(s.position[i], s.position[j]).norm() <= (s.radius[i] + s.radius[j]) * (1 + made_bonding_gap))
      s.add_bond(i, j);
  });
  s.specimen = measure_specimen(s.position, s.radius, packing.outline, packing.axis, space);
  return s;
}

void displace(MadeSimulation& s, const Mat3& gradient, const Vec3& shift, double time) {
  const Cell before = s.cell;
  for (std::size_t k = 0; k < s.position.size(); ++k) {
    s.position[k] = s.reference[k] + gradient * (s.reference[k] - s.specimen.base) + shift;
    s.resultant[k] = Vec3::Zero();
  }
  const Cell now(Mat3(before.vectors() + gradient * before.vectors()));
  const Space space{s.dimension, s.thickness, before.repeats() ? now : before};
  double stored = 0;
  for (std::size_t k = 0; k < s.pair_i.size(); ++k) {
    const Index i = s.pair_i[k], j = s.pair_j[k];
    const Vec3 branch = space.branch(s.position[i], s.position[j]);
    double stretch = branch.norm() - s.rest_length[k];
    if (s.pair_state[k] != BondState::intact) stretch = std::min(stretch, 0.0);
    const Vec3 force = spring * stretch * branch.normalized();
    s.force[k] = {force.x(), force.y(), force.z(), 0.5 * (branch.norm() - s.radius[i] - s.radius[j])};
    s.resultant[i] += force;
    s.resultant[j] -= force;
    stored += 0.5 * spring * stretch * stretch;
  }
  s.energy.elastic = stored;
  s.energy.boundary_work = stored;
  s.time = time;
  s.step = std::uint64_t(time / s.time_step);
}

MadeSimulation reordered(const MadeSimulation& s, const std::vector<Index>& order) {
  MadeSimulation t = s;
  std::vector<Index> to(order.size());
  for (Index k = 0; k < order.size(); ++k) {
    const Index from = order[k];
    to[from] = k;
    t.position[k] = s.position[from];
    t.reference[k] = s.reference[from];
    t.radius[k] = s.radius[from];
    t.mass[k] = s.mass[from];
    t.id[k] = s.id[from];
    t.resultant[k] = s.resultant[from];
  }
  // Pairs and bonds stand the other way round; which end is i may change with the numbers.
  const std::size_t pairs = s.pair_i.size(), bonds = s.bond_i.size();
  const auto ends = [&](Index i, Index j) { return std::minmax(to[i], to[j]); };
  for (std::size_t k = 0; k < pairs; ++k) {
    const std::size_t from = pairs - 1 - k;
    const auto [i, j] = ends(s.pair_i[from], s.pair_j[from]);
    const double sign = i == to[s.pair_i[from]] ? 1 : -1;
    t.pair_i[k] = i;
    t.pair_j[k] = j;
    t.rest_length[k] = s.rest_length[from];
    t.pair_state[k] = s.pair_state[from];
    t.force[k] = s.force[from];
    for (double* f : {&t.force[k].fx, &t.force[k].fy, &t.force[k].fz}) *f *= sign;
    t.pair_bond[k] =
        s.pair_bond[from] == PairsView::no_bond ? PairsView::no_bond : Index(bonds - 1 - s.pair_bond[from]);
  }
  for (std::size_t b = 0; b < bonds; ++b) {
    const std::size_t from = bonds - 1 - b;
    const auto [i, j] = ends(s.bond_i[from], s.bond_j[from]);
    t.bond_i[b] = i;
    t.bond_j[b] = j;
    t.bond_pair[b] =
        s.bond_pair[from] == BondsView::no_pair ? BondsView::no_pair : Index(pairs - 1 - s.bond_pair[from]);
    t.initial_distance[b] = s.initial_distance[from];
    t.crack_of[b] = s.crack_of[from];
    t.bond_state[b] = s.bond_state[from];
  }
  return t;
}

}  // namespace breccia
