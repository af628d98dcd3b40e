// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "breccia/atomic_file.hpp"
#include "breccia/renderer.hpp"
#include "calibrate/calibration_files.hpp"
#include "calibrate/shown_values.hpp"
#include "plugin/drawing.hpp"
#include "plugin/guarded.hpp"
#include "results/summary_keys.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

constexpr double worth_a_chart = 0.2;  // share of a target's variance
constexpr std::size_t along = 41;      // points of a line of the model

class Charts {
 public:
  Charts(const CalibrationTrials& trials, Course& course, const CalibrationOutcome& outcome)
      : trials_(trials), c_(trials.calibration()), course_(course), o_(outcome) {}

  std::vector<StudyChart> all() const {
    std::vector<StudyChart> charts{distance()};
    for (std::size_t t = 0; t < c_.targets.size(); ++t) charts.push_back(target(t));
    if (!o_.has_model) return charts;
    for (std::size_t t = 0; t < c_.targets.size(); ++t)
      for (std::size_t k = 0; k < c_.parameters.size(); ++k)
        if (o_.parameters[k].of_target[t].total >= worth_a_chart) charts.push_back(dependence(t, k));
    if (!o_.front.empty())
      for (std::size_t t = 1; t < c_.targets.size(); ++t) charts.push_back(front(t));
    return charts;
  }

 private:
  StudyChart::Axis axis(std::size_t t) const { return {readable(c_.targets[t].name), c_.targets[t].measure.unit}; }
  double value(const CoursePoint& p, std::size_t t) const {
    const TargetMeasure& m = c_.targets[t].measure;
    return m.back(statistics(p, t, m).mean);
  }

  StudyChart distance() const {
    StudyChart chart{{"point", "1"}, {"distance from the targets, in scatters", "1"}, {}, "distance_over_points"};
    StudyChart::Series each{"each point", {}, {}, false}, best{"best so far", {}, {}, true};
    double least = INFINITY;
    for (const CoursePoint& p : course_.points()) {
      double sum = 0;
      for (std::size_t t = 0; t < c_.targets.size(); ++t) {
        const TargetMeasure& m = c_.targets[t].measure;
        const double z = residual_of(m, statistics(p, t, m).mean);
        sum += z * z / double(c_.targets.size());
      }
      const double x = double(each.x.size() + 1), y = std::sqrt(sum);
      each.x.push_back(x);
      each.y.push_back(y);
      if (std::isfinite(y)) least = std::min(least, y);
      best.x.push_back(x);
      best.y.push_back(std::isfinite(least) ? least : NAN);
    }
    chart.series = {std::move(each), std::move(best)};
    return chart;
  }

  StudyChart target(std::size_t t) const {
    StudyChart chart{{"point", "1"}, axis(t), {}, c_.targets[t].name + "_over_points"};
    StudyChart::Series runs{"runs", {}, {}, false};
    const double last = double(course_.points().size());
    double number = 0;
    for (const CoursePoint& p : course_.points()) {
      ++number;
      for (const TrialResult& r : p.results)
        if (r.finished && std::isfinite(r.value[t])) {
          runs.x.push_back(number);
          runs.y.push_back(r.value[t]);
        }
    }
    chart.series = {std::move(runs), wanted(t, 1, last)};
    return chart;
  }

  StudyChart::Series wanted(std::size_t t, double from, double to) const {
    const double v = c_.targets[t].measure.value;
    return {"experiment", {from, to}, {v, v}, true};
  }

  /// What was run, and the model through the best point.
  StudyChart dependence(std::size_t t, std::size_t k) const {
    const auto& p = c_.parameters[k];
    StudyChart chart{
        {readable(p.name), trials_.parameter_units()[k]}, axis(t), {}, c_.targets[t].name + "_over_" + p.name};
    StudyChart::Series runs{"points", {}, {}, false}, model{"model, the others at their best", {}, {}, true};
    for (const CoursePoint& point : course_.points()) {
      const double y = value(point, t);
      if (!std::isfinite(y)) continue;
      runs.x.push_back(si_value(trials_, k, point.values[k]));
      runs.y.push_back(y);
    }
    std::vector<SearchPoint> places;
    SearchPoint place;
    for (const ParameterOutcome& one : o_.parameters) place.push_back(one.share);
    for (std::size_t i = 0; i < along; ++i) {
      place[k] = double(i) / double(along - 1);
      places.push_back(place);
    }
    const auto predicted = course_.search().predict(places);
    for (std::size_t i = 0; i < along; ++i) {
      model.x.push_back(si_value(trials_, k, p.scale.text(places[i][k])));
      model.y.push_back(c_.targets[t].measure.back(predicted[i][t].value));
    }
    chart.series = {std::move(runs), std::move(model),
                    wanted(t, si_value(trials_, k, p.scale.text(0)), si_value(trials_, k, p.scale.text(1)))};
    return chart;
  }

  StudyChart front(std::size_t t) const {
    StudyChart chart{axis(0), axis(t), {}, "pareto_" + c_.targets[0].name + "_" + c_.targets[t].name};
    StudyChart::Series points{"front", {}, {}, false},
        here{"experiment", {c_.targets[0].measure.value}, {c_.targets[t].measure.value}, false};
    for (const ParetoPoint& p : o_.front) {
      points.x.push_back(p.predicted[0]);
      points.y.push_back(p.predicted[t]);
    }
    chart.series = {std::move(points), std::move(here)};
    return chart;
  }

  const CalibrationTrials& trials_;
  const LoadedCalibration& c_;
  Course& course_;
  const CalibrationOutcome& o_;
};

}  // namespace

std::vector<fs::path> draw_calibration(const CalibrationTrials& trials, Course& course,
                                       const CalibrationOutcome& outcome, const fs::path& folder, Host& host) {
  std::vector<fs::path> made;
  const LoadedCalibration& c = trials.calibration();
  const auto choice = c.config.renderer ? c.config.renderer : usual_renderer({}, Registry(), host);
  if (!choice || course.points().empty()) return made;
  drawn("charts", choice->type, Refusal::warns, host, [&] {
    const auto renderer = Registry().create<Renderer>(*choice);
    for (StudyChart chart : Charts(trials, course, outcome).all()) {
      if (host.cancelled()) throw Cancelled();
      const std::string name = chart.file.string();
      chart.file = folder / name;
      try {
        const auto files =
            calling({Renderer::kind, choice->type}, "drawing", [&] { return renderer->chart(chart, host); });
        made.insert(made.end(), files.begin(), files.end());
      } catch (const CannotWrite&) { throw; } catch (const UserError& e) {
        host.warn("chart `" + name + "` was not drawn: " + e.what());
      }
    }
    return std::vector<fs::path>();  // all are in `made`
  });
  return made;
}

}  // namespace breccia
