// SPDX-License-Identifier: BSD-3-Clause
#include "candidates.hpp"

#include <algorithm>
#include <cmath>
#include <openturns/DistFunc.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/SobolSequence.hxx>
#include <random>

namespace kriging {

namespace {

constexpr OT::UnsignedInteger everywhere = 1024, nearby = 128;
constexpr double radii[] = {0.2, 0.1, 0.05, 0.02, 0.01, 0.004};

OT::UnsignedInteger top(const OT::Point& scores) {
  return OT::UnsignedInteger(std::max_element(scores.begin(), scores.end()) - scores.begin());
}

}  // namespace

OT::Sample filling(OT::UnsignedInteger dimension, OT::UnsignedInteger first, OT::UnsignedInteger count,
                   OT::UnsignedInteger seed) {
  std::mt19937_64 random(seed);
  std::vector<double> shift(dimension);
  for (double& s : shift) s = double(random() >> 11) * 0x1p-53;
  OT::SobolSequence sequence(dimension);
  const OT::Sample all = sequence.generate(first + count);
  OT::Sample points(count, dimension);
  for (OT::UnsignedInteger i = 0; i < count; ++i)
    for (OT::UnsignedInteger k = 0; k < dimension; ++k) {
      const double moved = all(first + i, k) + shift[k];
      points(i, k) = moved - std::floor(moved);
    }
  return points;
}

OT::Point best_point(const Score& score, const OT::Sample& known, OT::UnsignedInteger seed) {
  const OT::UnsignedInteger dimension = known.getDimension();
  OT::Sample points = filling(dimension, 0, everywhere, seed + 1);  // others than those of the first evaluations
  points.add(known);
  OT::Point scores = score(points);
  OT::Point best = points[top(scores)];
  double highest = scores[top(scores)];
  for (const double radius : radii) {
    OT::Sample around(nearby, dimension);
    for (OT::UnsignedInteger i = 0; i < nearby; ++i)
      for (OT::UnsignedInteger k = 0; k < dimension; ++k)
        around(i, k) = std::clamp(best[k] + radius * OT::DistFunc::qNormal(OT::RandomGenerator::Generate()), 0.0, 1.0);
    scores = score(around);
    if (const OT::UnsignedInteger i = top(scores); scores[i] > highest) {
      highest = scores[i];
      best = around[i];
    }
  }
  return best;
}

}  // namespace kriging
