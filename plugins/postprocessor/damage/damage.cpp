// SPDX-License-Identifier: BSD-3-Clause
/// Broken bonds, damage of each particle, and the fragments they leave.
/// Source: Rojek et al. (2012), Int. J. Solids Struct. 49, 1497-1517, Eq. 60 and section 5.3.
#include <map>
#include <optional>

#include "breccia/postprocessor.hpp"
#include "fragments.hpp"

namespace breccia {
namespace {

struct Broken {
  std::size_t made = 0, all = 0, tension = 0, shear = 0;

  Broken() = default;
  explicit Broken(const SimulationView& view) {
    Broken here;
    for (const std::size_t b : view.own_bonds()) here.count(view.bonds.state[b]);
    ExactSumOf<Eigen::Vector4d> sum;
    sum.add({double(here.made), double(here.all), double(here.tension), double(here.shear)});
    const Eigen::Vector4d of_all = view.sum(sum);
    made = std::size_t(of_all[0]);
    all = std::size_t(of_all[1]);
    tension = std::size_t(of_all[2]);
    shear = std::size_t(of_all[3]);
  }
  void count(BondState s) {
    ++made;
    all += is_broken(s);
    tension += s == BondState::broken_tension;
    shear += s == BondState::broken_shear;
  }
  /// Equals the mean of the particles' damage, each weighted with its initial bonds.
  double damage() const { return made > 0 ? double(all) / double(made) : 0.0; }
};

/// Of bonds between two materials.
struct BrokenBetween {
  std::size_t low, high;  ///< numbers of the materials
  Broken broken;
};

/// For each two materials that have bonds, in their order.
std::vector<BrokenBetween> by_materials_of(const SimulationView& view) {
  const auto& of = view.particles.material;
  std::map<std::pair<std::size_t, std::size_t>, Broken> here;
  if (!of.empty())
    for (const std::size_t b : view.own_bonds()) {
      const std::size_t p = of[view.bonds.i[b]], q = of[view.bonds.j[b]];
      here[std::minmax(p, q)].count(view.bonds.state[b]);
    }
  std::vector<BrokenBetween> own;
  for (const auto& [pair, broken] : here) own.push_back({pair.first, pair.second, broken});
  here.clear();
  for (const BrokenBetween& one : view.all(own)) {
    Broken& sum = here[{one.low, one.high}];
    sum.made += one.broken.made;
    sum.all += one.broken.all;
    sum.tension += one.broken.tension;
    sum.shear += one.broken.shear;
  }
  own.clear();
  for (const auto& [pair, broken] : here) own.push_back({pair.first, pair.second, broken});
  return own;
}

}  // namespace

class Damage final : public Postprocessor {
 public:
  struct Config {};
  static void describe(Schema<Config>& s) {
    s.summary("Broken bonds by mode, damage of each particle, fragments")
        .source("Rojek et al. (2012), Eq. 60 and section 5.3")
        .details(
            "Damage of a particle D = 1 - b_t/b_0, from its bonds that hold now and those made at the start; 0 for a "
            "particle that had none. Fragments are what intact bonds hold together, numbered from the heaviest. Of "
            "several materials the "
            "summary counts bonds made and broken for each two of them.");
  }

  explicit Damage(const Config&) {}
  bool sees_parts() const override { return true; }

  void begin(const SimulationView&, Recorder& recorder, Host&) override {
    broken_ = recorder.add({"bonds_broken", "1", "number of bonds broken in any mode"});
    tension_ = recorder.add({"bonds_broken_tension", "1", "number of bonds broken in tension"});
    shear_ = recorder.add({"bonds_broken_shear", "1", "number of bonds broken in shear"});
    damage_ = recorder.add({"global_damage", "1", "broken bonds over all bonds made", role::damage});
    fragments_ = recorder.add({"fragments", "1", "number of fragments with more than one particle"});
    largest_ =
        recorder.add({"largest_fragment_share", "1", "mass of the heaviest fragment over that of all particles"});
  }

