// SPDX-License-Identifier: BSD-3-Clause
/// Quantiles of truncated distributions, with the moments met exactly.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "breccia/error.hpp"

namespace breccia {

enum class DistributionFamily { normal, lognormal, uniform, weibull, moments, sieves };

/// A point of a grading curve: the share of the mass in particles up to this radius [m].
struct GradingPoint {
  double radius, passing;
};

/// What is asked of the radii [m]. Moments are those of the truncated distribution itself, not of the one it is cut
/// from; kurtosis is the excess over the normal distribution's.
struct RadiusLaw {
  DistributionFamily distribution = DistributionFamily::normal;
  double mean = 0, standard_deviation = 0, min = 0, max = 0;
  std::optional<double> skewness = {}, kurtosis = {};
  std::vector<GradingPoint> grading = {};
};

namespace detail {

inline double mean_of(const std::vector<double>& r) {
  double sum = 0;
  for (const double x : r) sum += x;
  return sum / double(r.size());
}
inline double deviation_of(const std::vector<double>& r) {
  const double mean = mean_of(r);
  double square = 0;
  for (const double x : r) square += (x - mean) * (x - mean);
  return std::sqrt(square / double(r.size()));
}

[[noreturn]] inline void no_such_distribution(const char* what) {
  throw UserError("no distribution of this kind between min and max has this " + std::string(what) +
                  "; move min and max farther from the mean, or lower standard_deviation");
}

inline double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Inverse of normal_cdf, |z| < 38, by Newton steps from `guess` inside a shrinking bracket.
inline double normal_quantile(double u, double guess) {
  double low = -38, high = 38, z = guess;
  for (int k = 0; k < 200; ++k) {
    const double error = normal_cdf(z) - u;
    (error > 0 ? high : low) = z;
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
    double next = density > 0 ? z - error / density : 0.5 * (low + high);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - z) <= 1e-14 * std::max(1.0, std::abs(z))) return next;
    z = next;
  }
  return z;
}

/// Radius = location + scale z, or its exponential; z is a standard variable: normal, or (Weibull) the logarithm of a
/// standard exponential one.
struct LocationScale {
  DistributionFamily kind;
  bool logarithmic() const { return kind != DistributionFamily::normal; }
  double cdf(double z) const { return kind == DistributionFamily::weibull ? -std::expm1(-std::exp(z)) : normal_cdf(z); }
  double quantile(double u, double guess) const {
    return kind == DistributionFamily::weibull ? std::log(-std::log1p(-u)) : normal_quantile(u, guess);
  }
  /// Those that have the mean and deviation before it is cut.
  void start(const RadiusLaw& law, double& location, double& scale) const {
    const double ratio = law.standard_deviation / law.mean;
    if (kind == DistributionFamily::normal) {
      location = law.mean;
      scale = law.standard_deviation;
    } else if (kind == DistributionFamily::lognormal) {
      scale = std::sqrt(std::log1p(ratio * ratio));
      location = std::log(law.mean) - 0.5 * scale * scale;
    } else {
      const double shape = std::pow(ratio, -1.086);  // near enough to begin with
      scale = 1 / shape;
      location = std::log(law.mean / std::tgamma(1 + scale));
    }
  }
};

/// Quantiles of the distribution with these parameters, cut at min and max.
inline std::vector<double> cut_quantiles(const RadiusLaw& law, double location, double scale, std::size_t n) {
  const LocationScale family{law.distribution};
  const bool logarithmic = family.logarithmic();
  const auto standard = [&](double r) { return ((logarithmic ? std::log(r) : r) - location) / scale; };
  const double below = family.cdf(standard(law.min)), inside = family.cdf(standard(law.max)) - below;
  std::vector<double> r(n);
  double z = 0;
  for (std::size_t k = 0; k < n; ++k) {
    z = family.quantile(below + inside * (double(k) + 0.5) / double(n), z);
    const double value = location + scale * z;
    r[k] = std::clamp(logarithmic ? std::exp(value) : value, law.min, law.max);
  }
  return r;
}

