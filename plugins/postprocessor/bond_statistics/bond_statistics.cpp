// SPDX-License-Identifier: BSD-3-Clause
/// Forces and lengths of the bonds, and their statistics over the run.
/// Strong and weak network: Radjai, Jean, Moreau, Roux (1996), Phys. Rev. Lett. 77, 274-277.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>

#include "breccia/block_sum.hpp"
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
    const auto for_each_size = [&](auto&& f) {
      for (const std::size_t k : view.own_pairs())
        if (view.pairs.state[k] == BondState::intact) f(view.pairs.i[k], normal_force(view, k));
    };
    BlockSum<Eigen::Vector4d> sums(view);  // number, size, in tension, in compression
    double ends[] = {-INFINITY, -INFINITY};
    for_each_size([&](Index i, double normal) {
      const double size = std::abs(normal);
      sums.add(i, {1, size, double(normal > 0), double(normal < 0)});
      ends[0] = std::max(ends[0], -size);
      ends[1] = std::max(ends[1], size);
    });
    const Eigen::Vector4d all = view.sum(sums.exact());
    const double count = all[0];
    if (count == 0) return;
    view.max(ends);
    mean = all[1] / count;
    least = -ends[0];
    most = ends[1];
    tension = std::size_t(all[2]);
    compression = std::size_t(all[3]);
    BlockSum<Eigen::Vector2d> about(view);  // square, of the strong network
    for_each_size([&](Index i, double normal) {
      const double size = std::abs(normal), off = size - mean;
      about.add(i, {off * off, double(size > mean)});
    });
    const Eigen::Vector2d of_all = view.sum(about.exact());
    standard_deviation = std::sqrt(of_all[0] / count);
    strong_share = of_all[1] / count;
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

/// Of d0/(r_i + r_j) - 1 when the bonds were made: gap positive, overlap negative. `made`: in the whole specimen.
Json initial_gaps(const SimulationView& view, std::size_t made) {
  const BondsView& bonds = view.bonds;
  if (made == 0) return Json();
  BlockSum<double> sum(view);
  double ends[] = {-INFINITY, -INFINITY};
  for (const std::size_t b : view.own_bonds()) {
    const double touching = view.particles.radius[bonds.i[b]] + view.particles.radius[bonds.j[b]];
    const double gap = bonds.initial_distance[b] / touching - 1;
    sum.add(bonds.i[b], gap);
    ends[0] = std::max(ends[0], -gap);
    ends[1] = std::max(ends[1], gap);
  }
  view.max(ends);
  return {{"mean", view.sum(sum.exact()) / double(made)}, {"min", -ends[0]}, {"max", ends[1]}};
}

/// Bonds between two materials.
struct Between {
  std::size_t low, high;  ///< numbers of the materials
  std::size_t made = 0, intact = 0;
  ExactSum force = {};  // sizes, of the intact ones [N]
};

/// For each two materials that have bonds, in their order.
std::vector<Between> by_materials_of(const SimulationView& view) {
  const auto& of = view.particles.material;
  std::map<std::pair<std::size_t, std::size_t>, Between> found;
  const auto at = [&](std::size_t p, std::size_t q) -> Between& {
    const auto [low, high] = std::minmax(p, q);
    return found.try_emplace({low, high}, Between{low, high}).first->second;
  };
  if (!of.empty())
    for (const std::size_t b : view.own_bonds()) {
      Between& one = at(of[view.bonds.i[b]], of[view.bonds.j[b]]);
      ++one.made;
      if (view.bonds.state[b] != BondState::intact || view.bonds.pair[b] == BondsView::no_pair) continue;
      const PairForce& f = view.pairs.force[view.bonds.pair[b]];
      one.force.add(std::sqrt(f.fx * f.fx + f.fy * f.fy + f.fz * f.fz));
      ++one.intact;
    }
  const auto list = [&] {
    std::vector<Between> all;
    for (const auto& [materials, one] : found) all.push_back(one);
    return all;
  };
  const std::vector<Between> of_parts = view.all(list());
  found.clear();
  for (const Between& one : of_parts) {
    Between& sum = at(one.low, one.high);
    sum.made += one.made;
    sum.intact += one.intact;
    sum.force.add(one.force);
  }
  return list();
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
  bool sees_parts() const override { return true; }

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
    ExactSumOf<std::size_t> here;
    here.add(view.own_bonds().size());
    const std::size_t made = view.sum(here);
    summary.own("bonds_made", made);
    summary.own("initial_gap_ratio", initial_gaps(view, made));
    const Statistics last(view);
    for (const Quantity& q : quantities) summary.own({std::string("at_last.") + q.key, q.unit}, q.value(last));
    for (const Between& one : by_materials_of(view)) {
      const std::string section = "by_materials." + view.materials[one.low] + "-" + view.materials[one.high] + ".";
      summary.own(section + "bonds_made", one.made);
      summary.own(section + "intact", one.intact);
      summary.own({section + "mean_force", "N"}, one.intact ? Json(one.force.value() / double(one.intact)) : Json());
    }

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
