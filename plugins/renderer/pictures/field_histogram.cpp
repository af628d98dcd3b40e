// SPDX-License-Identifier: BSD-3-Clause
#include "field_histogram.hpp"

#include <algorithm>
#include <cmath>

#include "breccia/error.hpp"
#include "style.hpp"

namespace breccia::pictures {

Chart field_histogram(const Values& values, std::optional<long> bins) {
  std::vector<double> v;
  for (const double x : values.value)
    if (std::isfinite(x)) v.push_back(x);
  if (v.empty()) throw UserError("the field `" + values.name + "` has no values");
  auto [low, high] = std::pair(*std::min_element(v.begin(), v.end()), *std::max_element(v.begin(), v.end()));
  if (!(high > low)) {  // all alike: one bar about them
    const double half = low != 0 ? 0.05 * std::abs(low) : 0.5;
    low -= half;
    high += half;
  }
  // Rice's rule: twice the cube root of the number of values.
  const auto usual = std::clamp(long(std::ceil(2 * std::cbrt(double(v.size())))), 5L, 100L);
  const auto count = std::size_t(bins.value_or(usual));
  std::vector<double> share(count, 0);
  for (const double x : v)
    share[std::min(count - 1, std::size_t((x - low) / (high - low) * double(count)))] += 100.0 / double(v.size());
  const ShownUnit unit = shown_unit(values.unit, std::max(std::abs(low), std::abs(high)));
  Chart chart;
  chart.x_title = title(values.name, unit.unit);
  chart.left_title = "fraction (%)";
  chart.bars_label = "n = " + whole_number(double(v.size()));
  const double width = (high - low) / double(count);
  for (std::size_t k = 0; k < count; ++k)
    chart.bars.push_back(
        {(low + double(k) * width) * unit.factor, (low + double(k + 1) * width) * unit.factor, share[k]});
  return chart;
}

}  // namespace breccia::pictures
