// SPDX-License-Identifier: BSD-3-Clause
#include "curve_analysis.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

/// Where `of`, a column of the curve, passes `level` between the sample before `row` and this one.
CurvePoint between(const StressStrainCurve& c, std::size_t row, const std::vector<double>& of, double level) {
  const double rise = of[row] - of[row - 1];
  const double t = rise != 0 ? (level - of[row - 1]) / rise : 1.0;
  const auto at = [&](const std::vector<double>& v) {
    return &v == &of ? level : v[row - 1] + t * (v[row] - v[row - 1]);
  };
  return {at(c.stress), at(c.strain), at(c.lateral)};
}

CurvePoint at_row(const StressStrainCurve& c, std::size_t row) {
  return {c.stress[row], c.strain[row], c.lateral[row]};
}

}  // namespace

Peak find_peak(const StressStrainCurve& c) {
  Peak p;
  p.row = std::size_t(std::max_element(c.stress.begin(), c.stress.end()) - c.stress.begin());
  p.stress = c.stress[p.row];
  p.strain = c.strain[p.row];
  for (std::size_t row = p.row + 1; row < c.stress.size(); ++row)
    p.passed = p.passed || (c.stress[row] < 0.95 * p.stress && c.as_far_as(p.row, row));
  return p;
}

FitRange loading_range(const StressStrainCurve& c, double lower, double upper) {
  FitRange r;
  while (r.end < c.stress.size() && c.stress[r.end] <= upper) ++r.end;
  r.begin = r.end;
  while (r.begin > 0 && c.stress[r.begin - 1] >= lower) --r.begin;
  return r;
}

std::optional<Line> fit_line(const std::vector<double>& x, const std::vector<double>& y, const FitRange& range) {
  if (range.size() < 3) return {};
  const double count = double(range.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t k = range.begin; k < range.end; ++k) {
    mean_x += x[k] / count;
    mean_y += y[k] / count;
  }
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t k = range.begin; k < range.end; ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
    yy += (y[k] - mean_y) * (y[k] - mean_y);
  }
  if (!(xx > 0)) return {};
  return Line{xy / xx, yy > 0 ? xy * xy / (xx * yy) : 1.0};
}

double slopes_apart(const std::vector<double>& x, const std::vector<double>& y, const FitRange& range) {
  std::vector<double> part_x[2], part_y[2];
  for (std::size_t k = range.begin; k < range.end; ++k) {
    part_x[k % 2].push_back(x[k]);
    part_y[k % 2].push_back(y[k]);
  }
  const auto slope_of = [&](int part) { return fit_line(part_x[part], part_y[part], {0, part_x[part].size()}); };
  const auto even = slope_of(0), odd = slope_of(1);
  if (!even || !odd || even->slope + odd->slope == 0) return 0;
  return std::abs(2 * (even->slope - odd->slope) / (even->slope + odd->slope));
}

std::optional<CurvePoint> first_rise_to(const StressStrainCurve& c, std::vector<double> StressStrainCurve::*of,
                                        double level) {
  const std::vector<double>& column = c.*of;
  for (std::size_t row = 0; row < column.size(); ++row)
    if (column[row] >= level) return row == 0 ? at_row(c, row) : between(c, row, column, level);
  return {};
}

std::optional<CurvePoint> first_fall_to(const StressStrainCurve& c, double level, std::size_t after) {
  for (std::size_t row = after + 1; row < c.stress.size(); ++row)
    if (c.stress[row] <= level && c.as_far_as(after, row)) return between(c, row, c.stress, level);
  return {};
}

std::optional<ConfinedSlopes> confined_slopes(double axial, double lateral, double bulging, int dimension) {
  if (!(std::abs(lateral) > 0.05 * std::abs(axial))) return {};
  // 1 = (axial - m nu lateral)/E and -bulging = (lateral (1 - (m - 1) nu) - nu axial)/E with m cross directions.
  const double m = dimension - 1;
  const double nu = (lateral + bulging * axial) / (m * bulging * lateral + (m - 1) * lateral + axial);
  return ConfinedSlopes{axial - m * nu * lateral, nu, lateral / axial, axial};
}

}  // namespace breccia
