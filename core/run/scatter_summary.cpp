// SPDX-License-Identifier: BSD-3-Clause
#include "run/scatter_summary.hpp"

#include <fmt/format.h>

#include <cmath>

namespace breccia {
namespace {

/// One with its distribution, for the pairs of one kind or for all.
struct Drawing {
  const ScatteredParameter& parameter;
  std::size_t kind;
  const Distribution& distribution() const { return *parameter.of_kind[kind]; }
  bool of_all() const { return parameter.of_kind.size() == 1; }
};

std::vector<Drawing> drawings_of(const NamedLaw& law, std::size_t materials) {
  std::vector<Drawing> all;
  for (const ScatteredParameter& parameter : law.scatter)
    for (std::size_t kind = 0; kind < parameter.of_kind.size(); ++kind) {
      if (parameter.of_kind.size() > 1 && kind / materials > kind % materials)
        continue;  // the same pair the other way round
      if (parameter.of_kind[kind]) all.push_back({parameter, kind});
    }
  return all;
}

/// `f(value)` for each bond that is counted here and draws it.
template <class F>
void for_each_drawn(const NamedLaw& law, const Drawing& of, const SimulationView& v, F&& f) {
  const Distribution& distribution = of.distribution();
  for (const std::size_t k : v.own_bonds()) {
    const Index i = v.bonds.i[k], j = v.bonds.j[k];
    if (!of.of_all() && kind_of_pair(v.particles.material[i], v.particles.material[j], v.materials.size()) != of.kind)
      continue;
    f(distribution.mean * drawn(law, of.parameter, distribution, v.particles.id[i], v.particles.id[j]));
  }
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
  const std::size_t n = view.materials.size();
  const std::vector<Drawing> drawings = drawings_of(law, n);
  std::vector<DrawnParameter> all;
  std::vector<ExactSum> sums(2 * drawings.size()), squares(drawings.size());  // of numbers and values
  for (std::size_t d = 0; d < drawings.size(); ++d)
    for_each_drawn(law, drawings[d], view, [&](double value) {
      sums[2 * d].add(1);
      sums[2 * d + 1].add(value);
    });
  const std::vector<double> of_all = view.sums(sums);
  for (std::size_t d = 0; d < drawings.size(); ++d) {
    const Drawing& of = drawings[d];
    DrawnParameter& found = all.emplace_back();
    found.parameter = of.parameter.name;
    found.unit = of.parameter.unit;
    if (!of.of_all()) found.materials = {view.materials[of.kind / n], view.materials[of.kind % n]};
    found.asked_mean = of.distribution().mean;
    found.asked_deviation = of.distribution().standard_deviation();
    found.bonds = std::size_t(of_all[2 * d]);
    found.mean = found.bonds > 0 ? of_all[2 * d + 1] / of_all[2 * d] : 0.0;
    for_each_drawn(law, of, view, [&](double value) {
      const double off = value - found.mean;  // a second time over all of them: no difference of large sums
      squares[d].add(off * off);
    });
  }
  const std::vector<double> of_squares = view.sums(squares);
  for (std::size_t d = 0; d < all.size(); ++d)
    if (all[d].bonds > 1) all[d].deviation = std::sqrt(of_squares[d] / double(all[d].bonds - 1));
  return all;
}

}  // namespace breccia
