// SPDX-License-Identifier: BSD-3-Clause
#include "engine/bonding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "breccia/error.hpp"
#include "breccia/images.hpp"
#include "breccia/result_tools/order_statistics.hpp"
#include "engine/cell_motion.hpp"
#include "engine/exact_sum.hpp"
#include "engine/parts.hpp"

namespace breccia {
namespace {

struct Candidate {
  Index i, j;
  double distance, gap;
};

/// How far apart the centres of a bond may be [m].
double reach_of(double largest_radius, bool relative, double limit) {
  return 2 * largest_radius * (1 + (relative ? limit : std::max(0.0, 0.5 * limit / largest_radius)));
}

/// The particles to be bonded: all, or those of this part, with what is asked of the others.
class Specimen {
 public:
  Specimen(State& state, Parts* parts)
      : s_(state), parts_(parts), link_(parts ? &parts->link() : nullptr), particles_(state.particles.size()) {
    const auto r = state.particles.radius();
    largest_ = largest_of_ranks(link_, *std::max_element(r.begin(), r.end()));
    std::vector<ExactSum> sum(1);
    for (const double one : r) sum[0].add(one);
    if (parts) particles_ = parts->rows();
    mean_ = totals(sum, link_)[0] / double(particles_);
  }
  bool is_whole() const { return !parts_; }
  std::size_t particles() const { return particles_; }
  double largest_radius() const { return largest_; }  // [m]
  double mean_radius() const { return mean_; }        // [m]

  std::vector<Candidate> pairs_within(GapMeasure measure, double limit) const {
    const bool relative = measure == GapMeasure::relative;
    const double reach = reach_of(largest_, relative, limit);
    refuse_narrow_cell(s_, reach);
    Bonds none;
    if (parts_) parts_->renew_copies(s_, none, std::max(0.0, relative ? 2 * largest_ * limit : limit));
    const Particles& p = s_.particles;
    std::vector<Candidate> found;
    for_each_pair_within(s_, p.position(), reach, [&](Index i, Index j) {
      if (!p.own(i) && !p.own(j)) return;
      const double d = s_.branch(p.position()[i], p.position()[j]).norm(), touching = p.radius()[i] + p.radius()[j];
      const double gap = relative ? d / touching - 1 : d - touching;
      if (gap <= limit) found.push_back({i, j, d, gap});
    });
    return found;
  }
  /// Own ones stand before others in no order; a pair is counted by the part of its lower particle.
  bool counts(const Candidate& c) const { return s_.particles.own(c.i); }
  std::size_t number_of(const std::vector<Candidate>& pairs) const {
    return total(std::size_t(std::count_if(pairs.begin(), pairs.end(), [&](const Candidate& c) { return counts(c); })));
  }
  std::size_t total(std::size_t here) const {
    std::int64_t number = std::int64_t(here);
    if (link_) link_->add({&number, 1});
    return std::size_t(number);
  }

