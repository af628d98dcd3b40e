// SPDX-License-Identifier: BSD-3-Clause
#include "results/summary_keys.hpp"

#include <algorithm>

#include "breccia/services.hpp"

namespace breccia {

bool is_bookkeeping(const std::string& key) {
  static constexpr const char* all[] = {"format",
                                        "threads",
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

TitleAndUnit title_of(const std::string& key, const Json& summary) {
  TitleAndUnit t{key.substr(key.rfind('.') + 1), ""};
  const auto units = summary.find("units");
  if (units != summary.end() && units->is_object())
    if (const auto unit = units->find(key); unit != units->end() && unit->is_string()) {
      t.unit = unit->get<std::string>();
      const std::string written = ResultName("", t.unit).key();  // as the key ends in
      if (t.title.ends_with(written)) t.title.resize(t.title.size() - written.size());
    }
  t.title = readable(t.title);
  return t;
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
    if (prefix.empty() && key == "values") continue;  // of a summary: the same numbers
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
