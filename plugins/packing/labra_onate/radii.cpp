// SPDX-License-Identifier: BSD-3-Clause
#include "radii.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "breccia/error.hpp"

namespace breccia::labra_onate {

namespace {

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Inverse of normal_cdf, |z| < 38, by Newton steps from `guess` inside a shrinking bracket.
double normal_quantile(double u, double guess) {
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

struct Moments {
  double mean, deviation;
};

Moments moments(const std::vector<double>& r) {
  double mean = 0, square = 0;
  for (const double x : r) mean += x;
  mean /= double(r.size());
  for (const double x : r) square += (x - mean) * (x - mean);
  return {mean, std::sqrt(square / double(r.size()))};
}

/// Quantiles of the normal (or lognormal) distribution with parameters `location` and `scale`, cut at min and max.
std::vector<double> cut_quantiles(const RadiusLaw& law, double location, double scale, std::size_t n) {
  const bool logarithmic = law.distribution == Distribution::lognormal;
  const auto standard = [&](double r) { return ((logarithmic ? std::log(r) : r) - location) / scale; };
  const double below = normal_cdf(standard(law.min)), inside = normal_cdf(standard(law.max)) - below;
  std::vector<double> r(n);
  double z = 0;
  for (std::size_t k = 0; k < n; ++k) {
    z = normal_quantile(below + inside * (double(k) + 0.5) / double(n), z);
    const double value = location + scale * z;
    r[k] = std::clamp(logarithmic ? std::exp(value) : value, law.min, law.max);
  }
  return r;
}

}  // namespace

std::vector<double> quantile_radii(const RadiusLaw& law, std::size_t n) {
  if (law.distribution == Distribution::uniform) {
    std::vector<double> r(n);
    for (std::size_t k = 0; k < n; ++k) r[k] = law.min + (law.max - law.min) * (double(k) + 0.5) / double(n);
    return r;
  }
  if (law.standard_deviation <= 1e-9 * law.mean) return std::vector<double>(n, law.mean);

  // Newton's method for location and log(scale), so that the quantiles have the mean and deviation asked for.
  const std::size_t samples = std::max<std::size_t>(n, 100);
  const bool logarithmic = law.distribution == Distribution::lognormal;
  const double ratio = law.standard_deviation / law.mean;
  double scale = logarithmic ? std::sqrt(std::log1p(ratio * ratio)) : law.standard_deviation;
  double location = logarithmic ? std::log(law.mean) - 0.5 * scale * scale : law.mean;
  const auto errors = [&](double a, double b) {
    const Moments m = moments(cut_quantiles(law, a, b, samples));
    return Moments{m.mean / law.mean - 1, m.deviation / law.standard_deviation - 1};
  };
  Moments e = errors(location, scale);
  for (int k = 0; k < 60 && std::hypot(e.mean, e.deviation) > 1e-12; ++k) {
    const double h = 1e-6;
    const Moments a = errors(location + h * scale, scale), b = errors(location, scale * (1 + h));
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
      const Moments next = errors(next_location, next_scale);
      if (!(std::hypot(next.mean, next.deviation) < std::hypot(e.mean, e.deviation))) continue;
      location = next_location; scale = next_scale; e = next;
      better = true;
    }
    if (!better) break;
  }
  if (!(std::hypot(e.mean, e.deviation) < 1e-8))
    throw UserError("radius: no distribution of this kind between min and max has this mean and standard_deviation; "
                    "move min and max farther from the mean, or lower standard_deviation");
  return cut_quantiles(law, location, scale, n);
}

}  // namespace breccia::labra_onate