/// Newton's method for location and log(scale), so that the quantiles have the mean and deviation asked for.
inline std::vector<double> fitted_quantiles(const RadiusLaw& law, std::size_t n) {
  struct Errors {
    double mean, deviation;
    double size() const { return std::hypot(mean, deviation); }
  };
  const std::size_t samples = std::max<std::size_t>(n, 100);
  const auto errors = [&](double a, double b) {
    const std::vector<double> r = cut_quantiles(law, a, b, samples);
    return Errors{mean_of(r) / law.mean - 1, deviation_of(r) / law.standard_deviation - 1};
  };
  double location = 0, scale = 1;
  LocationScale{law.distribution}.start(law, location, scale);
  Errors e = errors(location, scale);
  for (int k = 0; k < 60 && e.size() > 1e-12; ++k) {
    const double h = 1e-6;
    const Errors a = errors(location + h * scale, scale), b = errors(location, scale * (1 + h));
    const double aa = (a.mean - e.mean) / h, ab = (b.mean - e.mean) / h;
    const double ba = (a.deviation - e.deviation) / h, bb = (b.deviation - e.deviation) / h;
    const double determinant = aa * bb - ab * ba;
    if (!(std::abs(determinant) > 0)) break;
    const double da = -(bb * e.mean - ab * e.deviation) / determinant;
    const double db = -(aa * e.deviation - ba * e.mean) / determinant;
    bool better = false;
    for (double t = 1; t > 1e-4 && !better; t *= 0.5) {
      const double next_location = location + t * da * scale;
      const double next_scale = scale * std::exp(std::clamp(t * db, -1.0, 1.0));
      const Errors next = errors(next_location, next_scale);
      if (!(next.size() < e.size())) continue;
      location = next_location;
      scale = next_scale;
      e = next;
      better = true;
    }
    if (!better) break;
  }
  if (!(e.size() < 1e-8)) no_such_distribution("mean and standard_deviation");
  return cut_quantiles(law, location, scale, n);
}

/// Quantiles of the density exp(sum of l_k t^k) on [min, max], t from -1 to 1: of all densities with the given moments
/// the one of largest entropy (Jaynes 1957). The multipliers l minimise the convex function log Z(l) - l.m.
inline std::vector<double> entropy_quantiles(const RadiusLaw& law, std::size_t n) {
  constexpr int cells = 4000, most = 4;
  const int order = law.kurtosis ? 4 : law.skewness ? 3 : 2;
  const double middle = 0.5 * (law.min + law.max), half = 0.5 * (law.max - law.min);
  const double mean = (law.mean - middle) / half, s = law.standard_deviation / half;
  const double third = law.skewness.value_or(0) * s * s * s, fourth = (law.kurtosis.value_or(0) + 3) * s * s * s * s;
  const Eigen::Vector4d wanted(mean, s * s + mean * mean, third + 3 * mean * s * s + mean * mean * mean,
                               fourth + 4 * mean * third + 6 * mean * mean * s * s + mean * mean * mean * mean);
  const auto at = [](int k) { return -1 + 2 * (k + 0.5) / cells; };
  const auto exponent = [&](const Eigen::Vector4d& l, double t) {
    return t * (l[0] + t * (l[1] + t * (l[2] + t * l[3])));
  };
  struct Point {
    double value;  // of the convex function
    Eigen::Vector4d gradient;
    Eigen::Matrix4d hessian;
  };
  const auto evaluate = [&](const Eigen::Vector4d& l) {
    double largest = -1e300, moment[2 * most + 1] = {};
    for (int k = 0; k < cells; ++k) largest = std::max(largest, exponent(l, at(k)));
    for (int k = 0; k < cells; ++k) {
      const double t = at(k);
      double power = std::exp(exponent(l, t) - largest);
      for (double& m : moment) {
        m += power;
        power *= t;
      }
    }
    Point p{std::log(moment[0]) + largest - l.dot(wanted), Eigen::Vector4d::Zero(), Eigen::Matrix4d::Identity()};
    for (int a = 0; a < order; ++a) {
      p.gradient[a] = moment[a + 1] / moment[0] - wanted[a];
      for (int b = 0; b < order; ++b)
        p.hessian(a, b) = (moment[a + b + 2] - moment[a + 1] * moment[b + 1] / moment[0]) / moment[0];
    }
    return p;
  };

  Eigen::Vector4d l = Eigen::Vector4d::Zero();
  Point now = evaluate(l);
  for (int k = 0; k < 200 && now.gradient.norm() > 1e-13; ++k) {
    const Eigen::Vector4d step = -now.hessian.ldlt().solve(now.gradient);
    bool better = false;
    for (double t = 1; t > 1e-6 && !better; t *= 0.5) {
      const Point next = evaluate(l + t * step);
      if (!(next.value < now.value || next.gradient.norm() < now.gradient.norm())) continue;
      l += t * step;
      now = next;
      better = true;
    }
    if (!better) break;
  }
  if (!(now.gradient.norm() < 1e-8)) no_such_distribution("mean, standard_deviation, skewness and kurtosis");

  double largest = -1e300;
  for (int k = 0; k < cells; ++k) largest = std::max(largest, exponent(l, at(k)));
  std::vector<double> below(cells + 1, 0.0), r(n);
  for (int k = 0; k < cells; ++k) below[k + 1] = below[k] + std::exp(exponent(l, at(k)) - largest);
  int cell = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = below[cells] * (double(k) + 0.5) / double(n);
    while (cell < cells - 1 && below[cell + 1] < u) ++cell;
    r[k] = middle + half * (-1 + 2 * (cell + (u - below[cell]) / (below[cell + 1] - below[cell])) / cells);
  }
  return r;
}

