// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "breccia/search.hpp"
#include "check/attempt.hpp"
#include "check/check.hpp"
#include "check/example.hpp"

namespace breccia {
namespace {

/// Values that are known everywhere.
struct Known {
  const char* name;
  std::size_t dimension;
  std::vector<std::function<double(const SearchPoint&)>> targets;
  SearchPoint solution;  ///< where all targets are met
};

/// Two that depend on both parameters; and two of which one parameter is no part.
std::vector<Known> cases() {
  return {{"two parameters",
           2,
           {[](const SearchPoint& p) { return p[0] + 0.3 * p[1] * p[1]; },
            [](const SearchPoint& p) { return p[1] - 0.5 * p[0]; }},
           {0.4, 0.7}},
          {"one of no effect",
           3,
           {[](const SearchPoint& p) { return std::exp(p[0]) + 0.5 * p[1]; },
            [](const SearchPoint& p) { return p[1] - 0.2 * p[0]; }},
           {0.3, 0.6, 0.5}}};
}

constexpr double scatter = 0.02;  // of what is wanted, where values span about one

SearchTask task_of(const Known& k) {
  SearchTask task{k.dimension, {}, 7};
  for (const auto& f : k.targets) task.targets.push_back({f(k.solution), scatter});
  return task;
}

SearchEvaluation measured(const Known& k, const SearchPoint& p) {
  SearchEvaluation e{p, {}, {}};
  for (const auto& f : k.targets) {
    e.value.push_back(f(p));
    e.variance.push_back(1e-6);
  }
  return e;
}

class SearchCheck {
 public:
  SearchCheck(const Registry& registry, PluginChoice choice, const Host& user)
      : registry_(registry), choice_(std::move(choice)), trials_(user) {}

  CheckFindings operator()() {
    for (const Known& k : cases()) {
      const Attempt end = attempt([&] { one(k); });
      if (end.end == Attempt::End::cancelled) throw Cancelled();
      if (!end) trials_.see("answers", k.name, false, end.text, "an ordinary task must be answered");
    }
    return trials_.findings();
  }

 private:
  std::unique_ptr<Search> made() const { return registry_.create<Search>(choice_); }

  void one(const Known& k) {
    const SearchTask task = task_of(k);
    const std::unique_ptr<Search> search = made();
    std::vector<SearchEvaluation> known;
    const std::size_t enough = 12 * k.dimension;
    std::string outside, repeated;
    while (known.size() < enough) {
      search->learn(task, known, host_);
      const auto points = search->propose(3, host_);
      if (points.size() != 3) outside = fmt::format("{} points instead of 3", points.size());
      for (const SearchPoint& p : points) {
        if (!in_cube(p, k.dimension)) outside = fmt::format("a point of {} numbers, not all from 0 to 1", p.size());
        for (const SearchEvaluation& e : known)
          if (e.point == p) repeated = "a point that is known is proposed";
      }
      trials_.see("points in the cube", k.name, outside.empty(), outside.empty() ? "all of them" : outside,
                  "propose as many points as are asked for, each with one number from 0 to 1 for each parameter");
      trials_.see("new points", k.name, repeated.empty(), repeated.empty() ? "none twice" : repeated,
                  "what is known need not be run again");
      if (!outside.empty()) return;
      for (const SearchPoint& p : points) known.push_back(measured(k, p));
    }
    search->learn(task, known, host_);
    answers(k, task, known, *search);
    same(k, task, known, *search);
    gaps(k, task, known);
  }

