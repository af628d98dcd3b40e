// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `search`: where in a box to look next for a point whose values are those wanted. It knows neither
/// particles nor units: the host maps parameters to the unit cube and results to numbers whose scatter is much the same
/// everywhere.
#pragma once

#include <cstdint>
#include <span>

#include "breccia/plugin.hpp"
#include "breccia/services.hpp"

namespace breccia {

using SearchPoint = std::vector<double>;  ///< in the unit cube

struct SearchTarget {
  double wanted = 0;
  double scatter = 1;  ///< standard deviation by which the wanted value itself is uncertain; above 0
};

struct SearchTask {
  std::size_t dimension = 1;          ///< of the cube
  std::vector<SearchTarget> targets;  ///< at least one
  std::uint64_t seed = 1;             ///< whatever is drawn depends on it, and on nothing else that is not told
};

/// What was measured at one point.
struct SearchEvaluation {
  SearchPoint point;
  std::vector<double> value;     ///< one per target; NaN: it could not be measured there
  std::vector<double> variance;  ///< of these, by chance: another packing would give another value
};

struct SearchPrediction {
  double value = 0, deviation = 0;  ///< of one target; the deviation is that of the model, without the scatter of runs
};

/// Shares of the variance of one target over the cube that come from one parameter: by itself, and with all others.
struct SearchSensitivity {
  double alone = 0, total = 0;
};

/// Whatever it answers depends on what `learn` was told last, and on nothing else: the host may kill it at any time and
/// tell it everything anew.
class BRECCIA_API Search : public Plugin {
 public:
  static constexpr const char* kind = "search";
  /// All that is known, in the order in which it was proposed; replaces what was learned before. May be nothing.
  virtual void learn(const SearchTask& task, std::span<const SearchEvaluation> known, Host& host) = 0;
  /// The next points, none of which is known. From too few evaluations: points that fill the cube.
  virtual std::vector<SearchPoint> propose(std::size_t count, Host& host) = 0;
  /// How many evaluations with a value of each target it needs before it can answer what stands below.
  virtual std::size_t needs() const = 0;
  /// One row per point, in it one prediction per target.
  virtual std::vector<std::vector<SearchPrediction>> predict(std::span<const SearchPoint> points) const = 0;
  /// Where the distance from what is wanted, in units of the scatter, is expected to be least.
  virtual SearchPoint best(Host& host) const = 0;
  /// Points drawn by how well they agree with what is wanted, its scatter and the error of the model taken together.
  virtual std::vector<SearchPoint> plausible(std::size_t count, Host& host) const = 0;
  /// One row per target, in it one pair per parameter.
  virtual std::vector<std::vector<SearchSensitivity>> sensitivities(Host& host) const = 0;
};

}  // namespace breccia
