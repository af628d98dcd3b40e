// SPDX-License-Identifier: BSD-3-Clause
/// A search for calibrations: of each target a polynomial of second degree without products, fitted to all that is
/// known; points at random first, then ever nearer to where it says the targets are met. Sources: name what the method
/// follows here; README.md says more.
#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "breccia/search.hpp"

class NewPluginName final : public breccia::Search {
 public:
  /// What the calibration says, in SI units and within its range when it comes here.
  struct Config {
    double first_step;
  };

  /// One declaration for each parameter: messages, `breccia describe` and the editor's help are made from it.
  static void describe(breccia::Schema<Config>& s) {
    s.summary("Polynomials of second degree, and points ever nearer to the best")
        .source("say what the method follows")
        .details("Of each target a polynomial without products of parameters.");
    s.param("first_step", &Config::first_step)
        .above(0)
        .at_most(1)
        .fallback(0.3)
        .doc("deviation of the first points around the best, as a share of each range");
  }

  explicit NewPluginName(const Config& config) : config_(config) {}

  /// Everything anew: the program may have been killed since it asked last.
  void learn(const breccia::SearchTask& task, std::span<const breccia::SearchEvaluation> known,
             breccia::Host&) override {
    task_ = task;
    known_.assign(known.begin(), known.end());
    surfaces_.clear();
    for (std::size_t t = 0; t < task.targets.size(); ++t) {
      std::vector<const breccia::SearchEvaluation*> rows;
      for (const auto& e : known_)
        if (std::isfinite(e.value[t])) rows.push_back(&e);  // NaN: it could not be measured there
      if (rows.size() < needs()) {
        surfaces_.clear();
        return;
      }
      surfaces_.push_back(fit(rows, t));
    }
  }

  std::vector<breccia::SearchPoint> propose(std::size_t count, breccia::Host& host) override {
    std::mt19937_64 random(task_.seed + 1000 * known_.size());  // the same points for the same knowledge
    std::vector<breccia::SearchPoint> points;
    const bool blind = surfaces_.empty();
    const breccia::SearchPoint centre = blind ? breccia::SearchPoint() : best(host);
    const double step = config_.first_step / (1.0 + double(known_.size()) / double(4 * task_.dimension));
    for (std::size_t i = 0; i < count; ++i) {
      breccia::SearchPoint p(task_.dimension);
      for (std::size_t k = 0; k < p.size(); ++k)
        p[k] = blind ? uniform(random) : std::clamp(centre[k] + step * (2 * uniform(random) - 1), 0.0, 1.0);
      points.push_back(std::move(p));
    }
    return points;
  }

  std::size_t needs() const override { return 2 * task_.dimension + 2; }

  std::vector<std::vector<breccia::SearchPrediction>> predict(
      std::span<const breccia::SearchPoint> points) const override {
    std::vector<std::vector<breccia::SearchPrediction>> all;
    for (const auto& p : points) {
      std::vector<breccia::SearchPrediction> row;
      for (const Surface& s : surfaces_) {
        const Eigen::VectorXd x = terms(p);
        row.push_back({s.factors.dot(x), std::sqrt(s.variance * (0.1 + x.dot(s.spread * x)))});
      }
      all.push_back(std::move(row));
    }
    return all;
  }

  breccia::SearchPoint best(breccia::Host&) const override { return around_best(1)[0]; }

  std::vector<breccia::SearchPoint> plausible(std::size_t count, breccia::Host&) const override {
    return around_best(count);
  }

