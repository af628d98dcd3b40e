// SPDX-License-Identifier: BSD-3-Clause
#include "engine/bonding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "breccia/error.hpp"
#include "breccia/images.hpp"
#include "engine/cell_motion.hpp"

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

std::vector<Candidate> pairs_within(const State& s, GapMeasure measure, double limit) {
  const Particles& p = s.particles;
  const double largest = *std::max_element(p.radius().begin(), p.radius().end());
  const bool relative = measure == GapMeasure::relative;
  std::vector<Candidate> found;
  const double reach = reach_of(largest, relative, limit);
  refuse_narrow_cell(s, reach);
  for_each_pair_within(s, p.position(), reach, [&](Index i, Index j) {
    const double d = s.branch(p.position()[i], p.position()[j]).norm(), touching = p.radius()[i] + p.radius()[j];
    const double gap = relative ? d / touching - 1 : d - touching;
    if (gap <= limit) found.push_back({i, j, d, gap});
  });
  return found;
}

/// Far more than any packing needs; a limit of a metre in place of a millimetre asks for all pairs there are, and for
/// all memory. Counting needs none.
void refuse_too_many(const State& s, const BondingResult& rule) {
  const Particles& p = s.particles;
  constexpr std::size_t most = 350;  // bonds a particle; within five times the sum of the radii there are about 300
  if (p.size() <= 2 * most) return;
  const double largest = *std::max_element(p.radius().begin(), p.radius().end());
  const bool relative = rule.measure == GapMeasure::relative;
  std::size_t count = 0;
  CellGrid(p.position(), reach_of(largest, relative, rule.limit)).for_each_pair([&](Index i, Index j) {
    const double reach =
        relative ? (1 + rule.limit) * (p.radius()[i] + p.radius()[j]) : p.radius()[i] + p.radius()[j] + rule.limit;
    if ((p.position()[j] - p.position()[i]).squaredNorm() > reach * reach) return;
    if (++count <= most * p.size()) return;
    char text[32];
    std::snprintf(text, sizeof text, relative ? "%.4g" : "%.4g m", rule.limit);
    throw UserError(std::string("bonding.") + (relative ? "tolerance" : "gap") + ": within " + text + " the " +
                    std::to_string(p.size()) + " particles have more than " + std::to_string(2 * most) +
                    " neighbours each, where some 12 are bonded as a rule: is its unit right?");
  });
}

/// The candidates with the smallest gaps, as many as asked; equal gaps stand or fall together, so a lattice stays one.
std::vector<Candidate> nearest_pairs(const State& s, GapMeasure measure, std::size_t wanted, double& limit) {
  double mean = 0;
  for (const double r : s.particles.radius()) mean += r / double(s.particles.size());
  const double unit = measure == GapMeasure::relative ? 1.0 : 2 * mean;
  for (double reach = 0.25; reach < 8; reach *= 2) {
    std::vector<Candidate> found = pairs_within(s, measure, reach * unit);
    if (found.size() < wanted) continue;
    std::vector<double> gaps(found.size());
    std::transform(found.begin(), found.end(), gaps.begin(), [](const Candidate& c) { return c.gap; });
    std::nth_element(gaps.begin(), gaps.begin() + std::ptrdiff_t(wanted - 1), gaps.end());
    limit = gaps[wanted - 1] + 1e-12 * (unit + std::abs(gaps[wanted - 1]));
    std::erase_if(found, [&](const Candidate& c) { return c.gap > limit; });
    return found;
  }
  throw UserError(
      "bonding.coordination_number: so few neighbours exist that it cannot be reached even by bonds across gaps of "
      "several radii");
}

}  // namespace

BondingResult choose_bonds(const State& state, const BondingRule& rule, Bonds& bonds) {
  const Particles& p = state.particles;
  BondingResult result{rule.measure};
  std::vector<Candidate> chosen;
  if (rule.coordination_number) {
    const auto wanted = std::size_t(std::llround(0.5 * *rule.coordination_number * double(p.size())));
    if (wanted > p.size() * (p.size() - 1) / 2)
      throw UserError("bonding.coordination_number: " + std::to_string(p.size()) +
                      " particles cannot have that many neighbours");
    if (wanted > 0) chosen = nearest_pairs(state, rule.measure, wanted, result.limit);
  } else {
    result.limit = *rule.limit;
    refuse_too_many(state, result);
    chosen = pairs_within(state, rule.measure, result.limit);
  }
  std::sort(chosen.begin(), chosen.end(),
            [](const Candidate& a, const Candidate& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
  Bonds b;
  for (auto* numbers : {&b.i, &b.j}) numbers->reserve(chosen.size());
  b.initial_distance.reserve(chosen.size());
  for (const Candidate& c : chosen) {
    if (c.distance <= 0) throw UserError("two particles of the packing have the same centre: they cannot be bonded");
    b.i.push_back(c.i);
    b.j.push_back(c.j);
    b.initial_distance.push_back(c.distance);
  }
  const std::size_t n = b.i.size();
  b.pair.assign(n, BondsView::no_pair);
  b.state.assign(n, BondState::intact);
  b.crack_of.assign(n, BondsView::no_crack);
  bonds = std::move(b);
  result.coordination_number = 2.0 * double(n) / double(p.size());
  return result;
}

}  // namespace breccia
