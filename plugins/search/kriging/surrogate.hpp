// SPDX-License-Identifier: BSD-3-Clause
/// What is known of one target over the cube: a Gaussian process on a linear trend, with the scatter of the runs as
/// its noise.
#pragma once

#include <openturns/KrigingResult.hxx>
#include <openturns/Sample.hxx>

namespace kriging {

struct Settings {
  bool linear_trend = true;
  double smoothness = 2.5;  ///< of the Matérn covariance
};

/// Values and deviations of one target at many points.
struct Predicted {
  OT::Point value, deviation;
};

class Surrogate {
 public:
  /// Of at least two points. `variance`: by chance, of each value.
  Surrogate(const OT::Sample& points, const OT::Point& values, const OT::Point& variance, const Settings& settings);

  Predicted operator()(const OT::Sample& points) const;
  /// The same model with a point more, as if what it predicts there had been measured.
  void believe(const OT::Point& point);

 private:
  void fit(bool learn);
  Settings settings_;
  OT::Sample points_;
  OT::Point values_, noise_;  // of values about `middle_` in units of `unit_`
  double middle_ = 0, unit_ = 1;
  OT::CovarianceModel covariance_;
  OT::KrigingResult result_;
};

}  // namespace kriging
