// SPDX-License-Identifier: BSD-3-Clause
/// From the values that a study gives to the points at which its cases are run.
#pragma once

#include "breccia/schema.hpp"
#include "config/base_chain.hpp"

namespace breccia {

enum class LatinScale { linear, log };

struct LatinRange {
  std::string parameter, from, to;
  LatinScale scale;
  static void describe(Schema<LatinRange>& s);
};

struct LatinHypercube {
  long samples, seed;
  std::vector<LatinRange> ranges;
  static void describe(Schema<LatinHypercube>& s);
};

struct StudyParameter {
  std::string path;
  bool sampled;  ///< by the Latin hypercube: its values lie anywhere
};

/// One value of each parameter.
using StudyPoint = std::vector<PlacedValue>;

/// The most cases of a study.
constexpr std::size_t max_cases = 100000;

/// The points are all combinations of a row of the list, a sample of the Latin hypercube and a combination of the grid,
/// as far as these are given; the last parameter of the grid changes fastest. `study` is the file's mapping and
/// satisfies the schema; what is wrong beyond that becomes findings.
struct StudyDesign {
  std::vector<StudyParameter> parameters;
  std::vector<StudyPoint> points;
};
StudyDesign make_design(const YamlNode& study, const std::optional<LatinHypercube>& latin,
                        std::vector<Finding>& findings);

/// A value as it was written, for names and listings.
std::string value_text(const YamlNode& value);

/// Samples of a Latin hypercube on the unit cube: of each parameter, each of `samples` equal strata holds one. The same
/// numbers on every machine. Indexed [parameter][sample].
/// Source: McKay, Beckman, Conover (1979), Technometrics 21, 239-245.
std::vector<std::vector<double>> latin_hypercube(std::size_t parameters, std::size_t samples, std::uint64_t seed);

}  // namespace breccia
