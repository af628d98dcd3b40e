// SPDX-License-Identifier: BSD-3-Clause
/// Forces and lengths of the bonds, and their statistics over the run.
/// Strong and weak network: Radjai, Jean, Moreau, Roux (1996), Phys. Rev. Lett. 77, 274-277.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "breccia/postprocessor.hpp"

namespace breccia {
namespace {

/// Tension positive [N].
double normal_force(const SimulationView& view, std::size_t pair) {
  const auto& x = view.particles.position;
  const Vec3 n = view.branch(x[view.pairs.i[pair]], x[view.pairs.j[pair]]).normalized();
  const PairForce& f = view.pairs.force[pair];
  return Vec3(f.fx, f.fy, f.fz).dot(n);  // on i, toward j
}

/// Of the sizes of the normal forces of intact bonds.
struct Statistics {
  double mean = 0, standard_deviation = 0, least = 0, most = 0, strong_share = 0;
  std::size_t tension = 0, compression = 0;

  explicit Statistics(const SimulationView& view) {
    std::vector<double> size;
    for (std::size_t k = 0; k < view.pairs.size(); ++k) {
      if (view.pairs.state[k] != BondState::intact) continue;
      const double normal = normal_force(view, k);
      tension += normal > 0;
      compression += normal < 0;
      size.push_back(std::abs(normal));
    }
    if (size.empty()) return;
    const double count = double(size.size());
    least = size[0];
    for (const double s : size) {
      mean += s / count;
      least = std::min(least, s);
      most = std::max(most, s);
    }
    double square = 0, strong = 0;
    for (const double s : size) {
      square += (s - mean) * (s - mean);
      strong += s > mean;
    }
    standard_deviation = std::sqrt(square / count);
    strong_share = strong / count;
  }
};

struct Quantity {
  const char *name, *unit, *key, *doc;
  double (*value)(const Statistics&);
};

constexpr Quantity quantities[] = {
    {"bond_force_mean", "N", "mean_normal_force", "mean size of the normal force of intact bonds",
     [](const Statistics& s) { return s.mean; }},
    {"bond_force_std", "N", "std_normal_force", "its standard deviation",
     [](const Statistics& s) { return s.standard_deviation; }},
    {"bond_force_min", "N", "min_normal_force", "its least value", [](const Statistics& s) { return s.least; }},
    {"bond_force_max", "N", "max_normal_force", "its largest value", [](const Statistics& s) { return s.most; }},
    {"strong_network_share", "1", "strong_network_share", "share of intact bonds that carry more than the mean",
     [](const Statistics& s) { return s.strong_share; }},
    {"bonds_in_tension", "1", "bonds_in_tension", "number of intact bonds in tension",
     [](const Statistics& s) { return double(s.tension); }},
    {"bonds_in_compression", "1", "bonds_in_compression", "number of intact bonds in compression",
     [](const Statistics& s) { return double(s.compression); }},
};

bool has_column(const Curves& curves, const std::string& name) {
  const auto& all = curves.columns();
  return std::any_of(all.begin(), all.end(), [&](const Column& c) { return c.name == name; });
}

/// Of d0/(r_i + r_j) - 1 when the bonds were made: gap positive, overlap negative.
Json initial_gaps(const SimulationView& view) {
  const BondsView& bonds = view.bonds;
  if (bonds.size() == 0) return Json();
  double mean = 0, least = INFINITY, most = -INFINITY;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const double touching = view.particles.radius[bonds.i[b]] + view.particles.radius[bonds.j[b]];
    const double gap = bonds.initial_distance[b] / touching - 1;
    mean += gap / double(bonds.size());
    least = std::min(least, gap);
    most = std::max(most, gap);
  }
  return {{"mean", mean}, {"min", least}, {"max", most}};
}

}  // namespace

class BondStatistics final : public Postprocessor {
 public:
  struct Config {
    std::optional<std::string> peak_of;
  };
  static void describe(Schema<Config>& s) {
    s.summary("Forces and lengths of the bonds, their statistics, strong and weak network")
        .source("strong network: Radjai et al. (1996), Phys. Rev. Lett. 77, 274-277")
        .details(
            "Statistics are of the size of the normal force of the bonds that hold. The strong network is what carries "
            "more than the mean. Gaps are d0/(r_i + r_j) - 1 when the bonds were made.");
    s.param("peak_of", &Config::peak_of)
        .example("axial_stress")
        .doc(
            "curve whose largest value says when the summary's statistics at the peak are taken; when left out, "
            "axial_stress if there is such a curve");
  }

  explicit BondStatistics(const Config& config) : config_(config) {}

  std::vector<std::string> needed_curves() const override {
    return config_.peak_of ? std::vector<std::string>{*config_.peak_of} : std::vector<std::string>{};
  }

  void begin(const SimulationView&, Recorder& recorder, Host&) override {
    for (std::size_t k = 0; k < std::size(quantities); ++k)
      column_[k] = recorder.add({quantities[k].name, quantities[k].unit, quantities[k].doc});
  }

  void sample(const SimulationView& view, Recorder& recorder) override {
    const Statistics now(view);
    for (std::size_t k = 0; k < std::size(quantities); ++k) recorder.set(column_[k], quantities[k].value(now));
  }

  void fields(const SimulationView& view, std::vector<Field>& fields) override {
    const BondsView& bonds = view.bonds;
    Field length{Field::On::bonds, "length_change", "m", 1, {}};
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      const auto& x = view.particles.position;
      length.values.push_back(view.branch(x[bonds.i[b]], x[bonds.j[b]]).norm() - bonds.initial_distance[b]);
    }
    fields.push_back(std::move(length));
  }

  void finish(const SimulationView& view, const Curves& curves, Summary& summary) override {
    summary.own("bonds_made", view.bonds.size());
    summary.own("initial_gap_ratio", initial_gaps(view));
    const Statistics last(view);
    for (const Quantity& q : quantities) summary.own({std::string("at_last.") + q.key, q.unit}, q.value(last));

    for_each_pair_of_materials(view, [&](const std::string& name, const std::vector<std::size_t>& rows) {
      std::size_t intact = 0;
      double sum = 0;
      for (const std::size_t b : rows) {
        if (view.bonds.state[b] != BondState::intact || view.bonds.pair[b] == BondsView::no_pair) continue;
        const PairForce& f = view.pairs.force[view.bonds.pair[b]];
        sum += std::sqrt(f.fx * f.fx + f.fy * f.fy + f.fz * f.fz);
        ++intact;
      }
      const std::string section = "by_materials." + name + ".";
      summary.own(section + "bonds_made", rows.size());
      summary.own(section + "intact", intact);
      summary.own({section + "mean_force", "N"}, intact ? Json(sum / double(intact)) : Json());
    });

    const std::string peak_of = config_.peak_of.value_or("axial_stress");
    if (curves.rows() == 0 || (!config_.peak_of && !has_column(curves, peak_of))) return;
    const auto stress = curves.column(peak_of);
    const auto row = std::size_t(std::max_element(stress.begin(), stress.end()) - stress.begin());
    summary.own("at_peak.peak_of", peak_of);
    for (const Quantity& q : quantities)
      summary.own({std::string("at_peak.") + q.key, q.unit}, curves.column(q.name)[row]);
  }
  bool archive(Archive&) override { return true; }

 private:
  Config config_;
  std::size_t column_[std::size(quantities)] = {};
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::BondStatistics, "postprocessor", "bond_statistics")