  void answers(const Known& k, const SearchTask& task, const std::vector<SearchEvaluation>& known, Search& search) {
    if (known.size() < search.needs())
      return trials_.skip("finds what is wanted", k.name, fmt::format("it needs {} evaluations", search.needs()));
    const SearchPoint best = search.best(host_);
    double off = 0;
    if (in_cube(best, k.dimension))
      for (std::size_t t = 0; t < k.targets.size(); ++t)
        off = std::max(off, std::abs(k.targets[t](best) - task.targets[t].wanted) / scatter);
    else off = INFINITY;
    trials_.see("finds what is wanted", k.name, off < 2, fmt::format("{:.2g} times the scatter away", off),
                "with values that are smooth the best point must come within their scatter", off);

    const SearchPoint middle(k.dimension, 0.45);
    const auto predicted = search.predict(std::vector<SearchPoint>{middle, best});
    double worst = 0;
    bool whole = predicted.size() == 2;
    for (std::size_t t = 0; whole && t < k.targets.size(); ++t) {
      whole = predicted[0].size() == k.targets.size() && predicted[0][t].deviation >= 0;
      if (whole)
        worst = std::max(
            worst, std::abs(predicted[0][t].value - k.targets[t](middle)) / (3 * predicted[0][t].deviation + scatter));
    }
    trials_.see("says how sure it is", k.name, whole && worst < 1,
                whole ? fmt::format("off by {:.2g} times what it says", worst) : "not one prediction for each target",
                "of each target a value, and a deviation within thrice which the truth lies", worst);

    const auto drawn = search.plausible(200, host_);
    double mean_off = 0;
    bool inside = drawn.size() == 200;
    for (const SearchPoint& p : drawn) inside = inside && in_cube(p, k.dimension);
    if (inside)
      for (std::size_t c = 0; c < 2; ++c) {
        double mean = 0;
        for (const SearchPoint& p : drawn) mean += p[c] / double(drawn.size());
        mean_off = std::max(mean_off, std::abs(mean - k.solution[c]));
      }
    trials_.see("points that agree", k.name, inside && mean_off < 0.1,
                inside ? fmt::format("on average {:.2g} off", mean_off) : "too few, or outside the cube",
                "points by how well they agree with what is wanted, hence around the solution", mean_off);

    const auto shares = search.sensitivities(host_);
    bool in_order = shares.size() == k.targets.size();
    double idle = 0;
    for (const auto& row : shares) {
      in_order = in_order && row.size() == k.dimension;
      for (const SearchSensitivity& s : row) in_order = in_order && s.alone >= 0 && s.total <= 1;
      if (in_order && k.dimension == 3) idle = std::max(idle, row[2].total);
    }
    trials_.see(
        "sensitivities", k.name, in_order && idle < 0.1,
        in_order ? fmt::format("{:.2g} for what has no effect", idle) : "not one pair for each parameter and target",
        "shares of variance from 0 to 1; near 0 for a parameter on which nothing depends", idle);
  }

  /// Everything that it was told once more, after something else.
  void same(const Known& k, const SearchTask& task, const std::vector<SearchEvaluation>& known, Search& first) {
    const std::unique_ptr<Search> again = made();
    again->learn(task, std::span(known).first(known.size() / 2), host_);
    again->propose(1, host_);
    again->learn(task, known, host_);
    const bool same = again->best(host_) == first.best(host_) && again->propose(2, host_) == first.propose(2, host_) &&
                      again->plausible(20, host_) == first.plausible(20, host_);
    trials_.see(
        "the same when told again", k.name, same, same ? "the same bits" : "other points",
        "answers depend on what `learn` was told last alone; draw from a generator that is seeded anew each time");
  }

  void gaps(const Known& k, const SearchTask& task, std::vector<SearchEvaluation> known) {
    for (std::size_t i = 0; i < known.size(); i += 4) known[i].value.assign(k.targets.size(), NAN);
    known[1].value[0] = NAN;
    const std::unique_ptr<Search> search = made();
    search->learn(task, known, host_);
    bool fine = in_cube(search->best(host_), k.dimension);
    for (const SearchPoint& p : search->propose(2, host_)) fine = fine && in_cube(p, k.dimension);
    trials_.see("values that are missing", k.name, fine, fine ? "are left out" : "it proposes points outside the cube",
                "NaN is a target that could not be measured: leave it out, the other targets of the point count");
  }

  static bool in_cube(const SearchPoint& p, std::size_t dimension) {
    return p.size() == dimension && std::all_of(p.begin(), p.end(), [](double x) { return x >= 0 && x <= 1; });
  }

  const Registry& registry_;
  PluginChoice choice_;
  Trials trials_;
  SilentHost host_;
};

}  // namespace

CheckFindings check_search(const Registry& registry, const std::string& name,
                           const std::vector<std::string>& parameters, const Host& user) {
  return SearchCheck(registry, example_plugin(registry, Search::kind, name, parameters), user)();
}

}  // namespace breccia