/// Between two points the mass is spread evenly over the radius, so the number falls with its cube.
inline std::vector<double> grading_quantiles(const RadiusLaw& law, std::size_t n) {
  std::vector<double> number{0};  // of particles up to each point, but for a factor
  const auto& g = law.grading;
  const auto inverse_square = [](double r) { return 1 / (r * r); };
  for (std::size_t k = 1; k < g.size(); ++k)
    number.push_back(number.back() + (g[k].passing - g[k - 1].passing) / (g[k].radius - g[k - 1].radius) *
                                         (inverse_square(g[k - 1].radius) - inverse_square(g[k].radius)));
  std::vector<double> r(n);
  std::size_t at = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = number.back() * (double(k) + 0.5) / double(n);
    while (at < g.size() - 1 && number[at] < u) ++at;
    const double share = (u - number[at - 1]) / (number[at] - number[at - 1]);
    const double low = inverse_square(g[at - 1].radius), high = inverse_square(g[at].radius);
    r[k] = 1 / std::sqrt(low + share * (high - low));
  }
  return r;
}

}  // namespace detail

/// The quantiles at (k + 1/2)/n, k = 0..n-1, ascending [m]. For the normal, lognormal and Weibull distributions their
/// mean and standard deviation are those of the law to 1e-10 from 100 radii on; fewer are quantiles of the law for 100.
/// UserError when no such distribution exists.
inline std::vector<double> quantile_radii(const RadiusLaw& law, std::size_t n) {
  if (law.distribution == DistributionFamily::sieves) return detail::grading_quantiles(law, n);
  if (law.distribution == DistributionFamily::uniform) {
    std::vector<double> r(n);
    for (std::size_t k = 0; k < n; ++k) r[k] = law.min + (law.max - law.min) * (double(k) + 0.5) / double(n);
    return r;
  }
  if (law.standard_deviation <= 1e-9 * law.mean) return std::vector<double>(n, law.mean);
  return law.distribution == DistributionFamily::moments ? detail::entropy_quantiles(law, n)
                                                         : detail::fitted_quantiles(law, n);
}

}  // namespace breccia
