// SPDX-License-Identifier: BSD-3-Clause
/// Sizes and directions of particles and bonds. Source: Rojek et al. (2012), Figs. 5-10, Tables A.1 and A.2.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "breccia/postprocessor.hpp"
#include "distribution.hpp"
#include "rose.hpp"

namespace breccia {
namespace {

double arithmetic(double a, double b) { return 0.5 * (a + b); }
double harmonic(double a, double b) { return 2 * a * b / (a + b); }
double least(double a, double b) { return std::min(a, b); }
double squared(double a) { return a * a; }

struct Quantity {
  const char *name, *unit, *doc;
  double (*value)(double, double);  ///< of the radii of a bond's particles; of one particle: its radius twice
};

constexpr Quantity of_particles[] = {
    {"particle_radius", "m", "particle radius r", [](double r, double) { return r; }},
    {"particle_radius_squared", "m2", "r^2", [](double r, double) { return squared(r); }},
};

constexpr Quantity of_bonds[] = {
    {"pair_arithmetic_mean_radius", "m", "(r_i + r_j)/2 of a bond", arithmetic},
    {"pair_arithmetic_mean_radius_squared", "m2", "((r_i + r_j)/2)^2",
     [](double a, double b) { return squared(arithmetic(a, b)); }},
    {"pair_harmonic_mean_radius", "m", "2 r_i r_j/(r_i + r_j) of a bond", harmonic},
    {"pair_harmonic_mean_radius_squared", "m2", "(2 r_i r_j/(r_i + r_j))^2",
     [](double a, double b) { return squared(harmonic(a, b)); }},
    {"pair_minimum_radius", "m", "min(r_i, r_j) of a bond", least},
    {"pair_minimum_radius_squared", "m2", "min(r_i, r_j)^2", [](double a, double b) { return squared(least(a, b)); }},
};

struct Plane {
  const char* name;
  int u, v, normal;
};
constexpr Plane planes[] = {{"xy", 0, 1, 2}, {"yz", 1, 2, 0}, {"zx", 2, 0, 1}};

void report(const Moments& m, const std::string& section, const std::string& unit, Summary& summary) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
  summary.own(section + "count", m.count);
  summary.own({section + "mean", unit}, m.mean);
  summary.own({section + "median", unit}, m.median);
  summary.own({section + "std", unit}, number(m.standard_deviation));
  summary.own(section + "skewness", number(m.skewness));
  summary.own(section + "kurtosis", number(m.kurtosis));
  summary.own({section + "min", unit}, m.min);
  summary.own({section + "max", unit}, m.max);
}

/// Counts between edges, and their shares of all that was counted.
Table table(std::string name, const std::string& what, const std::string& unit, const std::vector<double>& edges,
            const std::vector<std::size_t>& counts) {
  const std::string prefix = unit == "rad" ? "angle_" : "";
  double all = 0;
  for (const std::size_t c : counts) all += double(c);
  Table t{std::move(name),
          {{prefix + "from", unit, "lower edge: " + what},
           {prefix + "to", unit, "upper edge"},
           {"count", "1", "how many lie between"},
           {"fraction", "1", "count over the sum of all counts"}},
          std::vector<std::vector<double>>(4)};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double row[] = {edges[k], edges[k + 1], double(counts[k]), double(counts[k]) / all};
    for (std::size_t c = 0; c < 4; ++c) t.values[c].push_back(row[c]);
  }
  return t;
}

}  // namespace

class Statistics final : public Postprocessor {
 public:
  struct Config {
    int bins, sectors;
    std::optional<double> largest_tilt;
  };
  static void describe(Schema<Config>& s) {
    s.summary("Distributions of the radii of particles and bonded pairs, and roses of the directions of bonds")
        .source("Rojek et al. (2012), Figs. 5-10, Tables A.1 and A.2; moments: Joanes and Gill (1998)")
        .details(
            "Of all particles and of all bonds made, at the start of loading. The summary has count, mean, median, "
            "standard deviation s (divisor n - 1), skewness m3/s^3, kurtosis m4/s^4 - 3 (m_k: central moments, divisor "
            "n; 0 of the normal distribution), least and largest value of each quantity. Tables: "
            "`histogram_<quantity>`, and `rose_xy`, `rose_yz`, `rose_zx` of the directions projected on that plane; in "
            "two dimensions `rose_xy` only. An isotropic assembly has the same fraction in each sector.");
    s.param("bins", &Config::bins)
        .at_least(1)
        .at_most(10000)
        .fallback(30)
        .doc("number of bins of a histogram, between the least and the largest value");
    s.param("sectors", &Config::sectors)
        .at_least(2)
        .at_most(3600)
        .fallback(36)
        .doc("number of sectors of a rose; even, because a bond counts in both of its senses");
    s.param("largest_tilt", &Config::largest_tilt)
        .unit("rad")
        .above(0)
        .at_most(M_PI / 2)
        .example("30 deg")
        .doc(
            "largest angle between a bond and the plane of a rose at which the bond counts there; when left out, all "
            "bonds count, with the same weight");
    s.check([](const Config& c, Issues& issues) {
      if (c.sectors % 2) issues.push_back({"sectors", "must be even: a bond counts in two opposite sectors"});
    });
  }

