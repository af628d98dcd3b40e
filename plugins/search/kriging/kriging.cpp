// SPDX-License-Identifier: BSD-3-Clause
/// Efficient global optimisation towards several wanted values at once: a surrogate per target, expected improvement of
/// the sum of their squared distances.
/// Sources: Jones, Schonlau, Welch (1998), J. Global Optim. 13, 455-492; Uhrenholt, Jensen (2019), AISTATS, PMLR 89,
/// 2661-2670: distances to several wanted values; Picheny, Wagner, Ginsbourger (2013), Struct. Multidiscip. Optim. 48,
/// 607-626: noise; Ginsbourger, Le Riche, Carraro (2010): several points at a time, each believed in.
#include <algorithm>
#include <cmath>
#include <memory>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/DistFunc.hxx>
#include <openturns/EvaluationImplementation.hxx>
#include <openturns/Function.hxx>
#include <openturns/JansenSensitivityAlgorithm.hxx>
#include <openturns/Log.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/ResourceMap.hxx>
#include <openturns/TBBImplementation.hxx>
#include <openturns/Uniform.hxx>

#include "breccia/search.hpp"
#include "candidates.hpp"
#include "drawing.hpp"
#include "surrogate.hpp"

namespace {

using namespace breccia;
using kriging::Predicted;
using kriging::Surrogate;

enum class Trend { constant, linear };

OT::Point ot(const SearchPoint& p) {
  OT::Point point(p.size());
  std::copy(p.begin(), p.end(), point.begin());
  return point;
}
SearchPoint ours(const OT::Point& p) { return {p.begin(), p.end()}; }

/// A function of OpenTURNS made of one of ours.
class Called final : public OT::EvaluationImplementation {
 public:
  using Each = std::function<OT::Sample(const OT::Sample&)>;
  Called(OT::UnsignedInteger in, OT::UnsignedInteger out, Each each) : in_(in), out_(out), each_(std::move(each)) {}
  Called* clone() const override { return new Called(*this); }
  OT::UnsignedInteger getInputDimension() const override { return in_; }
  OT::UnsignedInteger getOutputDimension() const override { return out_; }
  OT::Point operator()(const OT::Point& point) const override {
    OT::Sample one(1, point.getDimension());
    one[0] = point;
    return each_(one)[0];
  }
  OT::Sample operator()(const OT::Sample& points) const override { return each_(points); }

 private:
  OT::UnsignedInteger in_, out_;
  Each each_;
};

class Kriging final : public Search {
 public:
  struct Config {
    std::optional<long> design;
    Trend trend;
    double smoothness;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Kriging of each target and expected improvement of their common distance, with noise");
    s.details(
        "Points that fill the range first, then those that promise to come nearer: each target has a Gaussian process "
        "on a trend, with the scatter of the packings as noise; of the sum of squared distances to what is wanted the "
        "expected improvement is sought.");
    s.source(
        "Jones, Schonlau, Welch (1998), J. Global Optim. 13, 455-492; Uhrenholt, Jensen (2019), PMLR 89, 2661-2670; "
        "computed by OpenTURNS: Baudin et al. (2017), Handbook of Uncertainty Quantification, 2001-2038");
    s.param("design", &Config::design)
        .at_least(1)
        .at_most(10000)
        .doc("points before any model is asked; default: three times the number of parameters, and at least 5");
    s.param("trend", &Config::trend)
        .choice("linear", Trend::linear, "in the scaled parameters: on log scales any power law")
        .choice("constant", Trend::constant, "none: for targets that have a bump in the range")
        .fallback("linear")
        .doc("below the Gaussian process");
    s.param("smoothness", &Config::smoothness)
        .at_least(0.5)
        .at_most(10)
        .fallback(2.5)
        .doc("of the Matern covariance: 0.5 rough, 2.5 twice differentiable");
  }

  explicit Kriging(const Config& config) : config_(config) {
    OT::Log::Show(OT::Log::NONE);      // it would write to the terminal
    OT::TBBImplementation::Disable();  // the processes of the runs have the cores
    // With noise the amplitude has no closed form.
    OT::ResourceMap::SetAsBool("GeneralLinearModelAlgorithm-UseAnalyticalAmplitudeEstimate", false);
  }

  void learn(const SearchTask& task, std::span<const SearchEvaluation> known, Host&) override {
    task_ = task;
    known_.assign(known.begin(), known.end());
    points_ = OT::Sample(0, task.dimension);
    for (const SearchEvaluation& e : known_) points_.add(ot(e.point));
    models_.clear();
    for (std::size_t t = 0; t < task.targets.size(); ++t) {
      OT::Sample points(0, task.dimension);
      OT::Point values, variance;
      for (const SearchEvaluation& e : known_)
        if (std::isfinite(e.value[t])) {
          points.add(ot(e.point));
          values.add(e.value[t]);
          variance.add(e.variance[t]);
        }
      if (values.getSize() < needs()) {
        models_.clear();
        return;
      }
      models_.emplace_back(points, values, variance,
                           kriging::Settings{config_.trend == Trend::linear, config_.smoothness});
    }
  }

