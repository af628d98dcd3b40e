// SPDX-License-Identifier: BSD-3-Clause
/// The course of a calibration: which points are run in which order, by what has been learned. It depends on the
/// calibration and on results alone, so that it can be gone again after a kill, to the same points.
#pragma once

#include "breccia/search.hpp"
#include "calibrate/trials.hpp"

namespace breccia {

/// What a run gave.
struct TrialResult {
  bool finished = false;
  std::string error;          ///< why not
  bool out_of_time = false;   ///< it took longer than a run may
  std::vector<double> value;  ///< of each target, SI; NaN for those of other workflows and what was not measured
};

struct CoursePoint {
  enum class Why { start, scaled, search, stage, check };
  Why why = Why::search;
  std::size_t stage = 0;
  TrialPoint values;
  SearchPoint place;  ///< of these values, as they were rounded
  std::vector<Trial> trials;
  std::vector<TrialResult> results = {};  ///< one per trial, once they are known
};

/// How many points the budget has in each stage.
struct CoursePlan {
  std::vector<std::size_t> points;
  std::size_t runs = 0;  ///< of all, start and check included
};
/// UserError when the budget is too small to learn anything.
CoursePlan plan_course(const LoadedCalibration& c);

/// Means and scatter of the targets over some results, on the scale of the target.
struct TargetStatistics {
  double mean = NAN, deviation = NAN;  ///< from one packing to another; NaN below two
  std::size_t count = 0;
};
TargetStatistics statistics(const CoursePoint& p, std::size_t target, const TargetMeasure& m);

class Course {
 public:
  Course(const LoadedCalibration& calibration, Search& search);

  /// The next points, to be run in any order; none at the end.
  std::vector<CoursePoint> next(Host& host);
  /// Those points with their results, in the order in which they were proposed.
  void add(std::vector<CoursePoint> points);

  const std::vector<CoursePoint>& points() const { return points_; }
  /// Tells the search all that is known of the last stage; whether that is enough for it to answer.
  bool learn(Host& host);
  /// The deviation of a target from one packing to another, on its scale, over all points of the last stage.
  double scatter(std::size_t target) const { return scatter_of(target, stage_); }
  SearchTask task() const;
  Search& search() const { return search_; }

 private:
  CoursePoint make(CoursePoint::Why why, const SearchPoint& place, std::size_t packings);
  std::optional<SearchPoint> scaled_start() const;
  std::optional<SearchPoint> best(Host& host);
  std::vector<SearchEvaluation> evaluations(std::size_t stage) const;
  std::vector<SearchEvaluation> known(Host& host);
  bool enough(const std::vector<SearchEvaluation>& all) const;
  double scatter_of(std::size_t target, std::size_t stage) const;
  std::size_t count(std::size_t stage) const;

  const LoadedCalibration& c_;
  Search& search_;
  CoursePlan plan_;
  std::size_t stage_ = 0;
  std::vector<SearchEvaluation> carried_;  ///< of the stages before
  std::vector<CoursePoint> points_;
  long seeds_ = 0;  ///< that were given out, but for checks
};

}  // namespace breccia