  void start_of_loading(const SimulationView& view) override { before_loading_ = Broken(view).all; }

  void sample(const SimulationView& view, Recorder& recorder) override {
    const Broken broken(view);
    update(view, broken);
    recorder.set(broken_, double(broken.all));
    recorder.set(tension_, double(broken.tension));
    recorder.set(shear_, double(broken.shear));
    recorder.set(damage_, broken.damage());
    recorder.set(fragments_, double(found_.with_company));
    recorder.set(largest_, found_.largest_mass_share);
  }

  void fields(const SimulationView& view, std::vector<Field>& fields) override {
    // Of a part particles and their rows change without a bond that breaks.
    if (view.part) broken_when_found_.reset();
    update(view, Broken(view));
    const std::size_t count = view.particles.size();
    std::vector<double> made(count, 0), intact(count, 0), touching(count, 0);
    for (std::size_t b = 0; b < view.bonds.size(); ++b) {
      const bool holds = view.bonds.state[b] == BondState::intact;
      for (const Index p : {view.bonds.i[b], view.bonds.j[b]}) {
        made[p] += 1;
        intact[p] += holds;
      }
    }
    for (std::size_t k = 0; k < view.pairs.size(); ++k) {
      const PairForce& f = view.pairs.force[k];
      if (view.pairs.state[k] == BondState::intact || (f.fx == 0 && f.fy == 0 && f.fz == 0)) continue;
      touching[view.pairs.i[k]] += 1;
      touching[view.pairs.j[k]] += 1;
    }
    Field damage{Field::On::particles, "damage", "1", 1, {}};
    Field coordination{Field::On::particles, "coordination_number", "1", 1, {}};
    for (std::size_t p = 0; p < count; ++p) {
      damage.values.push_back(made[p] > 0 ? 1 - intact[p] / made[p] : 0.0);
      coordination.values.push_back(intact[p] + touching[p]);
    }
    fields.push_back(std::move(damage));
    fields.push_back({Field::On::particles, "fragment_id", "1", 1, {found_.of.begin(), found_.of.end()}, true});
    coordination.whole = true;
    fields.push_back(std::move(coordination));
  }

  void finish(const SimulationView& view, const Curves&, Summary& summary) override {
    const Broken broken(view);
    update(view, broken);
    summary.headline("bonds_broken_tension", broken.tension);
    summary.headline("bonds_broken_shear", broken.shear);
    summary.headline("global_damage", broken.damage());
    summary.own("bonds_made", broken.made);
    summary.own("bonds_broken", broken.all);
    summary.own("bonds_broken_before_loading", before_loading_ ? Json(*before_loading_) : Json());
    summary.own("fragments", found_.with_company);
    summary.own("single_particles", found_.count - found_.with_company);
    summary.own("largest_fragment_share", found_.largest_mass_share);
    Json by_materials = Json::object();
    for (const auto& [low, high, of] : by_materials_of(view))
      by_materials[view.materials[low] + "-" + view.materials[high]] = {
          {"bonds_made", of.made}, {"broken", of.all}, {"broken_tension", of.tension}, {"broken_shear", of.shear}};
    if (!by_materials.empty()) summary.own("by_materials", std::move(by_materials));
  }
  bool archive(Archive& archive) override {
    archive("before_loading", before_loading_);
    return true;
  }

 private:
  /// Broken bonds never heal: the fragments stay the same while the count does.
  void update(const SimulationView& view, const Broken& broken) {
    if (broken_when_found_ == broken.all) return;
    found_ = find_fragments(view);
    broken_when_found_ = broken.all;
  }

  std::size_t broken_ = 0, tension_ = 0, shear_ = 0, damage_ = 0, fragments_ = 0, largest_ = 0;
  Fragments found_;
  std::optional<std::size_t> broken_when_found_, before_loading_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Damage, "postprocessor", "damage")
