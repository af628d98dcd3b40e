// SPDX-License-Identifier: BSD-3-Clause
#include "style.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <span>

namespace breccia::pictures {
namespace {

// Anchor colours, evenly spaced. viridis, inferno (Smith and van der Walt), cividis (Nunez et al. 2018), OrRd and RdBu
// (Brewer): perceptually ordered, readable without red-green sight.
constexpr Rgb viridis[] = {{68, 1, 84},    {71, 45, 123}, {59, 82, 139},  {44, 114, 142}, {33, 145, 140},
                           {40, 174, 128}, {94, 201, 98}, {173, 220, 48}, {253, 231, 37}};
constexpr Rgb cividis[] = {{0, 34, 78},     {18, 53, 112},   {59, 73, 108},   {87, 93, 109},  {112, 113, 115},
                           {138, 134, 120}, {165, 156, 116}, {195, 179, 105}, {225, 204, 85}, {254, 232, 56}};
constexpr Rgb inferno[] = {{0, 0, 4},     {27, 12, 65},   {74, 12, 107}, {120, 28, 109}, {165, 44, 96},
                           {207, 68, 70}, {237, 105, 37}, {251, 155, 6}, {247, 209, 61}, {252, 255, 164}};
constexpr Rgb orange_red[] = {{240, 234, 224}, {254, 232, 200}, {253, 212, 158}, {253, 187, 132}, {252, 141, 89},
                              {239, 101, 72},  {215, 48, 31},   {179, 0, 0},     {127, 0, 0}};
constexpr Rgb blue_red[] = {{33, 102, 172},  {67, 147, 195},  {146, 197, 222}, {209, 229, 240}, {247, 247, 247},
                            {253, 219, 199}, {244, 165, 130}, {214, 96, 77},   {178, 24, 43}};
constexpr Rgb grey[] = {{240, 240, 240}, {60, 60, 60}};

std::span<const Rgb> anchors(ColourMap map) {
  switch (map) {
    case ColourMap::cividis:
      return cividis;
    case ColourMap::inferno:
      return inferno;
    case ColourMap::orange_red:
      return orange_red;
    case ColourMap::blue_red:
      return blue_red;
    case ColourMap::grey:
      return grey;
    default:
      return viridis;
  }
}

}  // namespace

Rgb writing_on(const Vec3& background) {
  const bool dark = 0.299 * background.x() + 0.587 * background.y() + 0.114 * background.z() < 0.5;
  return dark ? Rgb{235, 235, 235} : ink;
}

Rgb bytes_of(const Vec3& colour) {
  Rgb c;
  for (int k = 0; k < 3; ++k) c[std::size_t(k)] = static_cast<unsigned char>(std::lround(255 * colour[k]));
  return c;
}

LineStyle dashed(const Rgb& colour) { return {colour, LineStyle::thin, {1.2, 0.7}}; }

LineStyle series_style(std::size_t k) {
  // Okabe and Ito without yellow, which is too pale for a line on white.
  static constexpr Rgb colours[] = {blue, vermillion, green, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, ink};
  static const std::vector<double> dashes[] = {{}, {2.4, 1.0}, {0.6, 0.8}, {2.4, 0.8, 0.6, 0.8}, {4.5, 1.2}};
  static constexpr Marker markers[] = {Marker::circle,  Marker::square,        Marker::triangle_up,
                                       Marker::diamond, Marker::triangle_down, Marker::none};
  return {colours[k % 7], 0.45, dashes[k % 5], markers[k % 6]};
}

ColourTable colour_table(ColourMap map, double low, double high) {
  const auto colours = anchors(map);
  ColourTable table{{}, low, high};
  for (std::size_t k = 0; k < table.step.size(); ++k) {
    const double at = double(k) / double(table.step.size() - 1) * double(colours.size() - 1);
    const std::size_t a = std::min(std::size_t(at), colours.size() - 2);
    for (std::size_t c = 0; c < 3; ++c)
      table.step[k][c] = static_cast<unsigned char>(
          std::lround((1 - (at - double(a))) * colours[a][c] + (at - double(a)) * colours[a + 1][c]));
  }
  return table;
}

const Rgb& ColourTable::at(double value) const {
  static constexpr Rgb unknown{160, 160, 160};
  if (std::isnan(value)) return unknown;
  const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return step[std::min(std::size_t(share * double(step.size())), step.size() - 1)];
}

std::string font_file() {
  for (const char* folder : {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu-sans-fonts",
                             "/usr/share/fonts/TTF", "/usr/share/fonts/dejavu", "/usr/local/share/fonts/dejavu"}) {
    const std::filesystem::path file = std::filesystem::path(folder) / "DejaVuSans.ttf";
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) return file;
  }
  return {};
}

Ticks nice_ticks(double low, double high, int count, double least_step) {
  if (!(high > low)) return {};
  const double raw = (high - low) / std::max(count, 1), power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double s : {1.0, 2.0, 5.0})
    if (s * power >= raw * 0.999) {
      step = s * power;
      break;
    }
  return ticks_at(low, high, std::max(step, least_step));
}

Ticks ticks_at(double low, double high, double step) {
  Ticks ticks;
  ticks.step = step;
  const int digits = std::max(0, -int(std::floor(std::log10(step) + 1e-9)));
  for (double k = std::ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; ++k) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, k * step + 0.0);
    ticks.at.push_back(k * step);
    ticks.label.push_back(text[0] == '-' ? "\u2212" + std::string(text + 1) : text);
  }
  return ticks;
}

std::string title(std::string name, const std::string& unit) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return unit.empty() || unit == "1" ? name : name + " (" + unit + ")";
}

std::string significant(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string whole_number(double v) {
  std::string digits = std::to_string(std::llround(v));
  for (int at = int(digits.size()) - 3; at > 0; at -= 3) digits.insert(std::size_t(at), "\u202f");
  return digits;
}

}  // namespace breccia::pictures
