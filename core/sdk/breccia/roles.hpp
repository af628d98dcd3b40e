// SPDX-License-Identifier: BSD-3-Clause
/// What a curve is in its test: by this, not by its name, charts, reports and scripts find what they show of tests that
/// they do not know. A role may be held by several curves; the first is meant. Most curves have none.
#pragma once

#include <initializer_list>
#include <string_view>

namespace breccia::role {

inline constexpr const char* strain = "axial_strain";                ///< of the specimen, compression positive
inline constexpr const char* stress = "axial_stress";                ///< in the specimen, compression positive
inline constexpr const char* lateral_strain = "lateral_strain";      ///< of the specimen, extension positive
inline constexpr const char* machine_strain = "machine_strain";      ///< how far what loads along the axis has gone
inline constexpr const char* machine_stress = "machine_stress";      ///< what it presses with; compression positive
inline constexpr const char* diametral_strain = "diametral_strain";  ///< the same, of a test across the axis
inline constexpr const char* splitting_stress = "splitting_stress";  ///< tension positive
inline constexpr const char* load = "load";                          // [N]
inline constexpr const char* displacement = "displacement";          ///< of what loads, along the load [m]
inline constexpr const char* damage = "damage";                      ///< share of broken bonds

/// Of a table that says nothing of roles, as of one that an older Breccia wrote: the names that its curves had.
constexpr std::string_view of_name(std::string_view name) {
  if (name == "axial_strain") return strain;
  if (name == "axial_stress") return stress;
  if (name == "lateral_strain") return lateral_strain;
  if (name == "platen_strain") return machine_strain;
  if (name == "platen_stress" || name == "cell_axial_stress") return machine_stress;
  if (name == "diametral_strain") return diametral_strain;
  if (name == "tensile_stress") return splitting_stress;
  if (name == "load") return load;
  if (name == "platen_displacement" || name == "load_displacement") return displacement;
  if (name == "global_damage") return damage;
  return {};
}

/// The first of `columns` that has the first of these roles that any has; none: null.
template <class Columns>
auto find(const Columns& columns, std::initializer_list<std::string_view> roles) -> decltype(&*columns.begin()) {
  for (const std::string_view wanted : roles)
    for (const auto& c : columns)
      if (c.role == wanted) return &c;
  return nullptr;
}

}  // namespace breccia::role
