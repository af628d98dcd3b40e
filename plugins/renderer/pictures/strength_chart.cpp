// SPDX-License-Identifier: BSD-3-Clause
#include "strength_chart.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include "breccia/strength.hpp"

namespace breccia::pictures {
namespace {

std::optional<PrincipalStresses> strength_in(const std::filesystem::path& folder) {
  std::ifstream in(folder / "summary.json", std::ios::binary);
  if (!in) return {};
  return strength_of(Json::parse(in, nullptr, false));
}

}  // namespace

std::optional<Chart> strength_envelope_chart(const std::vector<ComparisonRequest::Run>& runs) {
  std::vector<PrincipalStresses> tests;
  std::vector<std::size_t> which;
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (const auto strength = strength_in(runs[k].folder)) {
      tests.push_back(*strength);
      which.push_back(k);
    }
  const auto line = mohr_coulomb(tests);
  if (!line) return {};
  double most = 0;
  for (const PrincipalStresses& t : tests) most = std::max(most, t.sigma_1);
  const ShownUnit unit = shown_unit("Pa", most);
  Chart chart;
  chart.equal_scales = true;
  chart.x_title = title("normal stress σ", unit.unit);
  chart.left_title = title("shear stress τ", unit.unit);
  double farthest = 0;  // where the line touches the last circle
  const double sine = std::sin(line->friction_angle()), tangent = std::tan(line->friction_angle());
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const double middle = 0.5 * (tests[k].sigma_3 + tests[k].sigma_1),
                 radius = 0.5 * (tests[k].sigma_1 - tests[k].sigma_3);
    farthest = std::max(farthest, middle);
    ChartLine circle{runs[which[k]].label,
                     {},
                     {},
                     series_style(which[k]),
                     false,
                     false,
                     false,
                     double(k + 1) / double(tests.size())};
    for (int step = 0; step <= 90; ++step) {
      const double turn = std::numbers::pi * step / 90;
      circle.x.push_back((middle - radius * std::cos(turn)) * unit.factor);
      circle.y.push_back(radius * std::sin(turn) * unit.factor);
    }
    chart.lines.push_back(std::move(circle));
  }
  // From the apex, no further left than the circles need, to where the largest circle has its top.
  double low = 0;
  for (const PrincipalStresses& t : tests) low = std::min(low, t.sigma_3);
  if (sine > 0) low = std::max(low, -line->cohesion() / tangent);
  const auto height = [&](double at) { return (line->cohesion() + tangent * at) * unit.factor; };
  chart.lines.push_back({"c = " + significant(line->cohesion() * unit.factor, 3) + " " + unit.unit +
                             ", φ = " + significant(line->friction_angle() * 180 / std::numbers::pi, 3) + "°",
                         {low * unit.factor, farthest * unit.factor},
                         {height(low), height(farthest)},
                         {ink}});
  return chart;
}

}  // namespace breccia::pictures
