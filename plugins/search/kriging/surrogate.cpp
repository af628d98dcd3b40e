// SPDX-License-Identifier: BSD-3-Clause
#include "surrogate.hpp"

#include <algorithm>
#include <cmath>
#include <openturns/Cobyla.hxx>
#include <openturns/ConstantBasisFactory.hxx>
#include <openturns/Exception.hxx>
#include <openturns/KrigingAlgorithm.hxx>
#include <openturns/LinearBasisFactory.hxx>
#include <openturns/MaternModel.hxx>
#include <openturns/MultiStart.hxx>
#include <openturns/SobolSequence.hxx>

namespace kriging {

namespace {

// In units of the cube and of the values' own deviation: a length beyond which nothing is told apart from a straight
// line, one below which points would know nothing of each other; an amplitude that is nothing beside the trend.
constexpr double shortest = 0.1, longest = 10, least = 0.003, largest = 10;
constexpr double jitter = 1e-6;  // variance that keeps the matrix positive where runs have no scatter
constexpr OT::UnsignedInteger starts = 6;

/// Lengths and amplitudes of one order of magnitude each: the likelihood has more than one summit.
OT::Sample spread(const OT::Interval& bounds) {
  OT::SobolSequence sequence(bounds.getDimension());
  OT::Sample points = sequence.generate(starts);
  for (OT::UnsignedInteger i = 0; i < points.getSize(); ++i)
    for (OT::UnsignedInteger k = 0; k < points.getDimension(); ++k) {
      const double low = bounds.getLowerBound()[k], high = bounds.getUpperBound()[k];
      points(i, k) = low * std::pow(high / low, points(i, k));
    }
  return points;
}

}  // namespace

Surrogate::Surrogate(const OT::Sample& points, const OT::Point& values, const OT::Point& variance,
                     const Settings& settings)
    : settings_(settings), points_(points), values_(values), noise_(variance) {
  const OT::UnsignedInteger n = values.getSize();
  for (OT::UnsignedInteger i = 0; i < n; ++i) middle_ += values[i] / double(n);
  double sum = 0;
  for (OT::UnsignedInteger i = 0; i < n; ++i) sum += (values[i] - middle_) * (values[i] - middle_);
  if (sum > 0) unit_ = std::sqrt(sum / double(n));
  for (OT::UnsignedInteger i = 0; i < n; ++i) {
    values_[i] = (values_[i] - middle_) / unit_;
    noise_[i] = noise_[i] / (unit_ * unit_) + jitter;
  }
  fit(true);
}

void Surrogate::fit(bool learn) {
  const OT::UnsignedInteger dimension = points_.getDimension();
  const bool slopes = settings_.linear_trend && points_.getSize() >= dimension + 3;
  const OT::Basis trend =
      slopes ? OT::LinearBasisFactory(dimension).build() : OT::ConstantBasisFactory(dimension).build();
  if (learn) covariance_ = OT::MaternModel(OT::Point(dimension, 1.0), OT::Point(1, 0.5), settings_.smoothness);
  OT::Sample values(values_.getSize(), 1);
  for (OT::UnsignedInteger i = 0; i < values_.getSize(); ++i) values(i, 0) = values_[i];
  OT::KrigingAlgorithm algorithm(points_, values, covariance_, trend);
  algorithm.setNoise(noise_);
  algorithm.setOptimizeParameters(learn);
  if (learn) {
    OT::Point low(dimension, shortest), high(dimension, longest);
    low.add(least);
    high.add(largest);
    const OT::Interval bounds(low, high);
    algorithm.setOptimizationBounds(bounds);
    OT::Cobyla local;
    local.setIgnoreFailure(true);
    local.setMaximumEvaluationNumber(40 * (dimension + 1));
    OT::MultiStart from_each(local, spread(bounds));
    from_each.setMaximumEvaluationNumber(starts * local.getMaximumEvaluationNumber());
    algorithm.setOptimizationAlgorithm(from_each);
  }
  try {
    algorithm.run();
  } catch (const OT::Exception&) {  // no start led anywhere: lengths and amplitude stay the usual ones
    if (!learn) throw;
    return fit(false);
  }
  result_ = algorithm.getResult();
  covariance_ = result_.getCovarianceModel();
}

Predicted Surrogate::operator()(const OT::Sample& points) const {
  const OT::Sample mean = result_.getConditionalMean(points), variance = result_.getConditionalMarginalVariance(points);
  Predicted all{OT::Point(points.getSize()), OT::Point(points.getSize())};
  for (OT::UnsignedInteger i = 0; i < points.getSize(); ++i) {
    all.value[i] = middle_ + unit_ * mean(i, 0);
    all.deviation[i] = unit_ * std::sqrt(std::max(0.0, variance(i, 0)));
  }
  return all;
}

void Surrogate::believe(const OT::Point& point) {
  OT::Sample one(1, point.getDimension());
  one[0] = point;
  const double value = result_.getConditionalMean(one)(0, 0);
  double noise = 0;
  for (const double v : noise_) noise += v / double(noise_.getSize());
  points_.add(point);
  values_.add(value);
  noise_.add(noise);
  fit(false);
}

}  // namespace kriging