 private:
  State& s_;
  Parts* parts_;
  RankLink* link_;
  std::size_t particles_;
  double largest_, mean_;
};

/// Of all ranks' gaps that which has `before` smaller ones or as small.
double gap_at(const Specimen& all, std::vector<double> gaps, std::size_t before) {
  if (all.is_whole()) {
    std::nth_element(gaps.begin(), gaps.begin() + std::ptrdiff_t(before), gaps.end());
    return gaps[before];
  }
  return numbers_behind(std::move(gaps), {&before, 1}, [&](std::span<std::int64_t> counts) {
    for (std::int64_t& c : counts) c = std::int64_t(all.total(std::size_t(c)));
  })[0];
}

/// Far more than any packing needs; a limit of a metre in place of a millimetre asks for all pairs there are, and for
/// all memory. Counting needs none. Of a specimen in parts each counts its own, near ones or not.
void refuse_too_many(const State& s, const Specimen& all, const BondingResult& rule) {
  const Particles& p = s.particles;
  constexpr std::size_t most = 350;  // bonds a particle; within five times the sum of the radii there are about 300
  if (all.particles() <= 2 * most) return;
  const bool relative = rule.measure == GapMeasure::relative;
  struct Enough {};
  std::size_t count = 0;
  try {
    CellGrid(p.position(), reach_of(all.largest_radius(), relative, rule.limit)).for_each_pair([&](Index i, Index j) {
      const double reach =
          relative ? (1 + rule.limit) * (p.radius()[i] + p.radius()[j]) : p.radius()[i] + p.radius()[j] + rule.limit;
      if ((p.position()[j] - p.position()[i]).squaredNorm() > reach * reach) return;
      if (++count > most * p.size()) throw Enough();
    });
  } catch (const Enough&) {}
  if (all.total(count > most * p.size()) == 0) return;
  char text[32];
  std::snprintf(text, sizeof text, relative ? "%.4g" : "%.4g m", rule.limit);
  throw UserError(std::string("bonding.") + (relative ? "tolerance" : "gap") + ": within " + text + " the " +
                  std::to_string(all.particles()) + " particles have more than " + std::to_string(2 * most) +
                  " neighbours each, where some 12 are bonded as a rule: is its unit right?");
}

/// The candidates with the smallest gaps, as many as asked; equal gaps stand or fall together, so a lattice stays one.
std::vector<Candidate> nearest_pairs(const Specimen& all, GapMeasure measure, std::size_t wanted, double& limit) {
  const double unit = measure == GapMeasure::relative ? 1.0 : 2 * all.mean_radius();
  for (double reach = 0.25; reach < 8; reach *= 2) {
    std::vector<Candidate> found = all.pairs_within(measure, reach * unit);
    if (all.number_of(found) < wanted) continue;
    std::vector<double> gaps;
    for (const Candidate& c : found)
      if (all.counts(c)) gaps.push_back(c.gap);
    const double last = gap_at(all, std::move(gaps), wanted - 1);
    limit = last + 1e-12 * (unit + std::abs(last));
    std::erase_if(found, [&](const Candidate& c) { return c.gap > limit; });
    return found;
  }
  throw UserError(
      "bonding.coordination_number: so few neighbours exist that it cannot be reached even by bonds across gaps of "
      "several radii");
}

}  // namespace

BondingResult choose_bonds(State& state, const BondingRule& rule, Bonds& bonds, Parts* parts) {
  const Specimen all(state, parts);
  BondingResult result{rule.measure};
  std::vector<Candidate> chosen;
  if (rule.coordination_number) {
    const auto wanted = std::size_t(std::llround(0.5 * *rule.coordination_number * double(all.particles())));
    if (wanted > all.particles() * (all.particles() - 1) / 2)
      throw UserError("bonding.coordination_number: " + std::to_string(all.particles()) +
                      " particles cannot have that many neighbours");
    if (wanted > 0) chosen = nearest_pairs(all, rule.measure, wanted, result.limit);
  } else {
    result.limit = *rule.limit;
    refuse_too_many(state, all, result);
    chosen = all.pairs_within(rule.measure, result.limit);
  }
  std::sort(chosen.begin(), chosen.end(),
            [](const Candidate& a, const Candidate& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
  Bonds b;
  for (auto* numbers : {&b.i, &b.j}) numbers->reserve(chosen.size());
  b.initial_distance.reserve(chosen.size());
  std::size_t coincident = 0;
  for (const Candidate& c : chosen) {
    coincident += c.distance <= 0;
    b.i.push_back(c.i);
    b.j.push_back(c.j);
    b.initial_distance.push_back(c.distance);
  }
  if (all.total(coincident) > 0)
    throw UserError("two particles of the packing have the same centre: they cannot be bonded");
  const std::size_t n = b.i.size();
  b.pair.assign(n, BondsView::no_pair);
  b.state.assign(n, BondState::intact);
  b.crack_of.assign(n, BondsView::no_crack);
  bonds = std::move(b);
  result.bonds = all.number_of(chosen);
  result.coordination_number = 2.0 * double(result.bonds) / double(all.particles());
  return result;
}

}  // namespace breccia
