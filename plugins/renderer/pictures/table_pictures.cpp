// SPDX-License-Identifier: BSD-3-Clause
#include "table_pictures.hpp"

#include <cmath>
#include <numbers>

#include "breccia/error.hpp"
#include "chart_pictures.hpp"

namespace breccia::pictures {
namespace {

bool begins_with(const CurvesFile& table, const char* first, const char* second) {
  const auto& columns = table.all();
  return columns.size() > 3 && columns[0].name == first && columns[1].name == second && table.find("count") &&
         table.find("fraction");
}

std::string without(const std::string& prefix, const std::string& name) {
  return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
}

/// "pair minimum radius squared r²", in the paper's symbols: r of a particle; means of a pair have a bar or a tilde.
std::string quantity_title(std::string name) {
  const bool squared = name.ends_with("_squared");
  if (squared) name.resize(name.size() - std::string("_squared").size());
  std::string symbol;
  if (name == "particle_radius") symbol = "r";
  else if (name == "pair_arithmetic_mean_radius") symbol = "r\u0304";
  else if (name == "pair_harmonic_mean_radius") symbol = "r\u0303";
  else if (name == "pair_minimum_radius") symbol = "rₘ";
  return name + (squared ? " squared " : " ") + symbol + (squared && !symbol.empty() ? "²" : "");
}

double sum(const std::vector<double>& v) {
  double s = 0;
  for (const double x : v)
    if (std::isfinite(x)) s += x;
  return s;
}

}  // namespace

bool is_histogram(const CurvesFile& table) { return begins_with(table, "from", "to"); }
bool is_rose(const CurvesFile& table) { return begins_with(table, "angle_from", "angle_to"); }

Chart histogram_chart(const CurvesFile& table, const std::string& name) {
  const Curve &from = table.at("from"), &to = table.at("to"), &fraction = table.at("fraction");
  // Radii of grains read best in millimetres: prefixes change at a tenth of their unit here.
  const double dimension = from.unit == "m2" ? 2 : from.unit == "m3" ? 3 : 1;
  const ShownUnit unit = shown_unit(from.unit, largest(to.value) * std::pow(10.0, dimension));
  Chart chart;
  std::string quantity = quantity_title(without("histogram_", name));
  if (quantity.ends_with(' ')) quantity.pop_back();
  chart.x_title = title(quantity, unit.unit);
  chart.left_title = "fraction (%)";
  chart.bars_label = "n = " + whole_number(sum(table.at("count").value));
  for (std::size_t k = 0; k < from.value.size(); ++k)
    if (std::isfinite(from.value[k]) && std::isfinite(to.value[k]) && std::isfinite(fraction.value[k]))
      chart.bars.push_back({from.value[k] * unit.factor, to.value[k] * unit.factor, 100 * fraction.value[k]});
  if (chart.bars.empty()) throw UserError("the table has no intervals to draw");
  return chart;
}

bool is_profile(const CurvesFile& table) {
  const auto& c = table.all();
  const auto is = [](const std::string& name, const std::string& what) {
    return name == what || name.ends_with("_" + what);
  };
  return c.size() > 2 && is(c[0].name, "from") && is(c[1].name, "to") && !is_histogram(table) && !is_rose(table);
}

Chart profile_chart(const CurvesFile& table, const std::string& name) {
  const auto& columns = table.all();
  const Curve &from = columns[0], &to = columns[1], &last = columns.back();
  const bool is_angle = from.unit == "rad";
  const ShownUnit across = is_angle ? ShownUnit{180 / std::numbers::pi, "°"} : shown_unit(from.unit, largest(to.value));
  std::string quantity = from.name;
  if (quantity.ends_with("_from")) quantity.resize(quantity.size() - 5);
  const std::string family = last.name.substr(0, last.name.find('_'));
  Chart chart;
  chart.x_title = title(quantity == "from" ? without("profile_", name) : quantity, across.unit);
  std::vector<double> middle;
  for (std::size_t k = 0; k < from.value.size(); ++k)
    middle.push_back(0.5 * (from.value[k] + to.value[k]) * across.factor);
  double most = 0;
  std::vector<const Curve*> lines;
  for (std::size_t k = 2; k < columns.size(); ++k)
    if (columns[k].unit == last.unit && (columns[k].name == family || columns[k].name.starts_with(family + "_"))) {
      lines.push_back(&columns[k]);
      most = std::max(most, largest(columns[k].value));
    }
  const ShownUnit up = last.unit.empty() ? ShownUnit{} : shown_unit(last.unit, most);
  chart.left_title = title(family, up.unit);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string label = title(lines[k]->name == family ? family : lines[k]->name.substr(family.size() + 1), "");
    chart.lines.push_back({label, middle, scaled(lines[k]->value, up.factor), series_style(k), false, false, true,
                           double(k + 1) / double(lines.size())});
  }
  return chart;
}

Rose rose_of(const CurvesFile& table, const std::string& name) {
  const Curve &from = table.at("angle_from"), &to = table.at("angle_to"), &fraction = table.at("fraction");
  Rose rose;
  const std::string plane = without("rose_", name);
  const auto is_axis = [](char c) { return c >= 'x' && c <= 'z'; };
  if (plane.size() == 2 && is_axis(plane[0]) && is_axis(plane[1])) {
    rose.axis_0 = plane[0];
    rose.axis_90 = plane[1];
    rose.title = "directions in the " + plane + " plane, fraction (%)";
  } else {
    rose.title = title(plane, "") + ", fraction (%)";
  }
  for (std::size_t k = 0; k < from.value.size(); ++k)
    if (std::isfinite(from.value[k]) && std::isfinite(to.value[k]) && std::isfinite(fraction.value[k]))
      rose.sectors.push_back({from.value[k], to.value[k], 100 * fraction.value[k]});
  if (rose.sectors.empty()) throw UserError("the table has no intervals to draw");
  return rose;
}

}  // namespace breccia::pictures