  std::size_t needs() const override { return task_.dimension + 2; }

  std::vector<SearchPoint> propose(std::size_t count, Host& host) override {
    const std::size_t design =
        config_.design ? std::size_t(*config_.design) : std::max<std::size_t>(5, 3 * task_.dimension);
    std::vector<SearchPoint> chosen;
    const std::size_t left = models_.empty() ? count : design > known_.size() ? design - known_.size() : 0;
    if (const std::size_t n = std::min(count, left); n > 0) {
      const OT::Sample fresh = kriging::filling(task_.dimension, known_.size(), n, task_.seed);
      for (std::size_t i = 0; i < n; ++i) chosen.push_back(ours(fresh[i]));
    }
    if (chosen.size() == count) return chosen;
    seed(2);
    std::vector<Surrogate> models = models_;
    OT::Sample taken = points_;
    for (const SearchPoint& p : chosen) believe(models, taken, ot(p));
    while (chosen.size() < count) {
      if (host.cancelled()) throw Cancelled();
      const OT::Point next = most_promising(models, taken);
      chosen.push_back(ours(next));
      if (chosen.size() < count) believe(models, taken, next);
    }
    return chosen;
  }

  std::vector<std::vector<SearchPrediction>> predict(std::span<const SearchPoint> points) const override {
    OT::Sample at(0, task_.dimension);
    for (const SearchPoint& p : points) at.add(ot(p));
    std::vector<std::vector<SearchPrediction>> all(points.size(), std::vector<SearchPrediction>(models_.size()));
    if (points.empty()) return all;
    for (std::size_t t = 0; t < models_.size(); ++t) {
      const Predicted p = models_[t](at);
      for (std::size_t i = 0; i < points.size(); ++i) all[i][t] = {p.value[i], p.deviation[i]};
    }
    return all;
  }

  SearchPoint best(Host&) const override {
    seed(3);
    return ours(kriging::best_point(
        [&](const OT::Sample& at) {
          OT::Point scores(at.getSize());
          for (std::size_t t = 0; t < models_.size(); ++t) {
            const Predicted p = models_[t](at);
            for (OT::UnsignedInteger i = 0; i < at.getSize(); ++i)
              scores[i] -= square(distance(t, p.value[i])) + square(p.deviation[i] / task_.targets[t].scatter);
          }
          return scores;
        },
        points_, task_.seed));
  }

  std::vector<SearchPoint> plausible(std::size_t count, Host& host) const override {
    seed(4);
    const auto log_density = [&](const OT::Sample& at) {
      OT::Point logs(at.getSize());
      for (std::size_t t = 0; t < models_.size(); ++t) {
        const Predicted p = models_[t](at);
        for (OT::UnsignedInteger i = 0; i < at.getSize(); ++i) {
          const double variance = square(task_.targets[t].scatter) + square(p.deviation[i]);
          logs[i] -= 0.5 * (square(p.value[i] - task_.targets[t].wanted) / variance + std::log(variance));
        }
      }
      return logs;
    };
    const OT::Sample points = kriging::drawn_from(log_density, task_.dimension, count, task_.seed + 31, [&] {
      if (host.cancelled()) throw Cancelled();
    });
    std::vector<SearchPoint> drawn;
    for (std::size_t i = 0; i < count; ++i) drawn.push_back(ours(points[i]));
    return drawn;
  }

  std::vector<std::vector<SearchSensitivity>> sensitivities(Host&) const override {
    seed(5);
    OT::ComposedDistribution::DistributionCollection sides(task_.dimension, OT::Uniform(0, 1));
    std::vector<std::vector<SearchSensitivity>> all;
    for (const Surrogate& model : models_) {
      const OT::Function value(Called(task_.dimension, 1, [&](const OT::Sample& at) {
        const Predicted p = model(at);
        OT::Sample values(at.getSize(), 1);
        for (OT::UnsignedInteger i = 0; i < at.getSize(); ++i) values(i, 0) = p.value[i];
        return values;
      }));
      std::vector<SearchSensitivity> row(task_.dimension);
      const Predicted values = model(kriging::filling(task_.dimension, 0, 256, task_.seed));
      const auto [low, high] = std::minmax_element(values.value.begin(), values.value.end());
      if (!(*high - *low > 1e-9 * (std::abs(*low) + std::abs(*high)))) {
        // the same everywhere: there is nothing to share
      } else if (task_.dimension == 1) {
        row[0] = {1, 1};
      } else {
        const OT::JansenSensitivityAlgorithm shares(OT::ComposedDistribution(sides), 512, value);
        const OT::Point alone = shares.getFirstOrderIndices(), total = shares.getTotalOrderIndices();
        for (std::size_t k = 0; k < row.size(); ++k) row[k] = {share(alone[k]), share(total[k])};
      }
      all.push_back(std::move(row));
    }
    return all;
  }

