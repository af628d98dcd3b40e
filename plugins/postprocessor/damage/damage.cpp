// SPDX-License-Identifier: BSD-3-Clause
/// Broken bonds, damage of each particle, and the fragments they leave.
/// Source: Rojek et al. (2012), Int. J. Solids Struct. 49, 1497-1517, Eq. 60 and section 5.3.
#include <optional>

#include "breccia/postprocessor.hpp"
#include "fragments.hpp"

namespace breccia {
namespace {

struct Broken {
  std::size_t all = 0, tension = 0, shear = 0;
  explicit Broken(const BondsView& bonds) {
    for (const BondState s : bonds.state) {
      all += is_broken(s);
      tension += s == BondState::broken_tension;
      shear += s == BondState::broken_shear;
    }
  }
};

/// Equals the mean of the particles' damage, each weighted with its initial bonds.
double global_damage(const Broken& broken, const BondsView& bonds) {
  return bonds.size() > 0 ? double(broken.all) / double(bonds.size()) : 0.0;
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

  void begin(const SimulationView&, Recorder& recorder, Host&) override {
    broken_ = recorder.add({"bonds_broken", "1", "number of bonds broken in any mode"});
    tension_ = recorder.add({"bonds_broken_tension", "1", "number of bonds broken in tension"});
    shear_ = recorder.add({"bonds_broken_shear", "1", "number of bonds broken in shear"});
    damage_ = recorder.add({"global_damage", "1", "broken bonds over all bonds made", role::damage});
    fragments_ = recorder.add({"fragments", "1", "number of fragments with more than one particle"});
    largest_ =
        recorder.add({"largest_fragment_share", "1", "mass of the heaviest fragment over that of all particles"});
  }

  void start_of_loading(const SimulationView& view) override { before_loading_ = Broken(view.bonds).all; }

  void sample(const SimulationView& view, Recorder& recorder) override {
    const Broken broken(view.bonds);
    update(view, broken);
    recorder.set(broken_, double(broken.all));
    recorder.set(tension_, double(broken.tension));
    recorder.set(shear_, double(broken.shear));
    recorder.set(damage_, global_damage(broken, view.bonds));
    recorder.set(fragments_, double(found_.with_company));
    recorder.set(largest_, found_.largest_mass_share);
  }

  void fields(const SimulationView& view, std::vector<Field>& fields) override {
    update(view, Broken(view.bonds));
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
    const Broken broken(view.bonds);
    update(view, broken);
    summary.headline("bonds_broken_tension", broken.tension);
    summary.headline("bonds_broken_shear", broken.shear);
    summary.headline("global_damage", global_damage(broken, view.bonds));
    summary.own("bonds_made", view.bonds.size());
    summary.own("bonds_broken", broken.all);
    summary.own("bonds_broken_before_loading", before_loading_ ? Json(*before_loading_) : Json());
    summary.own("fragments", found_.with_company);
    summary.own("single_particles", found_.count - found_.with_company);
    summary.own("largest_fragment_share", found_.largest_mass_share);
    Json by_materials = Json::object();
    for_each_pair_of_materials(view, [&](const std::string& name, const std::vector<std::size_t>& rows) {
      std::size_t all = 0, tension = 0, shear = 0;
      for (const std::size_t b : rows) {
        const BondState s = view.bonds.state[b];
        all += is_broken(s);
        tension += s == BondState::broken_tension;
        shear += s == BondState::broken_shear;
      }
      by_materials[name] = {
          {"bonds_made", rows.size()}, {"broken", all}, {"broken_tension", tension}, {"broken_shear", shear}};
    });
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
    found_ = find_fragments(view.particles, view.bonds);
    broken_when_found_ = broken.all;
  }

  std::size_t broken_ = 0, tension_ = 0, shear_ = 0, damage_ = 0, fragments_ = 0, largest_ = 0;
  Fragments found_;
  std::optional<std::size_t> broken_when_found_, before_loading_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Damage, "postprocessor", "damage")
