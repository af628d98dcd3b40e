// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/course.hpp"

#include <algorithm>
#include <cmath>

#include "plugin/guarded.hpp"

namespace breccia {

namespace {

/// Of the packings of the check: far from those of all other points, however many there will be.
constexpr long check_seeds = 1000000;

constexpr std::size_t least_points = 3;  // beyond one for each parameter: fewer tell nothing

}  // namespace

CoursePlan plan_course(const LoadedCalibration& c) {
  const CalibrationBudget& b = c.config.budget;
  const std::size_t workflows = c.workflows.size(), needed = c.parameters.size() + least_points;
  const std::size_t start = workflows * std::size_t(std::max(b.start_packings, b.packings)),
                    check = workflows * std::size_t(b.check_packings), each = workflows * std::size_t(b.packings);
  const std::size_t runs = std::size_t(b.runs), least = start + (needed - 1) * each + check;
  if (runs < least)
    throw UserError(std::to_string(runs) + (runs == 1 ? " run is" : " runs are") + " too few for " +
                    std::to_string(c.parameters.size()) + " parameters in " + std::to_string(workflows) +
                    (workflows == 1 ? " workflow" : " workflows") + ": at least " + std::to_string(least) +
                    " are needed (" + std::to_string(start) + " at the start, " + std::to_string(check) +
                    " for the check, " + std::to_string(each) + " for each point between)");
  const std::size_t points = 1 + (runs - start - check) / each;
  CoursePlan plan{{}, start + (points - 1) * each + check};
  std::size_t left = points;
  for (std::size_t s = 0; s < c.stages.size(); ++s) {
    const bool last = s + 1 == c.stages.size();
    const std::size_t share = std::max<std::size_t>(1, std::size_t(std::lround(c.stages[s].share * double(points))));
    plan.points.push_back(last ? left : std::min(share, left));
    left -= plan.points.back();
  }
  if (plan.points.back() == 0 || plan.points.front() < needed)
    throw UserError(std::to_string(points) + " points are too few to share: the first stage needs " +
                    std::to_string(needed) + " and each other one at least one");
  return plan;
}

TargetStatistics statistics(const CoursePoint& p, std::size_t target, const TargetMeasure& m) {
  TargetStatistics s;
  double sum = 0, squares = 0;
  for (const TrialResult& r : p.results) {
    const double v = r.finished ? m.of(r.value[target]) : NAN;
    if (!std::isfinite(v)) continue;
    ++s.count;
    sum += v;
  }
  if (s.count == 0) return s;
  s.mean = sum / double(s.count);
  for (const TrialResult& r : p.results)
    if (const double v = r.finished ? m.of(r.value[target]) : NAN; std::isfinite(v))
      squares += (v - s.mean) * (v - s.mean);
  if (s.count > 1) s.deviation = std::sqrt(squares / double(s.count - 1));
  return s;
}

Course::Course(const LoadedCalibration& calibration, Search& search)
    : c_(calibration), search_(search), plan_(plan_course(calibration)) {}

SearchTask Course::task() const {
  SearchTask task;
  task.dimension = c_.parameters.size();
  task.seed = std::uint64_t(c_.config.seed);
  for (const auto& t : c_.targets)
    task.targets.push_back({t.measure.of(t.measure.value), t.measure.scatter_on_scale()});
  return task;
}

std::size_t Course::count(std::size_t stage) const {
  return std::size_t(std::count_if(points_.begin(), points_.end(), [&](const CoursePoint& p) {
    return p.stage == stage && p.why != CoursePoint::Why::check;
  }));
}

CoursePoint Course::make(CoursePoint::Why why, const SearchPoint& place, std::size_t packings) {
  CoursePoint p;
  p.why = why;
  p.stage = stage_;
  for (std::size_t k = 0; k < c_.parameters.size(); ++k) {
    p.values.push_back(c_.parameters[k].scale.text(place[k]));
    p.place.push_back(c_.parameters[k].scale.share(p.values.back()));
  }
  const bool check = why == CoursePoint::Why::check;
  for (std::size_t j = 0; j < packings; ++j)
    for (std::size_t w = 0; w < c_.workflows.size(); ++w)
      p.trials.push_back({stage_, w, c_.config.seed + (check ? check_seeds : seeds_) + long(j), p.values});
  if (!check) seeds_ += long(packings);
  return p;
}

std::vector<CoursePoint> Course::next(Host& host) {
  using Why = CoursePoint::Why;
  const CalibrationBudget& budget = c_.config.budget;
  std::vector<CoursePoint> batch;
  if (points_.empty()) {
    SearchPoint start;
    for (const auto& p : c_.parameters) start.push_back(p.start.value_or(0.5));
    batch.push_back(make(Why::start, start, std::size_t(std::max(budget.start_packings, budget.packings))));
    return batch;
  }
  if (points_.back().why == Why::check) return batch;
  const std::size_t have = count(stage_), planned = plan_.points[stage_];
  if (have < planned) {
    const std::size_t size = std::min(std::size_t(budget.batch), planned - have);
    learn(host);
    if (stage_ == 0 && have == 1)
      if (const auto scaled = scaled_start()) batch.push_back(make(Why::scaled, *scaled, std::size_t(budget.packings)));
    if (batch.size() == size) return batch;
    for (const SearchPoint& place : calling({Search::kind, c_.search}, "proposing points",
                                            [&] { return search_.propose(size - batch.size(), host); }))
      batch.push_back(make(Why::search, place, std::size_t(budget.packings)));
    return batch;
  }
  const std::optional<SearchPoint> place = best(host);
  if (!place) return batch;
  if (stage_ + 1 < c_.stages.size()) {
    carried_ = known(host);
    ++stage_;
    batch.push_back(make(Why::stage, *place, std::size_t(budget.packings)));
  } else {
    batch.push_back(make(Why::check, *place, std::size_t(budget.check_packings)));
  }
  return batch;
}

void Course::add(std::vector<CoursePoint> points) {
  for (CoursePoint& p : points) {
    BRECCIA_ASSERT(p.results.size() == p.trials.size());
    points_.push_back(std::move(p));
  }
}

/// Stresses in proportion to strengths, moduli to moduli; several targets by their mean ratio.
std::optional<SearchPoint> Course::scaled_start() const {
  const CoursePoint& start = points_.front();
  SearchPoint place = start.place;
  bool any = false;
  for (std::size_t k = 0; k < c_.parameters.size(); ++k) {
    double logs = 0;
    std::size_t count = 0;
    for (const std::size_t t : c_.parameters[k].scales_with) {
      const TargetMeasure& m = c_.targets[t].measure;
      const double got = m.back(statistics(start, t, m).mean);
      if (!(got > 0)) continue;
      logs += std::log(m.value / got);
      ++count;
    }
    if (count == 0) continue;
    const ParameterScale& scale = c_.parameters[k].scale;
    const double value = scale.number(start.place[k]) * std::exp(logs / double(count));
    const double share = scale.log ? std::log(value / scale.from) / std::log(scale.to / scale.from)
                                   : (value - scale.from) / (scale.to - scale.from);
    place[k] = std::clamp(share, 0.0, 1.0);
    any = any || std::abs(place[k] - start.place[k]) > 0.01;
  }
  if (!any) return {};
  return place;
}

double Course::scatter_of(std::size_t target, std::size_t stage) const {
  const TargetMeasure& m = c_.targets[target].measure;
  const auto pooled = [&](bool all) {
    double squares = 0, freedom = 0;
    for (const CoursePoint& p : points_) {
      if (!all && p.stage != stage) continue;
      const TargetStatistics s = statistics(p, target, m);
      if (s.count < 2) continue;
      squares += s.deviation * s.deviation * double(s.count - 1);
      freedom += double(s.count - 1);
    }
    return freedom > 0 ? std::sqrt(squares / freedom) : NAN;
  };
  for (const bool all : {false, true})
    if (const double d = pooled(all); std::isfinite(d)) return d;
  return m.scatter_on_scale() / 2;  // nothing could be measured twice
}

std::vector<SearchEvaluation> Course::evaluations(std::size_t stage) const {
  std::vector<SearchEvaluation> all;
  std::vector<double> scatter;
  for (std::size_t t = 0; t < c_.targets.size(); ++t) scatter.push_back(scatter_of(t, stage));
  for (const CoursePoint& p : points_) {
    if (p.stage != stage) continue;
    SearchEvaluation e{p.place, {}, {}};
    for (std::size_t t = 0; t < c_.targets.size(); ++t) {
      const TargetStatistics s = statistics(p, t, c_.targets[t].measure);
      e.value.push_back(s.mean);
      e.variance.push_back(s.count ? scatter[t] * scatter[t] / double(s.count) : 0);
    }
    all.push_back(std::move(e));
  }
  return all;
}

bool Course::enough(const std::vector<SearchEvaluation>& all) const {
  for (std::size_t t = 0; t < c_.targets.size(); ++t) {
    const auto n =
        std::count_if(all.begin(), all.end(), [&](const SearchEvaluation& e) { return std::isfinite(e.value[t]); });
    if (std::size_t(n) < search_.needs()) return false;
  }
  return true;
}

/// What stages before have taught stands with their difference to this one added, as far as its own points tell it:
/// specimens of another size are weaker or stronger, but by much the same everywhere.
/// Source: Kennedy, O'Hagan (2000), Biometrika 87, 1-13, with a difference that is constant.
std::vector<SearchEvaluation> Course::known(Host& host) {
  std::vector<SearchEvaluation> own = evaluations(stage_);
  if (carried_.empty()) return own;
  search_.learn(task(), carried_, host);
  if (!enough(carried_)) return own;
  std::vector<SearchPoint> places;
  for (const SearchEvaluation& e : own) places.push_back(e.point);
  const auto before = search_.predict(places);
  std::vector<SearchEvaluation> all = carried_;
  for (std::size_t t = 0; t < c_.targets.size(); ++t) {
    double weights = 0, sum = 0, squares = 0, mean_variance = 0, count = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const double d = own[i].value[t] - before[i][t].value;
      if (!std::isfinite(d)) continue;
      const double v = own[i].variance[t] + before[i][t].deviation * before[i][t].deviation + 1e-12;
      weights += 1 / v;
      sum += d / v;
      squares += d * d;
      mean_variance += v;
      ++count;
    }
    if (count == 0) continue;
    const double shift = sum / weights;
    // What the differences scatter by beyond what chance explains is what a constant does not tell.
    const double beyond = count > 2 ? std::max(0.0, squares / count - shift * shift - mean_variance / count) : 0;
    for (SearchEvaluation& e : all) {
      e.value[t] += shift;
      e.variance[t] += 1 / weights + beyond;
    }
  }
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

bool Course::learn(Host& host) {
  const std::vector<SearchEvaluation> all = known(host);
  calling({Search::kind, c_.search}, "learning", [&] { search_.learn(task(), all, host); });
  return enough(all);
}

/// As the search has it; where it knows too little, the point that came nearest; none when no point has a value of
/// every target.
std::optional<SearchPoint> Course::best(Host& host) {
  if (learn(host))
    return calling({Search::kind, c_.search}, "looking for the best point", [&] { return search_.best(host); });
  const CoursePoint* nearest = nullptr;
  double least = INFINITY;
  for (const CoursePoint& p : points_) {
    double sum = 0;
    for (std::size_t t = 0; t < c_.targets.size(); ++t) {
      const TargetMeasure& m = c_.targets[t].measure;
      const double z = (statistics(p, t, m).mean - m.of(m.value)) / m.scatter_on_scale();
      sum += z * z;
    }
    if (std::isfinite(sum) && sum < least) {
      least = sum;
      nearest = &p;
    }
  }
  if (!nearest) return {};
  return nearest->place;
}

}  // namespace breccia
