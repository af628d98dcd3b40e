// SPDX-License-Identifier: BSD-3-Clause
#include "colours.hpp"

#include <algorithm>
#include <cmath>

#include "breccia/error.hpp"

namespace breccia::pictures {
namespace {

/// All values, unless a few runaways would leave the rest in one colour.
std::pair<double, double> range_of(std::vector<double> v) {
  v.erase(std::remove_if(v.begin(), v.end(), [](double x) { return !std::isfinite(x); }), v.end());
  if (v.empty()) return {0, 1};
  std::sort(v.begin(), v.end());
  double low = v.front(), high = v.back();
  const double middle_low = v[v.size() / 200], middle_high = v[v.size() - 1 - v.size() / 200];
  if (high - low > 2 * (middle_high - middle_low) && middle_high > middle_low) {
    low = middle_low;
    high = middle_high;
  }
  if (!(high > low)) high = low + (low != 0 ? std::abs(low) : 1);
  return {low, high};
}

}  // namespace

Scale scale_of(const Values& v, const ColourWish& wish) {
  auto [low, high] = range_of(v.value);
  const bool share =
      v.name.find("damage") != std::string::npos && (v.unit.empty() || v.unit == "1") && low >= 0 && high <= 1;
  // Noise about zero of what has no sign, or a push that goes one way, is not worth half of the colours.
  constexpr double worth_showing = 0.1;
  const bool is_signed = !share && low < 0 && high > 0 && std::min(-low, high) > worth_showing * std::max(-low, high);
  if (share) {
    low = 0;
    high = 1;
  } else if (is_signed) {
    high = std::max(-low, high);
    low = -high;
  } else if (low < 0.3 * high && high > 0 && low > -worth_showing * high) {
    low = std::min(low, 0.0);
  } else if (high > 0.3 * low && low < 0 && high < -worth_showing * low) {
    high = std::max(high, 0.0);
  }
  ColourMap map = wish.map;
  if (map == ColourMap::automatic)
    map = share ? ColourMap::orange_red : is_signed ? ColourMap::blue_red : ColourMap::viridis;
  low = wish.low.value_or(low);
  high = wish.high.value_or(high);
  if (!(low < high))
    throw UserError("the colour range of `" + v.name + "` is empty: " + significant(low, 6) + " to " +
                    significant(high, 6));
  return {map, low, high};
}

ColourBar bar_of(const Values& v, const std::string& name, const Scale& scale) {
  const ShownUnit unit = shown_unit(v.unit, std::max(std::abs(scale.low), std::abs(scale.high)));
  ColourBar bar;
  bar.colours = colour_table(scale.map, scale.low, scale.high);
  bar.low = scale.low * unit.factor;
  bar.high = scale.high * unit.factor;
  bar.ticks = nice_ticks(bar.low, bar.high, 6, v.whole ? 1 : 0);
  bar.title = title(name, unit.unit);
  return bar;
}

void colour_by_name(Overlay& overlay, const std::vector<std::string>& names, const std::vector<double>& value,
                    ColourTable& colours) {
  constexpr Rgb palette[] = {blue, orange, green, vermillion, sky_blue, purple, yellow};
  std::vector<std::size_t> count(names.size(), 0);
  for (const double v : value)
    if (v >= 0 && v < double(names.size())) ++count[std::size_t(v)];
  colours.low = -0.5;
  colours.high = double(names.size()) - 0.5;
  for (std::size_t s = 0; s < colours.step.size(); ++s)
    colours.step[s] = palette[s * names.size() / colours.step.size() % std::size(palette)];
  for (std::size_t m = 0; m < names.size(); ++m)
    if (count[m] > 0) overlay.legend.push_back({palette[m % std::size(palette)], names[m]});
}

}  // namespace breccia::pictures