  explicit Statistics(const Config& config) : config_(config) {}
  bool sees_parts() const override { return true; }

  void finish(const SimulationView& view, const Curves&, Summary& summary) override {
    ExactSumOf<std::size_t> particles, bonds;
    particles.add(view.own_particles().size());
    bonds.add(view.own_bonds().size());
    const auto [of_all, made] = view.sum(particles, bonds);
    for (const Quantity& q : of_particles) {
      std::vector<double> values;
      for (const std::size_t k : view.own_particles())
        values.push_back(q.value(view.particles.radius[k], view.particles.radius[k]));
      report(q, of_all, std::move(values), view, summary);
    }
    for (const Quantity& q : of_bonds) {
      std::vector<double> values;
      for (const std::size_t b : view.own_bonds())
        values.push_back(q.value(view.particles.radius[view.bonds.i[b]], view.particles.radius[view.bonds.j[b]]));
      report(q, made, std::move(values), view, summary);
    }
    report_materials(view, summary);
    for (const Plane& p : planes) {
      report(p, made, view, summary);
      if (view.dimension == 2) break;
    }
  }
  bool archive(Archive&) override { return true; }

 private:
  /// What was asked of shares is in the workflow; this is what became of it.
  static void report_materials(const SimulationView& view, Summary& summary) {
    const ParticlesView& p = view.particles;
    if (p.material.empty()) return;
    const std::size_t n = view.materials.size();
    std::vector<ExactSum> sums(4 * n);  // of each: particles, volume, mass, radius
    for (const std::size_t k : view.own_particles()) {
      ExactSum* const s = &sums[4 * p.material[k]];
      s[0].add(1);
      s[1].add(view.solid_volume(p.radius[k]));
      s[2].add(p.mass[k]);
      s[3].add(p.radius[k]);
    }
    const std::vector<double> of = view.sums(sums);
    double all = 0;
    for (std::size_t m = 0; m < n; ++m) all += of[4 * m + 1];
    for (std::size_t m = 0; m < n; ++m) {
      const std::string section = "materials." + view.materials[m] + ".";
      const double count = of[4 * m];
      summary.own(section + "particles", std::size_t(count));
      summary.own(section + "volume_share", of[4 * m + 1] / all);
      summary.own({section + "mass", "kg"}, of[4 * m + 2]);
      summary.own({section + "mean_radius", "m"}, count > 0 ? Json(of[4 * m + 3] / count) : Json());
    }
  }

  /// `count`: of the values of all parts.
  void report(const Quantity& q, std::size_t count, std::vector<double> values, const SimulationView& view,
              Summary& summary) const {
    if (count == 0) return summary.own(q.name, Json());
    std::sort(values.begin(), values.end());
    breccia::report(moments(view, values), std::string(q.name) + ".", q.unit, summary);
    const Histogram h = histogram(view, values, std::size_t(config_.bins));
    summary.table(table(std::string("histogram_") + q.name, q.doc, q.unit, h.edges, h.counts));
  }

  void report(const Plane& plane, std::size_t made, const SimulationView& view, Summary& summary) const {
    Rose rose(std::size_t(config_.sectors), config_.largest_tilt.value_or(M_PI / 2));
    for (const std::size_t b : view.own_bonds()) {
      const Vec3 branch = view.initial_branch(view.bonds.i[b], view.bonds.j[b]);
      rose.add(branch[plane.u], branch[plane.v], branch[plane.normal]);
    }
    rose.meet(view);
    const std::string name = std::string("rose_") + plane.name;
    summary.own(name, Json{{"bonds", rose.lines()}, {"bonds_left_out", made - rose.lines()}});
    if (rose.lines() == 0) return;
    std::vector<double> edges;
    for (std::size_t k = 0; k <= rose.counts().size(); ++k) edges.push_back(rose.angle(k));
    const std::string from = "angle from " + std::string(1, plane.name[0]) + " toward " + plane.name[1];
    summary.table(table(name, from, "rad", edges, rose.counts()));
  }

  Config config_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Statistics, "postprocessor", "statistics")
