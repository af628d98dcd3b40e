// SPDX-License-Identifier: BSD-3-Clause
#include "config/unit_dimension.hpp"

#include <udunits2.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

#include "breccia/error.hpp"
#include "config/suggest.hpp"

namespace breccia::units {

namespace {

using UnitPtr = std::unique_ptr<ut_unit, decltype(&ut_free)>;

/// UDUNITS keeps global state (status, message handler): one call at a time.
std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

UnitPtr parse(ut_system* system, const std::string& text) {
  return {ut_parse(system, text.c_str(), UT_UTF8), &ut_free};
}

/// The system of units, read once. Call with the mutex held.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* s = ut_read_xml(nullptr);
    if (!s)
      throw UserError(
          "the database of units (udunits2.xml) cannot be read: install the package libudunits2-data, or set "
          "the environment variable UDUNITS2_XML_PATH to the file");
    // UDUNITS only knows the long names of this one.
    const UnitPtr degree = parse(s, "arc_degree");
    if (degree) ut_map_name_to_unit("deg", UT_UTF8, degree.get());
    return s;
  }();
  return system;
}

// Visitors that add up the basic units of a unit in a Dimension.
const ut_visitor& dimension_visitor();

void add_basic(const ut_unit* unit, int power, void* dimension) {
  const char* symbol = ut_get_symbol(unit, UT_ASCII);
  if (!symbol) symbol = ut_get_name(unit, UT_ASCII);
  (*static_cast<Dimension*>(dimension))[symbol ? symbol : "?"] += power;
}
ut_status visit_basic(const ut_unit* unit, void* dimension) {
  add_basic(unit, 1, dimension);
  return UT_SUCCESS;
}
ut_status visit_product(const ut_unit*, int count, const ut_unit* const* basic, const int* powers, void* dimension) {
  for (int k = 0; k < count; ++k) add_basic(basic[k], powers[k], dimension);
  return UT_SUCCESS;
}
ut_status visit_galilean(const ut_unit*, double, const ut_unit* underlying, double, void* dimension) {
  return ut_accept_visitor(underlying, &dimension_visitor(), dimension);
}
ut_status visit_timestamp(const ut_unit*, const ut_unit*, double, void*) { return UT_MEANINGLESS; }
ut_status visit_logarithmic(const ut_unit*, double, const ut_unit*, void*) { return UT_MEANINGLESS; }

const ut_visitor& dimension_visitor() {
  static const ut_visitor visitor{visit_basic, visit_product, visit_galilean, visit_timestamp, visit_logarithmic};
  return visitor;
}

/// The product of basic units with that dimension, in UDUNITS' spelling.
std::string basic_text(const Dimension& dimension) {
  std::string text;
  for (const auto& [symbol, power] : dimension) text += (text.empty() ? "" : ".") + symbol + std::to_string(power);
  return text.empty() ? "1" : text;
}

constexpr Family families[] = {
    {"a plain number", "1", "or a share in %", "%"},
    {"a length", "m", "m, cm or mm", "mm"},
    {"an area", "m2", "m2 or mm2", "mm2"},
    {"a volume", "m3", "m3 or cm3", "cm3"},
    {"a mass", "kg", "kg or g", "kg"},
    {"a time", "s", "s, ms or min", "s"},
    {"a velocity", "m/s", "m/s or mm/s", "m/s"},
    {"an acceleration", "m/s2", "m/s2", "m/s2"},
    {"a force", "N", "N, kN or MN", "kN"},
    {"a pressure", "Pa", "Pa, MPa, GPa or psi", "MPa"},
    {"a density", "kg/m3", "kg/m3 or g/cm3", "kg/m3"},
    {"a rate", "1/s", "1/s or Hz", "1/s"},
    {"an angle", "rad", "deg or rad", "deg"},
    {"an angular velocity", "rad/s", "rad/s, deg/s or rpm", "rad/s"},
    {"a stiffness", "N/m", "N/m or MN/m", "MN/m"},
    {"a stiffness per area", "Pa/m", "Pa/m or GPa/m", "GPa/m"},
    {"a rotational stiffness", "N m/rad", "N m/rad or kN m/rad", "N m/rad"},
    {"an energy or a moment", "J", "J, kJ or N m", "J"},
    {"a power", "W", "W or kW", "W"},
    {"a viscosity", "Pa s", "Pa s", "Pa s"},
    {"a damping coefficient", "N s/m", "N s/m or kN s/m", "N s/m"},
    {"a rate of pressure", "Pa/s", "Pa/s or MPa/s", "MPa/s"},
    {"a temperature", "K", "K", "K"},
    {"an electric current", "A", "A", "A"},
};