  /// Terms of different parameters do not mix: what one has by itself is all that it has.
  std::vector<std::vector<breccia::SearchSensitivity>> sensitivities(breccia::Host&) const override {
    std::vector<std::vector<breccia::SearchSensitivity>> all;
    for (const Surface& s : surfaces_) {
      std::vector<double> variance(task_.dimension);
      double sum = 0;
      for (std::size_t k = 0; k < task_.dimension; ++k) {
        const double a = s.factors[long(1 + 2 * k)], b = s.factors[long(2 + 2 * k)];
        variance[k] = a * a / 12 + a * b / 6 + 4 * b * b / 45;  // of a x + b x^2 over 0 to 1
        sum += variance[k];
      }
      std::vector<breccia::SearchSensitivity> row;
      for (const double v : variance) row.push_back({sum > 0 ? v / sum : 0, sum > 0 ? v / sum : 0});
      all.push_back(std::move(row));
    }
    return all;
  }

 private:
  struct Surface {
    Eigen::VectorXd factors;
    Eigen::MatrixXd spread;
    double variance;
  };

  static double uniform(std::mt19937_64& random) { return double(random() >> 11) * 0x1p-53; }

  Eigen::VectorXd terms(const breccia::SearchPoint& p) const {
    Eigen::VectorXd x(long(1 + 2 * p.size()));
    x[0] = 1;
    for (std::size_t k = 0; k < p.size(); ++k) {
      x[long(1 + 2 * k)] = p[k];
      x[long(2 + 2 * k)] = p[k] * p[k];
    }
    return x;
  }

  Surface fit(const std::vector<const breccia::SearchEvaluation*>& rows, std::size_t target) const {
    const long n = long(rows.size()), m = long(1 + 2 * task_.dimension);
    Eigen::MatrixXd a(n, m);
    Eigen::VectorXd y(n);
    double noise = 1e-12;
    for (long i = 0; i < n; ++i) {
      a.row(i) = terms(rows[std::size_t(i)]->point);
      y[i] = rows[std::size_t(i)]->value[target];
      noise += rows[std::size_t(i)]->variance[target] / double(n);
    }
    const Eigen::MatrixXd normal = a.transpose() * a + 1e-9 * Eigen::MatrixXd::Identity(m, m);
    const Eigen::VectorXd factors = normal.ldlt().solve(a.transpose() * y);
    const double left = (y - a * factors).squaredNorm() / double(std::max(1L, n - m));
    return {factors, normal.inverse(), std::max(left, noise)};
  }

  /// Half the squared distance from what is wanted, in units of its scatter and the model's error.
  double misfit(const breccia::SearchPoint& p) const {
    const auto row = predict(std::span(&p, 1))[0];
    double sum = 0;
    for (std::size_t t = 0; t < row.size(); ++t) {
      const auto& wanted = task_.targets[t];
      const double off = row[t].value - wanted.wanted;
      sum += 0.5 * off * off / (wanted.scatter * wanted.scatter + row[t].deviation * row[t].deviation);
    }
    return sum;
  }

  /// The end of a random walk that goes to the best, or points of one that stays around it.
  std::vector<breccia::SearchPoint> around_best(std::size_t count) const {
    std::mt19937_64 random(task_.seed + 77);
    breccia::SearchPoint here(task_.dimension, 0.5);
    double now = misfit(here), step = 0.3;
    const auto move = [&](bool only_down) {
      breccia::SearchPoint next = here;
      for (double& x : next) x += step * (2 * uniform(random) - 1);
      for (const double x : next)
        if (x < 0 || x > 1) return;
      const double then = misfit(next);
      if (then > now && (only_down || uniform(random) > std::exp(now - then))) return;
      here = next;
      now = then;
    };
    for (int i = 0; i < 4000; ++i) {
      step = 0.3 * std::exp(-double(i) / 600);
      move(true);
    }
    std::vector<breccia::SearchPoint> points{here};
    step = 0.05;
    while (points.size() < count) {
      for (int i = 0; i < 20; ++i) move(false);
      points.push_back(here);
    }
    return points;
  }

  Config config_;
  breccia::SearchTask task_;
  std::vector<breccia::SearchEvaluation> known_;
  std::vector<Surface> surfaces_;
};

BRECCIA_PLUGIN(NewPluginName, "search", "new_plugin_name")
