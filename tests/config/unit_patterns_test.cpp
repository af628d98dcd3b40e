// SPDX-License-Identifier: BSD-3-Clause
// The regular expressions of the JSON Schema against UDUNITS, which says of each spelling what it measures.
#include "config/unit_patterns.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "breccia/schema.hpp"
#include "config/distribution_spec.hpp"
#include "config/quantity_schema.hpp"
#include "config/unit_dimension.hpp"
#include "schema_conformance.hpp"

namespace breccia {
namespace {

constexpr const char* si_units[] = {"1",       "m",  "m2",    "m3",   "kg",    "s",     "m/s", "m/s2",
                                    "N",       "Pa", "kg/m3", "1/s",  "rad",   "rad/s", "N/m", "Pa/m",
                                    "N m/rad", "J",  "W",     "Pa s", "N s/m", "Pa/s",  "K",   "A"};

constexpr const char* spellings[] = {
    "m",       "km",      "cm",    "mm",      "um",         "nm",      "in",       "ft",      "inch",     "m2",
    "cm2",     "mm2",     "mm^2",  "m3",      "cm3",        "mm3",     "mm**3",    "l",       "kg",       "g",
    "mg",      "t",       "lb",    "s",       "ms",         "us",      "min",      "h",       "day",      "m/s",
    "cm/s",    "mm/s",    "um/s",  "mm/min",  "km/h",       "m s-1",   "m.s-1",    "m*s^-1",  "m / s",    "m/s2",
    "m s-2",   "m/s/s",   "N",     "kN",      "MN",         "lbf",     "kgf",      "kg m/s2", "Pa",       "kPa",
    "MPa",     "GPa",     "psi",   "ksi",     "kpsi",       "bar",     "kbar",     "atm",     "N/mm2",    "N mm-2",
    "kN/mm^2", "MN/m**2", "J/m3",  "kg/m/s2", "kg m-1 s-2", "kgf/cm2", "lbf/in2",  "kg/m3",   "g/cm3",    "t/m3",
    "lb/ft3",  "1/s",     "s-1",   "1/ms",    "Hz",         "kHz",     "rad",      "deg",     "mrad",     "\u00B0",
    "rad/s",   "deg/s",   "rpm",   "N/m",     "kN/m",       "MN/m",    "GN/m",     "J/m2",    "N/mm",     "kg/s2",
    "Pa m",    "Pa/m",    "MPa/m", "GPa/m",   "N/m3",       "N m/rad", "kN m/rad", "N m/deg", "J/rad",    "J",
    "kJ",      "mJ",      "N m",   "N.m",     "N-m",        "N*m",     "kN m",     "W s",     "kg m2/s2", "W",
    "kW",      "J/s",     "Pa s",  "mPa s",   "N s/m2",     "N s/m",   "kN s/m",   "kg/s",    "kg s-1",   "MPa/s",
    "psi/min", "K",       "degC",  "A",       "%",          "ppm",     "mm/m",     "m/m",     "\u00B5m",  "\u03BCm"};

TEST(UnitPatterns, SayOfEachSpellingWhatUdunitsSays) {
  for (const char* si : si_units) {
    const std::regex pattern("^" + unit_pattern(si) + "$");
    const units::Dimension wanted = units::find_unit(si)->dimension;
    for (const char* spelling : spellings) {
      const auto unit = units::find_unit(spelling);
      ASSERT_TRUE(unit) << spelling;
      EXPECT_EQ(std::regex_match(spelling, pattern), unit->dimension == wanted) << spelling << " for " << si;
    }
    for (const char* unknown :
         {"Gpa", "mmm", "MP", "N/", "/m", "m//s", "m3.5", "m^0.5", "5 m", "x", ",5", "Nm", "PA"}) {
      const auto unit = units::find_unit(unknown);
      if (unit && unit->dimension == wanted) continue;
      EXPECT_FALSE(std::regex_match(unknown, pattern)) << unknown << " for " << si;
    }
  }
}

TEST(UnitPatterns, AdmitWhatTheyCannotJudge) {
  for (const char* text : {"kg/(m s2)", "pascals", "megapascal", "N m s2 m-4 s-2"})
    EXPECT_TRUE(std::regex_match(text, std::regex("^" + unit_pattern("Pa") + "$"))) << text;
}

/// Whether a schema of a quantity with these bounds admits the value.
bool admits(const std::string& unit, std::optional<Bound> lower, std::optional<Bound> upper, const Json& value) {
  ParamSpec spec;
  spec.unit = unit;
  spec.lower = lower;
  spec.upper = upper;
  SchemaDefinitions definitions;
  Json schema = quantity_schema(spec, definitions);
  schema["definitions"] = definitions.all();
  return SchemaChecker::problem(schema, value).empty();
}

TEST(QuantitySchema, SaysTheSignAndWhatIsMoreThanAll) {
  const Bound zero{0, false}, from_zero{0, true}, one{1, true}, below_one{1, false};
  for (const char* fine : {"1 m", "0.001 mm", ".5 m", "1e-9 km", "10 m", "+2 m"})
    EXPECT_TRUE(admits("m", zero, {}, fine)) << fine;
  for (const char* wrong : {"0 m", "-1 m", "0.0 mm", "-0 m", "0e5 m", "00 m", "1", "1 m2"})
    EXPECT_FALSE(admits("m", zero, {}, wrong)) << wrong;
  for (const char* fine : {"0 m", "-0 m", "0.0 mm", "3 m"}) EXPECT_TRUE(admits("m", from_zero, {}, fine)) << fine;
  for (const char* wrong : {"-1 m", "-0.1 m", "-.5 mm"}) EXPECT_FALSE(admits("m", from_zero, {}, wrong)) << wrong;
  EXPECT_TRUE(admits("m", {}, {}, "-3 m"));
  EXPECT_TRUE(admits("K", zero, {}, "-5 degC")) << "the sign of a temperature is not that of its number";
  for (const char* fine : {"0 %", "7.5 %", "99.99 %", "100 %", "100.0 %", "1", "1.0", "0.3", "1e-3", "5 ppm", "3 mm/m"})
    EXPECT_TRUE(admits("1", from_zero, one, fine)) << fine;
  for (const char* wrong : {"100.1 %", "101 %", "250 %", "1000 %", "1.01", "2", "30 m", "-1 %"})
    EXPECT_FALSE(admits("1", from_zero, one, wrong)) << wrong;
  EXPECT_TRUE(admits("1", from_zero, below_one, "99.9 %"));
  for (const char* wrong : {"100 %", "100.00 %", "1", "1.0"})
    EXPECT_FALSE(admits("1", from_zero, below_one, wrong)) << wrong;
  EXPECT_TRUE(admits("1", from_zero, below_one, 0.5));
  EXPECT_FALSE(admits("1", from_zero, below_one, 1.0));
  EXPECT_TRUE(admits("1", from_zero, {}, "250 %")) << "friction has no such end";
}

}  // namespace
}  // namespace breccia
