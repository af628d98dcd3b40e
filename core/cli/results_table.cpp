// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <vector>

#include "results/summary_keys.hpp"

namespace breccia::cli {
namespace {

/// A number of the summary and the unit in which people give it.
struct Row {
  std::string key, title, unit;
  double factor = 1;  ///< from SI
};

const Row usual[] = {{"youngs_modulus_Pa", "Young's modulus", "GPa", 1e-9},
                     {"poisson_ratio", "Poisson's ratio", ""},
                     {"peak_stress_Pa", "peak stress", "MPa", 1e-6},
                     {"peak_strain", "strain at the peak", "%", 100},
                     {"brazilian_tensile_strength_Pa", "tensile strength (Brazilian)", "MPa", 1e-6},
                     {"bonds_broken_tension", "bonds broken in tension", ""},
                     {"bonds_broken_shear", "bonds broken in shear", ""},
                     {"energy_error", "energy unaccounted for", "%", 100},
                     // of `drive`
                     {"least_normal_force_N", "least normal force", "N"},
                     {"largest_normal_force_N", "largest normal force", "N"},
                     {"least_shear_force_N", "least shear force", "N"},
                     {"largest_shear_force_N", "largest shear force", "N"},
                     {"work_J", "work done on the pair", "J"},
                     {"stored_energy_J", "energy stored", "J"},
                     {"friction_work_J", "work of friction", "J"},
                     {"fracture_energy_J", "fracture energy", "J"},
                     {"energy_error_J", "energy unaccounted for", "J"}};

std::vector<Row> rows_of(const Json& summary, const Json& reference) {
  std::vector<Row> rows;
  for (const Row& r : usual)
    if (summary.contains(r.key)) rows.push_back(r);
  for (const auto& [key, value] : reference.items()) {
    const bool known = std::any_of(rows.begin(), rows.end(), [&, k = key](const Row& r) { return r.key == k; });
    if (known || !value.is_number() || !summary.contains(key)) continue;
    const auto [title, unit] = title_of(key, summary);
    rows.push_back({key, title, unit});
  }
  return rows;
}

}  // namespace

std::string results_table(const Json& summary) {
  const Json reference = summary.value("reference", Json::object());
  const std::vector<Row> rows = rows_of(summary, reference.is_object() ? reference : Json::object());
  const auto published = [&](const Row& r) {
    return reference.is_object() && reference.contains(r.key) && reference[r.key].is_number();
  };
  const bool compared = std::any_of(rows.begin(), rows.end(), published);
  std::string text;
  if (!rows.empty())
    text =
        fmt::format("\n{:<34} | {:>12}{}\n{:-<{}}\n", "", "measured",
                    compared ? fmt::format(" | {:>12} | {:>10}", "paper", "difference") : "", "", compared ? 77 : 49);
  for (const Row& r : rows) {
    const Json& value = summary[r.key];
    const bool measured = value.is_number();
    text += fmt::format("{:<34} | {:>12}", r.title + (r.unit.empty() ? "" : " (" + r.unit + ")"),
                        measured ? fmt::format("{:.6g}", r.factor * value.get<double>()) : "none");
    if (published(r)) {
      const double paper = reference[r.key].get<double>();
      text += fmt::format(" | {:>12.6g}", r.factor * paper);
      if (measured && paper != 0) text += fmt::format(" | {:>+8.2f} %", 100 * (value.get<double>() / paper - 1));
    }
    text += '\n';
  }
  if (summary.contains("peak_reached") && summary["peak_reached"] == false)
    text += "The stress had not fallen from its largest value when the run ended: the peak need not be the strength.\n";
  if (summary.value("interrupted", Json()) == true)
    text += "The run was stopped before its end: its last values are not final.\n";
  if (const std::size_t n = summary.value("warnings", Json::array()).size(); n > 0)
    text += fmt::format("{} warning{}: see above, run.log or summary.json\n", n, n == 1 ? "" : "s");
  return text;
}

void print_results(const Json& summary) {
  std::fputs(results_table(summary).c_str(), stdout);
  // Before the last line, which goes to the other stream. A reader that has seen enough is no error.
  if (std::fflush(stdout) != 0 && errno == EPIPE) std::clearerr(stdout);
}

}  // namespace breccia::cli
