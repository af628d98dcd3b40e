// SPDX-License-Identifier: BSD-3-Clause
#include "engine/curve_order.hpp"

#include <algorithm>
#include <array>

#include "engine/migration.hpp"

namespace breccia {
namespace {

using Key = decltype(OnCurve().key());
constexpr int key_bits = 95;

/// Spreads the low 21 bits so that two zero bits follow each.
std::uint64_t spread(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

void set_places(std::vector<OnCurve>& particles, RankLink* link) {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  for (const OnCurve& p : particles) {
    low = low.cwiseMin(p.position);
    high = high.cwiseMax(p.position);
  }
  if (link) {
    std::array<double, 6> most{-low.x(), -low.y(), -low.z(), high.x(), high.y(), high.z()};
    link->largest(most);
    low = -Vec3(most[0], most[1], most[2]);
    high = Vec3(most[3], most[4], most[5]);
  }
  const double scale = 2097151.0 / std::max((high - low).maxCoeff(), 1e-300);
  for (OnCurve& p : particles) {
    const Vec3 cell = (p.position - low) * scale;
    p.place =
        spread(std::uint64_t(cell.x())) | spread(std::uint64_t(cell.y())) << 1 | spread(std::uint64_t(cell.z())) << 2;
  }
}

/// How many of the sorted particles here come before it.
std::size_t before(const std::vector<OnCurve>& sorted, Key key) {
  return std::size_t(
      std::partition_point(sorted.begin(), sorted.end(), [&](const OnCurve& p) { return p.key() < key; }) -
      sorted.begin());
}

/// Where among the sorted particles here each rank's rows begin: at the key that has as many of all ranks before it,
/// found bit by bit, for all of them at once.
std::vector<std::size_t> cuts_of_ranks(const std::vector<OnCurve>& sorted, RankLink& link,
                                       std::span<const Index> first_row) {
  const std::size_t ranks = std::size_t(link.ranks());
  std::vector<Key> begins(ranks, 0);
  std::vector<std::int64_t> count(ranks);
  for (int bit = key_bits - 1; bit >= 0; --bit) {
    const Key step = Key(1) << bit;
    for (std::size_t r = 0; r < ranks; ++r) count[r] = std::int64_t(before(sorted, begins[r] | step));
    link.add(count);
    for (std::size_t r = 1; r < ranks; ++r)
      if (count[r] <= std::int64_t(first_row[r])) begins[r] |= step;
  }
  std::vector<std::size_t> cuts;
  for (const Key key : begins) cuts.push_back(before(sorted, key));
  cuts.front() = 0;
  cuts.push_back(sorted.size());
  return cuts;
}

}  // namespace

void sort_along_curve(std::vector<OnCurve>& particles, RankLink* link, std::span<const Index> first_row) {
  set_places(particles, link);
  std::sort(particles.begin(), particles.end());
  if (!link) return;
  const std::vector<std::size_t> cuts = cuts_of_ranks(particles, *link, first_row);
  std::vector<std::vector<OnCurve>> to(std::size_t(link->ranks()));
  for (std::size_t r = 0; r < to.size(); ++r)
    to[r].assign(particles.begin() + std::ptrdiff_t(cuts[r]), particles.begin() + std::ptrdiff_t(cuts[r + 1]));
  particles = {};
  particles = sent(*link, to);
  std::sort(particles.begin(), particles.end());
}

}  // namespace breccia
