// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/shown_values.hpp"

namespace breccia {

namespace {

constexpr std::size_t draws = 1000;  // from what agrees with the experiment: 5 % are 50 of them
constexpr std::size_t everywhere = 2000;
constexpr double tail = 0.05;          // on either side of an interval
constexpr double far_off = 2;          // distances beyond that are no chance
constexpr double of_no_effect = 0.05;  // share of every target's variance
constexpr double at_bound = 0.01;      // of the range

/// Points of the front: no other is nearer in one target and no farther in the rest.
std::vector<std::size_t> not_dominated(const std::vector<std::vector<double>>& distances) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const auto beats = [&](const std::vector<double>& a, const std::vector<double>& b) {
      bool better = false;
      for (std::size_t t = 0; t < a.size(); ++t) {
        if (a[t] > b[t]) return false;
        better = better || a[t] < b[t];
      }
      return better;
    };
    if (std::none_of(distances.begin(), distances.end(), [&](const auto& d) { return beats(d, distances[i]); }))
      front.push_back(i);
  }
  return front;
}

class Finder {
 public:
  Finder(const CalibrationTrials& trials, Course& course, Host& host)
      : trials_(trials), c_(trials.calibration()), course_(course), host_(host) {}

  CalibrationOutcome operator()() {
    out_.parameters.resize(c_.parameters.size());
    out_.targets.resize(c_.targets.size());
    count_runs();
    out_.has_model = course_.learn(host_);
    best_point();
    if (out_.has_model) {
      model();
      intervals();
      front();
    }
    check();
    say();
    return std::move(out_);
  }

 private:
  void count_runs() {
    for (const CoursePoint& p : course_.points()) {
      ++out_.points;
      for (const TrialResult& r : p.results) {
        ++out_.runs;
        out_.failed += !r.finished;
        out_.out_of_time += r.out_of_time;
      }
    }
  }

  /// That which was checked; of a calibration that was stopped, that which would be now.
  void best_point() {
    if (course_.points().empty()) return;
    const CoursePoint& last = course_.points().back();
    SearchPoint place = last.place;
    if (last.why != CoursePoint::Why::check) {
      if (!out_.has_model) return;
      place = course_.search().best(host_);
    }
    out_.has_best = true;
    for (std::size_t k = 0; k < place.size(); ++k) {
      out_.best.push_back(c_.parameters[k].scale.text(place[k]));
      out_.parameters[k].best = out_.best.back();
      out_.parameters[k].share = c_.parameters[k].scale.share(out_.best.back());
      best_.push_back(out_.parameters[k].share);
    }
  }

  void model() {
    const auto predicted = course_.search().predict(std::vector<SearchPoint>{best_}).front();
    for (std::size_t t = 0; t < c_.targets.size(); ++t) {
      const TargetMeasure& m = c_.targets[t].measure;
      out_.targets[t].predicted = m.back(predicted[t].value);
      out_.targets[t].error = predicted[t].deviation;
    }
    const auto shares = course_.search().sensitivities(host_);
    for (std::size_t k = 0; k < c_.parameters.size(); ++k)
      for (std::size_t t = 0; t < c_.targets.size(); ++t) out_.parameters[k].of_target.push_back(shares[t][k]);
  }

  void intervals() {
    drawn_ = course_.search().plausible(draws, host_);
    for (std::size_t k = 0; k < c_.parameters.size(); ++k) {
      std::vector<double> side;
      for (const SearchPoint& p : drawn_) side.push_back(p[k]);
      std::sort(side.begin(), side.end());
      const auto at = [&](double share) { return side[std::size_t(std::lround(share * double(side.size() - 1)))]; };
      ParameterOutcome& p = out_.parameters[k];
      p.low_share = at(tail);
      p.high_share = at(1 - tail);
      p.low = c_.parameters[k].scale.text(p.low_share);
      p.high = c_.parameters[k].scale.text(p.high_share);
    }
  }

