// SPDX-License-Identifier: BSD-3-Clause
#include "breccia/strength.hpp"

#include <fmt/format.h>

#include <numbers>

#include "compare/compare.hpp"

namespace breccia {

std::optional<Json> strength_envelope(const std::vector<ComparedRun>& runs) {
  std::vector<PrincipalStresses> tests;
  Json points = Json::array();
  for (const ComparedRun& run : runs)
    if (const auto strength = strength_of(run.summary)) {
      tests.push_back(*strength);
      points.push_back({{"label", run.label},
                        {"minor_stress_Pa", strength->sigma_3},
                        {"major_stress_Pa", strength->sigma_1},
                        {"in_fit", strength->sigma_3 >= 0}});
    }
  const auto line = mohr_coulomb(tests);
  if (!line) return {};
  double largest = 0;
  for (const PrincipalStresses& t : tests)
    if (t.sigma_3 >= 0)
      largest = std::max(largest, std::abs(t.sigma_1 - line->uniaxial_strength - line->slope * t.sigma_3));
  return Json{{"uniaxial_strength_Pa", line->uniaxial_strength},
              {"slope", line->slope},
              {"cohesion_Pa", line->cohesion()},
              {"friction_angle_rad", line->friction_angle()},
              {"largest_deviation_Pa", largest},
              {"tests", points}};
}

std::string strength_markdown(const Json& e) {
  const auto value = [&](const char* key) { return e.at(key).get<double>(); };
  std::string text = fmt::format(
      "\n## Strength envelope (Mohr-Coulomb)\n\nsigma_1 = {:.4g} MPa + {:.4g} sigma_3: cohesion {:.4g} MPa, angle of "
      "friction {:.3g}°; "
      "no test lies more than {:.3g} MPa off. Tests with a tensile sigma_3 are not fitted.\n\n"
      "| | sigma_3 (MPa) | sigma_1 (MPa) |\n|---|---:|---:|\n",
      value("uniaxial_strength_Pa") * 1e-6, value("slope"), value("cohesion_Pa") * 1e-6,
      value("friction_angle_rad") * 180 / std::numbers::pi, value("largest_deviation_Pa") * 1e-6);
  for (const Json& t : e.at("tests"))
    text += fmt::format("| {} | {:.4g} | {:.4g} |\n", t.at("label").get<std::string>(),
                        t.at("minor_stress_Pa").get<double>() * 1e-6, t.at("major_stress_Pa").get<double>() * 1e-6);
  return text;
}

}  // namespace breccia