 private:
  static double square(double x) { return x * x; }
  /// An estimate may leave the range of what it estimates; a target that is the same everywhere has no shares.
  static double share(double x) { return std::isfinite(x) ? std::clamp(x, 0.0, 1.0) : 0; }
  double distance(std::size_t target, double value) const {
    return (value - task_.targets[target].wanted) / task_.targets[target].scatter;
  }
  /// What is drawn must not depend on what was asked before.
  void seed(OT::UnsignedInteger purpose) const {
    OT::RandomGenerator::SetSeed(OT::UnsignedInteger(task_.seed % 1000000007u) * 64 + known_.size() * 8 + purpose);
  }

  static void believe(std::vector<Surrogate>& models, OT::Sample& taken, const OT::Point& point) {
    for (Surrogate& m : models) m.believe(point);
    taken.add(point);
  }

  /// Where the expected improvement is largest; half as much counts a place whose nearest known neighbour could not be
  /// run, and nothing one that is known.
  OT::Point most_promising(const std::vector<Surrogate>& models, const OT::Sample& taken) const {
    constexpr OT::UnsignedInteger draws = 64;
    const std::size_t targets = models.size();
    const OT::Sample chances = kriging::filling(targets, 0, draws, task_.seed + 17);
    std::vector<double> normal;
    for (OT::UnsignedInteger j = 0; j < draws; ++j)
      for (std::size_t t = 0; t < targets; ++t)
        normal.push_back(OT::DistFunc::qNormal(std::clamp(chances(j, t), 1e-6, 1 - 1e-6)));

    const auto predicted = [&](const OT::Sample& at) {
      std::vector<Predicted> all;
      for (const Surrogate& m : models) all.push_back(m(at));
      return all;
    };
    double least = INFINITY;
    const std::vector<Predicted> here = predicted(taken);
    for (OT::UnsignedInteger i = 0; i < taken.getSize(); ++i) {
      double sum = 0;
      for (std::size_t t = 0; t < targets; ++t) sum += square(distance(t, here[t].value[i]));
      least = std::min(least, sum);
    }
    const auto improvement = [&](const OT::Sample& at) {
      const std::vector<Predicted> p = predicted(at);
      OT::Point scores(at.getSize());
      for (OT::UnsignedInteger i = 0; i < at.getSize(); ++i) {
        double gain = 0, unknown = 0;
        for (OT::UnsignedInteger j = 0; j < draws; ++j) {
          double sum = 0;
          for (std::size_t t = 0; t < targets; ++t)
            sum += square(distance(t, p[t].value[i] + p[t].deviation[i] * normal[j * targets + t]));
          gain += std::max(0.0, least - sum) / double(draws);
        }
        for (std::size_t t = 0; t < targets; ++t) unknown += square(p[t].deviation[i] / task_.targets[t].scatter);
        // Where nothing promises anything, the least known counts.
        scores[i] = (gain + 1e-9 * unknown / (1 + unknown)) * trust(at, i, taken);
      }
      return scores;
    };
    return kriging::best_point(improvement, OT::Sample(0, task_.dimension), task_.seed + known_.size());
  }

  double trust(const OT::Sample& at, OT::UnsignedInteger i, const OT::Sample& taken) const {
    double nearest = INFINITY;
    std::size_t which = 0;
    for (OT::UnsignedInteger k = 0; k < taken.getSize(); ++k) {
      double sum = 0;
      for (OT::UnsignedInteger c = 0; c < task_.dimension; ++c) sum += square(at(i, c) - taken(k, c));
      if (sum < nearest) nearest = sum, which = k;
    }
    if (nearest < square(0.003)) return 0;
    const bool failed = which < known_.size() && std::none_of(known_[which].value.begin(), known_[which].value.end(),
                                                              [](double v) { return std::isfinite(v); });
    return failed ? 0.5 : 1;
  }

  Config config_;
  SearchTask task_;
  std::vector<SearchEvaluation> known_;
  OT::Sample points_;
  std::vector<Surrogate> models_;
};

}  // namespace

BRECCIA_PLUGIN(Kriging, "search", "kriging")