  /// What each target could be had for by itself, and, when they cannot be had together, what one costs the other.
  void front() {
    // Those that agree best, and the whole range, evenly.
    std::vector<SearchPoint> places = drawn_;
    const auto evenly = latin_hypercube(c_.parameters.size(), everywhere, std::uint64_t(c_.config.seed));
    for (std::size_t i = 0; i < everywhere; ++i) {
      SearchPoint p;
      for (const auto& values : evenly) p.push_back(values[i]);
      places.push_back(std::move(p));
    }
    places.push_back(best_);
    const auto predicted = course_.search().predict(places);
    std::vector<std::vector<double>> distances;
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::vector<double> row;
      for (std::size_t t = 0; t < c_.targets.size(); ++t) {
        row.push_back(std::abs(residual_of(c_.targets[t].measure, predicted[i][t].value)));
        double& reach = out_.targets[t].reach;
        if (!(reach <= row.back())) reach = row.back();
      }
      distances.push_back(std::move(row));
    }
    const auto& at_best = distances.back();
    contradict_ = std::any_of(at_best.begin(), at_best.end(), [](double d) { return d > far_off; });
    if (!contradict_ || c_.targets.size() == 1) return;
    for (const std::size_t i : not_dominated(distances)) {
      ParetoPoint p{{}, {}, distances[i]};
      for (std::size_t k = 0; k < c_.parameters.size(); ++k)
        p.values.push_back(c_.parameters[k].scale.text(places[i][k]));
      for (std::size_t t = 0; t < c_.targets.size(); ++t)
        p.predicted.push_back(c_.targets[t].measure.back(predicted[i][t].value));
      out_.front.push_back(std::move(p));
    }
    std::sort(out_.front.begin(), out_.front.end(),
              [](const ParetoPoint& a, const ParetoPoint& b) { return a.distance < b.distance; });
  }

  void check() {
    if (course_.points().empty()) return;
    const CoursePoint& last = course_.points().back();
    for (std::size_t t = 0; t < c_.targets.size(); ++t) {
      const TargetMeasure& m = c_.targets[t].measure;
      TargetOutcome& o = out_.targets[t];
      const double scatter = course_.scatter(t);
      o.scatter = m.log ? scatter * m.value : scatter;
      if (last.why != CoursePoint::Why::check) continue;
      const TargetStatistics s = statistics(last, t, m);
      o.packings = s.count;
      if (s.count == 0) continue;
      o.measured = m.back(s.mean);
      o.residual = residual_of(m, s.mean);
      if (scatter > 0) o.of_packings = (s.mean - m.of(m.value)) / scatter;
    }
  }

  void say() {
    const auto warn = [&](std::string text) { out_.warnings.push_back(std::move(text)); };
    if (out_.failed > 0)
      warn(fmt::format("{} of {} runs have failed; runs.csv says which and why. Their points count as unknown.",
                       out_.failed, out_.runs));
    if (out_.out_of_time > 0)
      warn(fmt::format(
          "{} of the failed runs took longer than `run_time` of the budget{}. How long a run takes depends on the "
          "machine and on what else it does: made anew, this calibration may take another path. In this folder it is "
          "kept which runs were ended, and the path stays.",
          out_.out_of_time, c_.run_time.text.empty() ? "" : ", " + c_.run_time.text));
    if (!out_.has_best) {
      warn("There is no best point: no point has a value of every target.");
      return;
    }
    if (!out_.has_model) {
      warn(
          "Too few points have a value of every target for a model: the best point is the nearest of those that were "
          "run, and has no interval.");
      return;
    }
    for (std::size_t k = 0; k < c_.parameters.size(); ++k) say_of_parameter(k);
    for (std::size_t t = 0; t < c_.targets.size(); ++t) say_of_target(t);
    if (contradict_ && !out_.front.empty() && all_within_reach())
      warn(
          "The targets contradict each other: each can be met within the ranges, all together cannot. pareto.csv has "
          "what one costs the others; the best point is the compromise by their scatter. Intervals mean little then: "
          "no "
          "point agrees with the experiment.");
  }

  bool all_within_reach() const {
    return std::all_of(out_.targets.begin(), out_.targets.end(),
                       [](const TargetOutcome& o) { return !(o.reach > far_off); });
  }

  void say_of_parameter(std::size_t k) {
    const ParameterOutcome& p = out_.parameters[k];
    const std::string& name = c_.parameters[k].name;
    const bool idle = std::all_of(p.of_target.begin(), p.of_target.end(),
                                  [](const SearchSensitivity& s) { return s.total < of_no_effect; });
    if (idle) {
      out_.warnings.push_back(fmt::format(
          "Hardly anything depends on `{}`: it makes less than {:.0f} % of the variance of every target over its "
          "range. Fix it, "
          "or add a target that depends on it.",
          name, 100 * of_no_effect));
      return;  // where it lies within its range means nothing then
    }
    if (p.share < at_bound || p.share > 1 - at_bound)
      out_.warnings.push_back(fmt::format("The best `{}`, {}, is at the {} end of its range: widen the range.", name,
                                          shown(trials_, k, p.best), p.share < 0.5 ? "lower" : "upper"));
    else if (p.high_share - p.low_share > 0.8 && !contradict_)
      out_.warnings.push_back(fmt::format(
          "`{}` is not told by these targets: values from {} to {} agree with them about as well as the best.", name,
          shown(trials_, k, p.low, digits_of_intervals), shown(trials_, k, p.high, digits_of_intervals)));
  }

  void say_of_target(std::size_t t) {
    const TargetOutcome& o = out_.targets[t];
    const TargetMeasure& m = c_.targets[t].measure;
    const std::string& name = c_.targets[t].name;
    if (o.reach > far_off)
      out_.warnings.push_back(fmt::format(
          "`{}` = {} cannot be reached within the ranges, whatever the other targets are: the model comes no nearer "
          "than {:.1f} times its scatter.",
          name, shown(m, m.value), o.reach));
    const double packings = course_.scatter(t), wanted = m.scatter_on_scale();
    const double checked = double(std::max<std::size_t>(1, o.packings));
    if (packings / std::sqrt(checked) > wanted)
      out_.warnings.push_back(fmt::format(
          "The scatter of packings is too large for the budget: `{}` varies by {} from one packing to another, more "
          "than "
          "{} packings of the check average out below the experiment's {}. Take larger specimens or more `packings`.",
          name, shown(m, o.scatter, digits_of_errors), o.packings, shown(m, m.scatter, digits_of_errors)));
    else if (o.error > wanted)
      out_.warnings.push_back(fmt::format(
          "The budget is too small: at the best point the model knows `{}` no better than to {:.1f} times its scatter.",
          name, o.error / wanted));
    const double spread = std::sqrt(wanted * wanted + packings * packings / checked);
    if (o.packings > 0 && std::abs(o.residual) * wanted > far_off * spread && !contradict_ && !(o.reach > far_off))
      out_.warnings.push_back(
          fmt::format("`{}` was missed: {} instead of {}, {:.1f} times what the scatter of experiment and packings "
                      "explains, though "
                      "the model promised better. More runs may help.",
                      name, shown(m, o.measured), shown(m, m.value), std::abs(o.residual) * wanted / spread));
  }

  const CalibrationTrials& trials_;
  const LoadedCalibration& c_;
  Course& course_;
  Host& host_;
  CalibrationOutcome out_;
  SearchPoint best_;
  std::vector<SearchPoint> drawn_;
  bool contradict_ = false;
};

}  // namespace

double residual_of(const TargetMeasure& m, double on_scale) {
  return (on_scale - m.of(m.value)) / m.scatter_on_scale();
}

CalibrationOutcome outcome_of(const CalibrationTrials& trials, Course& course, Host& host) {
  return Finder(trials, course, host)();
}

}  // namespace breccia