const std::vector<std::string>& common_units() {
  static const std::vector<std::string> list{
      "m",    "km",   "cm",    "mm",    "um",      "nm",       "in",    "ft",  "m2",    "cm2",     "mm2",  "m3",
      "cm3",  "mm3",  "kg",    "g",     "mg",      "t",        "lb",    "s",   "ms",    "us",      "min",  "h",
      "m/s",  "cm/s", "mm/s",  "um/s",  "mm/min",  "km/h",     "m/s2",  "N",   "kN",    "MN",      "lbf",  "kgf",
      "Pa",   "kPa",  "MPa",   "GPa",   "psi",     "ksi",      "bar",   "atm", "kg/m3", "g/cm3",   "t/m3", "1/s",
      "Hz",   "kHz",  "rad",   "deg",   "mrad",    "rad/s",    "deg/s", "rpm", "N/m",   "kN/m",    "MN/m", "GN/m",
      "J/m2", "Pa/m", "MPa/m", "GPa/m", "N m/rad", "kN m/rad", "J",     "kJ",  "mJ",    "N m",     "kN m", "W",
      "kW",   "Pa s", "mPa s", "N s/m", "kN s/m",  "MPa/s",    "kPa/s", "K",   "%",     "percent", "ppm"};
  return list;
}

}  // namespace

std::optional<Unit> find_unit(std::string_view text) {
  const std::lock_guard lock(library_mutex());
  ut_system* system = unit_system();
  const UnitPtr unit = parse(system, std::string(text));
  if (!unit) return {};
  Unit found;
  if (ut_accept_visitor(unit.get(), &dimension_visitor(), &found.dimension) != UT_SUCCESS) return {};
  std::erase_if(found.dimension, [](const auto& entry) { return entry.second == 0; });
  const UnitPtr basic = parse(system, basic_text(found.dimension));
  if (!basic) return {};
  const std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(unit.get(), basic.get()),
                                                                    &cv_free);
  if (!converter) return {};
  found.offset = cv_convert_double(converter.get(), 0.0);
  found.factor = cv_convert_double(converter.get(), 1.0) - found.offset;
  if (!std::isfinite(found.factor) || !std::isfinite(found.offset) || found.factor == 0) return {};
  return found;
}

const Family* family_of(const Dimension& dimension) {
  static const auto table = [] {
    std::map<Dimension, const Family*> all;
    for (const Family& family : families)
      if (const auto unit = find_unit(family.si)) all.emplace(unit->dimension, &family);
    return all;
  }();
  const auto it = table.find(dimension);
  return it == table.end() ? nullptr : it->second;
}

std::string similar_unit(std::string_view written, const Dimension& dimension) {
  std::vector<std::string> fitting;
  for (const std::string& name : common_units())
    if (const auto unit = find_unit(name); unit && unit->dimension == dimension) fitting.push_back(name);
  // Only a change of case, of spaces or of one letter: the table would turn `ft` into `mm` otherwise.
  const std::string near = closest(written, fitting);
  return !near.empty() && edit_distance(written, near) <= 1 ? near : std::string();
}

}  // namespace breccia::units
