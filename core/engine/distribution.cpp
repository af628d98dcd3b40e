// SPDX-License-Identifier: BSD-3-Clause
#include "engine/distribution.hpp"

#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/uniform.hpp>
#include <boost/math/distributions/weibull.hpp>
#include <cmath>

namespace breccia {
namespace {

/// `f` of the distribution as Boost has it.
template <class F>
double with(const Distribution& d, F&& f) {
  namespace bm = boost::math;
  switch (d.shape) {
    case Distribution::Shape::lognormal: {
      const double variance = std::log1p(d.deviation * d.deviation / (d.mean * d.mean));
      return f(bm::lognormal(std::log(d.mean) - 0.5 * variance, std::sqrt(variance)));
    }
    case Distribution::Shape::weibull:
      return f(bm::weibull(d.modulus, d.mean / std::tgamma(1 + 1 / d.modulus)));
    case Distribution::Shape::uniform: {
      const double half = std::sqrt(3.0) * d.deviation;
      return f(bm::uniform(d.mean - half, d.mean + half));
    }
    default:
      return f(bm::normal(d.mean, d.deviation));
  }
}

/// The share below a limit; what begins at zero has none below it.
double share_below(const Distribution& d, double limit) {
  return with(d, [&](const auto& as) {
    const double least = boost::math::support(as).first;
    return limit <= least ? 0.0 : boost::math::cdf(as, limit);
  });
}

}  // namespace

double Distribution::standard_deviation() const {
  return with(*this, [](const auto& as) { return boost::math::standard_deviation(as); });
}

double Distribution::share_within() const {
  return (upper ? share_below(*this, *upper) : 1.0) - (lower ? share_below(*this, *lower) : 0.0);
}

double Distribution::quantile(double u) const {
  const double below = lower ? share_below(*this, *lower) : 0.0, up_to = upper ? share_below(*this, *upper) : 1.0;
  const double share = std::clamp(below + u * (up_to - below), 0x1p-60, 1 - 0x1p-53);
  double value = with(*this, [&](const auto& as) { return boost::math::quantile(as, share); });
  if (lower) value = std::max(value, *lower);
  if (upper) value = std::min(value, *upper);
  return value;
}

}  // namespace breccia
