// SPDX-License-Identifier: BSD-3-Clause
#include "drawing.hpp"

#include <algorithm>
#include <cmath>
#include <openturns/CovarianceMatrix.hxx>
#include <openturns/DistFunc.hxx>
#include <openturns/RandomGenerator.hxx>

namespace kriging {

namespace {

constexpr OT::UnsignedInteger crowd = 500;
constexpr OT::UnsignedInteger passes = 4;  // between two sharpenings, and between two drawings of the whole crowd
constexpr double left = 0.5;               // share of the crowd that counts after a sharpening
constexpr double smallest = 1e-7;          // steps of the cube that no crowd falls below

class Crowd {
 public:
  Crowd(const Score& log_density, OT::UnsignedInteger dimension, OT::UnsignedInteger seed)
      : log_density_(log_density), points_(filling(dimension, 0, crowd, seed)), logs_(log_density(points_)) {}

  const OT::Sample& points() const { return points_; }
  bool is_there() const { return power_ >= 1; }

  /// As much nearer to the density as leaves half of the crowd of use, those drawn anew by how well they agree.
  void sharpen() {
    double step = 1 - power_;
    if (useful(step) < left) {
      double low = 0, high = step;
      for (int k = 0; k < 60; ++k) (useful((low + high) / 2) < left ? high : low) = (low + high) / 2;
      step = low;
    }
    const std::vector<double> w = weights(step);
    power_ = step < 1 - power_ ? power_ + step : 1;
    OT::Sample chosen(crowd, points_.getDimension());
    OT::Point logs(crowd);
    double sum = 0, at = OT::RandomGenerator::Generate() / double(crowd);
    for (OT::UnsignedInteger i = 0, next = 0; i < crowd; ++i) {
      for (sum += w[i]; next < crowd && (at < sum || i + 1 == crowd); at += 1 / double(crowd), ++next) {
        chosen[next] = points_[i];
        logs[next] = logs_[i];
      }
    }
    points_ = chosen;
    logs_ = logs;
    measure();
  }

  /// Each walks a step as wide as the crowd, and stays where it was by the rule of Metropolis and Hastings.
  void walk() {
    const OT::UnsignedInteger dimension = points_.getDimension();
    OT::Sample to(points_);
    std::vector<bool> outside(crowd, false);
    for (OT::UnsignedInteger i = 0; i < crowd; ++i) {
      OT::Point z(dimension);
      for (double& v : z) v = OT::DistFunc::qNormal(OT::RandomGenerator::Generate());
      for (OT::UnsignedInteger k = 0; k < dimension; ++k) {
        for (OT::UnsignedInteger c = 0; c <= k; ++c) to(i, k) += stride_ * root_(k, c) * z[c];
        outside[i] = outside[i] || to(i, k) < 0 || to(i, k) > 1;
      }
      if (outside[i]) to[i] = points_[i];
    }
    const OT::Point logs = log_density_(to);
    OT::UnsignedInteger accepted = 0;
    for (OT::UnsignedInteger i = 0; i < crowd; ++i) {
      const double chance = OT::RandomGenerator::Generate();
      if (outside[i] || !(std::log(chance) < power_ * (logs[i] - logs_[i]))) continue;
      points_[i] = to[i];
      logs_[i] = logs[i];
      ++accepted;
    }
    const double share = double(accepted) / double(crowd);
    stride_ *= share < 0.15 ? 0.7 : share > 0.4 ? 1.3 : 1;
  }

 private:
  std::vector<double> weights(double step) const {
    const double top = *std::max_element(logs_.begin(), logs_.end());
    std::vector<double> w;
    double sum = 0;
    for (const double v : logs_) sum += w.emplace_back(std::exp(step * (v - top)));
    for (double& v : w) v /= sum;
    return w;
  }
  /// Share of the crowd that still counts.
  double useful(double step) const {
    double squares = 0;
    for (const double w : weights(step)) squares += w * w;
    return 1 / squares / double(crowd);
  }
  void measure() {
    const OT::UnsignedInteger dimension = points_.getDimension();
    OT::CovarianceMatrix spread = points_.computeCovariance();
    for (OT::UnsignedInteger k = 0; k < dimension; ++k) spread(k, k) += smallest * smallest + 1e-6 * spread(k, k);
    root_ = spread.computeCholesky();
    stride_ = std::min(stride_, 2.38 / std::sqrt(double(dimension)));
  }

  const Score& log_density_;
  OT::Sample points_;
  OT::Point logs_;
  OT::TriangularMatrix root_;
  double power_ = 0, stride_ = 10;
};

}  // namespace

OT::Sample drawn_from(const Score& log_density, OT::UnsignedInteger dimension, OT::UnsignedInteger count,
                      OT::UnsignedInteger seed, const std::function<void()>& pause) {
  Crowd all(log_density, dimension, seed);
  const auto walk = [&] {
    for (OT::UnsignedInteger k = 0; k < passes; ++k) all.walk();
    pause();
  };
  while (!all.is_there()) {
    all.sharpen();
    walk();
  }
  OT::Sample drawn(0, dimension);
  while (drawn.getSize() < count) {
    walk();
    for (OT::UnsignedInteger i = 0; i < crowd && drawn.getSize() < count; ++i) drawn.add(all.points()[i]);
  }
  return drawn;
}

}  // namespace kriging
