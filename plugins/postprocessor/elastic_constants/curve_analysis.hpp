// SPDX-License-Identifier: BSD-3-Clause
/// What is read off a stress-strain curve: peak, slopes, secants, brittleness. The curve rises in its own sense:
/// loading makes stress and strain grow.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace breccia {

struct StressStrainCurve {
  std::vector<double> stress, strain, lateral;  ///< [Pa], [1], [1]; one value per sample
  /// How far the test machine has gone [1]: where it goes back the specimen is unloaded, and a fall of the stress is no
  /// failure. Empty for a test that only goes forward. The specimen's own strain does not tell: it may shrink as a
  /// crack opens beside where it is measured.
  std::vector<double> machine = {};
  /// Whether a sample after `peak` shows the specimen at least as far loaded as there.
  bool as_far_as(std::size_t peak, std::size_t row) const { return machine.empty() || machine[row] >= machine[peak]; }
};

struct Peak {
  std::size_t row = 0;
  double stress = 0, strain = 0;
  bool passed = false;  ///< the stress fell afterwards by more than a twentieth, and not because it was unloaded
};

struct Line {
  double slope = 0, r2 = 0;  ///< r2: coefficient of determination
};

struct FitRange {
  std::size_t begin = 0, end = 0;  ///< samples [begin, end)
  std::size_t size() const { return end - begin; }
};

/// A point of the curve between two samples.
struct CurvePoint {
  double stress = 0, strain = 0, lateral = 0;
};

/// The largest stress; the first when it is reached twice. Needs at least one sample.
Peak find_peak(const StressStrainCurve& c);

/// The samples on the way to `upper`, from where the stress last left `lower` behind [Pa].
FitRange loading_range(const StressStrainCurve& c, double lower, double upper);

/// Least squares y = a + b x over the range; nothing with fewer than three samples or when x does not change.
std::optional<Line> fit_line(const std::vector<double>& x, const std::vector<double>& y, const FitRange& range);

/// How far the slopes of the samples with even and with odd places lie apart, over their mean: what the choice of
/// samples alone does to a slope. 0 with too few of them to tell.
double slopes_apart(const std::vector<double>& x, const std::vector<double>& y, const FitRange& range);

/// Where a column of the curve first reaches `level`, or where the stress, past the peak in row `after`, first falls to
/// it [Pa] other than by unloading; interpolated.
std::optional<CurvePoint> first_rise_to(const StressStrainCurve& c, std::vector<double> StressStrainCurve::*of,
                                        double level);
std::optional<CurvePoint> first_fall_to(const StressStrainCurve& c, double level, std::size_t after);

/// From slopes over the axial strain.
struct ConfinedSlopes {
  double youngs_modulus = 0, poisson_ratio = 0;
  double stress_ratio = 0;         ///< lateral over axial stress
  double constrained_modulus = 0;  ///< axial stress over axial strain [Pa]
};

/// Hooke's law for a specimen with the same stress in all cross directions, of which a plane has one: slopes of axial
/// and lateral stress [Pa] and of lateral strain (extension positive) over axial strain. None when the lateral stress
/// grows by less than a twentieth of the axial one, either way.
std::optional<ConfinedSlopes> confined_slopes(double axial, double lateral, double bulging, int dimension);

}  // namespace breccia
