// SPDX-License-Identifier: BSD-3-Clause
#include "run/scatter_summary.hpp"

#include <fmt/format.h>

#include <cmath>

namespace breccia {
namespace {

DrawnParameter drawn_of_kind(const NamedLaw& law, const ScatteredParameter& parameter, std::size_t kind,
                             const SimulationView& v) {
  const Distribution& distribution = *parameter.of_kind[kind];
  const std::size_t n = v.materials.size();
  const bool all = parameter.of_kind.size() == 1;
  DrawnParameter found;
  found.parameter = parameter.name;
  found.unit = parameter.unit;
  if (!all) found.materials = {v.materials[kind / n], v.materials[kind % n]};
  found.asked_mean = distribution.mean;
  found.asked_deviation = distribution.standard_deviation();
  // Welford's recurrence: no difference of large sums.
  double mean = 0, squares = 0;
  for (std::size_t k = 0; k < v.bonds.size(); ++k) {
    const Index i = v.bonds.i[k], j = v.bonds.j[k];
    if (!all && kind_of_pair(v.particles.material[i], v.particles.material[j], n) != kind) continue;
    const double value = distribution.mean * drawn(law, parameter, distribution, v.particles.id[i], v.particles.id[j]);
    const double off = value - mean;
    mean += off / double(++found.bonds);
    squares += off * (value - mean);
  }
  found.mean = mean;
  found.deviation = found.bonds > 1 ? std::sqrt(squares / double(found.bonds - 1)) : 0.0;
  return found;
}

}  // namespace

Json DrawnParameter::json() const {
  Json entry = {{"parameter", parameter}, {"unit", unit}, {"bonds", bonds}};
  if (!materials.empty()) entry["materials"] = materials;
  const auto beside = [&](double asked, double got) {
    return Json{{"asked", asked}, {"got", bonds ? Json(got) : Json()}};
  };
  entry["mean"] = beside(asked_mean, mean);
  entry["standard_deviation"] = beside(asked_deviation, deviation);
  return entry;
}

std::string DrawnParameter::text() const {
  const std::string of = unit == "1" ? "" : " " + unit;
  const std::string which = materials.empty() ? "" : fmt::format(" between {} and {}", materials[0], materials[1]);
  if (bonds == 0) return fmt::format("{}{}: no bond draws it", parameter, which);
  return fmt::format("{} of {} bonds{}: mean asked {:.6g}, got {:.6g}{}; standard deviation asked {:.6g}, got {:.6g}{}",
                     parameter, bonds, which, asked_mean, mean, of, asked_deviation, deviation, of);
}

std::vector<DrawnParameter> drawn_parameters(const NamedLaw& law, const SimulationView& view) {
  std::vector<DrawnParameter> all;
  for (const ScatteredParameter& parameter : law.scatter)
    for (std::size_t kind = 0; kind < parameter.of_kind.size(); ++kind) {
      const std::size_t n = view.materials.size();
      if (parameter.of_kind.size() > 1 && kind / n > kind % n) continue;  // the same pair the other way round
      if (parameter.of_kind[kind]) all.push_back(drawn_of_kind(law, parameter, kind, view));
    }
  return all;
}

}  // namespace breccia
