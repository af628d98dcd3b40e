// SPDX-License-Identifier: BSD-3-Clause
#include "check/made_parts.hpp"

#include <algorithm>
#include <numeric>

#include "engine/rows_of_state.hpp"

namespace breccia {
namespace {

constexpr Index none = 0xffffffffu;

void rename(std::vector<Index>& of, const std::vector<Index>& to) {
  for (Index& k : of)
    if (k != none) k = to[k];
}

/// Of pairs and bonds those rows, in that order.
void keep(MadeSimulation& s, const std::vector<Index>& pairs, const std::vector<Index>& bonds) {
  const std::vector<Index> pair_at = inverse(pairs, s.pair_i.size()), bond_at = inverse(bonds, s.bond_i.size());
  for (auto* of : {&s.pair_i, &s.pair_j, &s.pair_bond}) pick(*of, pairs);
  pick(s.rest_length, pairs);
  pick(s.pair_state, pairs);
  pick(s.force, pairs);
  for (auto* of : {&s.bond_i, &s.bond_j, &s.bond_pair, &s.crack_of}) pick(*of, bonds);
  pick(s.initial_distance, bonds);
  pick(s.bond_state, bonds);
  rename(s.pair_bond, bond_at);
  rename(s.bond_pair, pair_at);
}

std::vector<Index> by_ends(const std::vector<Index>& i, const std::vector<Index>& j) {
  std::vector<Index> rows(i.size());
  std::iota(rows.begin(), rows.end(), Index(0));
  std::sort(rows.begin(), rows.end(), [&](Index a, Index b) { return i[a] != i[b] ? i[a] < i[b] : j[a] < j[b]; });
  return rows;
}

}  // namespace

MadeSimulation sorted(const MadeSimulation& simulation) {
  MadeSimulation s = simulation;
  keep(s, by_ends(s.pair_i, s.pair_j), by_ends(s.bond_i, s.bond_j));
  return s;
}

std::array<MadeSimulation, 2> halves(const MadeSimulation& whole) {
  const Index n = Index(whole.position.size()), middle = n / 2 / Index(made_block) * Index(made_block);
  std::array<MadeSimulation, 2> parts;
  for (int half = 0; half < 2; ++half) {
    const Index first = half == 0 ? 0 : middle, behind = half == 0 ? middle : n;
    const auto own = [&](Index a) { return a >= first && a < behind; };
    std::vector<std::uint8_t> wanted(n, 0);
    std::fill(wanted.begin() + first, wanted.begin() + behind, 1);
    const auto touching = [&](const std::vector<Index>& i, const std::vector<Index>& j) {
      std::vector<Index> rows;
      for (Index k = 0; k < i.size(); ++k)
        if (own(i[k]) || own(j[k])) {
          rows.push_back(k);
          wanted[i[k]] = wanted[j[k]] = 1;
        }
      return rows;
    };
    MadeSimulation& s = parts[std::size_t(half)] = whole;
    const std::vector<Index> pairs = touching(s.pair_i, s.pair_j), bonds = touching(s.bond_i, s.bond_j);
    std::vector<Index> rows;
    for (Index a = 0; a < n; ++a)
      if (wanted[a]) rows.push_back(a);
    const std::vector<Index> here = inverse(rows, n);
    keep(s, pairs, bonds);
    for (auto* of : {&s.pair_i, &s.pair_j, &s.bond_i, &s.bond_j}) rename(*of, here);
    for (auto* of : {&s.position, &s.reference, &s.velocity, &s.spin, &s.resultant, &s.torque, &s.applied_force})
      pick(*of, rows);
    for (auto* of : {&s.radius, &s.mass}) pick(*of, rows);
    pick(s.id, rows);
    pick(s.held, rows);
    std::erase_if(s.wall_contacts, [&](const WallContact& c) { return !own(c.particle); });
    for (WallContact& c : s.wall_contacts) c.particle = here[c.particle];
    // What no part is told of copies is not to be relied on.
    const std::size_t own_first = std::size_t(std::lower_bound(rows.begin(), rows.end(), first) - rows.begin());
    const OwnRows particles(own_first, own_first + (behind - first));
    for (std::size_t a = 0; a < rows.size(); ++a)
      if (!particles.contain(a)) s.resultant[a] = s.torque[a] = Vec3::Constant(1e3);
    const auto counted = [&](const std::vector<Index>& i) {
      return OwnRows(std::size_t(std::lower_bound(i.begin(), i.end(), Index(particles.first())) - i.begin()), i.size());
    };
    s.part = PartOfSpecimen{nullptr, particles, counted(s.pair_i), counted(s.bond_i), half, 2, Index(first)};
  }
  return parts;
}

bool TwoParts::Part::meet(const Asked& asked) {
  both_.asked_[number_] = asked;
  both_.both_.arrive_and_wait();
  over = other().act != asked.act || other().size != asked.size;
  if (over && number_ == 0) both_.over_ = true;
  return !over;
}

void TwoParts::Part::add(std::span<ExactSum> sums) {
  const std::vector<ExactSum> mine(sums.begin(), sums.end());
  must_meet({1, sums.size(), mine.data()});
  std::vector<ExactSum> all(sums.size());
  for (const void* of : {both_.asked_[0].of, both_.asked_[1].of})
    for (std::size_t k = 0; k < sums.size(); ++k) all[k].add(static_cast<const ExactSum*>(of)[k]);
  both_.both_.arrive_and_wait();
  std::copy(all.begin(), all.end(), sums.begin());
}

void TwoParts::Part::largest(std::span<double> numbers) {
  const std::vector<double> mine(numbers.begin(), numbers.end());
  must_meet({2, numbers.size(), mine.data()});
  for (std::size_t k = 0; k < numbers.size(); ++k)
    numbers[k] = std::max(numbers[k], static_cast<const double*>(other().of)[k]);
  both_.both_.arrive_and_wait();
}

std::vector<std::byte> TwoParts::Part::all(std::span<const std::byte> own, std::size_t record_bytes) {
  must_meet({3, record_bytes, &own});
  std::vector<std::byte> records;
  for (const Asked& asked : both_.asked_) {
    const auto& of = *static_cast<const std::span<const std::byte>*>(asked.of);
    records.insert(records.end(), of.begin(), of.end());
  }
  both_.both_.arrive_and_wait();
  return records;
}

}  // namespace breccia
