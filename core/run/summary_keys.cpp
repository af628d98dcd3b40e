// SPDX-License-Identifier: BSD-3-Clause
#include "run/summary_keys.hpp"

#include <algorithm>

namespace breccia {

bool is_bookkeeping(const std::string& key) {
  static constexpr const char* all[] = {"threads",
                                        "steps",
                                        "time_step_s",
                                        "time_step_from",
                                        "critical_time_step_s",
                                        "time_step_over_bound",
                                        "time_step_products",
                                        "added_mass_share",
                                        "added_mass_particles",
                                        "added_mass_largest_factor",
                                        "simulated_time_s",
                                        "wall_time_s",
                                        "ns_per_bond_step",
                                        "neighbour_list_rebuilds"};
  return std::find(std::begin(all), std::end(all), key) != std::end(all);
}

std::pair<std::string, std::string> split_unit(const std::string& key) {
  struct Suffix {
    const char *written, *unit;
  };
  // As header_name writes them. A unit comes before those that it ends in: `_N_m` is no length.
  static constexpr Suffix all[] = {{"N_m_rad", "N m/rad"},
                                   {"N_s_m", "N s/m"},
                                   {"kg_m3", "kg/m3"},
                                   {"Pa_s", "Pa s"},
                                   {"Pa_m", "Pa/m"},
                                   {"N_m", "N m"},
                                   {"J_m2", "J/m2"},
                                   {"J_m3", "J/m3"},
                                   {"rad_s", "rad/s"},
                                   {"m_s2", "m/s2"},
                                   {"m_s", "m/s"},
                                   {"1_s", "1/s"},
                                   {"1_m", "1/m"},
                                   {"Pa", "Pa"},
                                   {"m2", "m2"},
                                   {"m3", "m3"},
                                   {"kg", "kg"},
                                   {"rad", "rad"},
                                   {"m", "m"},
                                   {"s", "s"},
                                   {"N", "N"},
                                   {"J", "J"},
                                   {"W", "W"}};
  for (const Suffix& s : all) {
    const std::string ending = std::string("_") + s.written;
    if (!key.ends_with(ending)) continue;
    const std::string name = key.substr(0, key.size() - ending.size());
    // A quotient and a product are written alike.
    const bool is_stiffness = std::string_view(s.written) == "N_m" && name.ends_with("stiffness");
    return {name, is_stiffness ? "N/m" : s.unit};
  }
  return {key, ""};
}

std::string readable(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  for (const auto& [written, read] :
       {std::pair{"youngs modulus", "Young's modulus"}, {"poisson ratio", "Poisson's ratio"}})
    if (name == written) return read;
  return name;
}

std::vector<std::pair<std::string, Json>> numbers_below(const Json& object, const std::string& prefix) {
  std::vector<std::pair<std::string, Json>> all;
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) {
      const auto inner = numbers_below(value, prefix + key + ".");
      all.insert(all.end(), inner.begin(), inner.end());
    } else if (value.is_boolean()) {
      all.emplace_back(prefix + key, value.get<bool>() ? 1 : 0);
    } else if (value.is_number() || value.is_null()) {
      all.emplace_back(prefix + key, value);
    }
  }
  return all;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) line.append(k ? "," : "").append(csv_cell(cells[k]));
  return line + "\n";
}

}  // namespace breccia
