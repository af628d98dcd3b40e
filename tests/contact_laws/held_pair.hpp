// SPDX-License-Identifier: BSD-3-Clause
/// Two particles on the x axis that the engine leads along a path, held in all directions.
#pragma once

#include <gtest/gtest.h>

#include "support/support.hpp"

namespace breccia::testing {

struct PairSetup {
  bool bonded = true;
  double step = 1e9;  ///< in critical steps: nothing moves freely, so it may be so long that rates vanish
  int dimension = 3;
  double thickness = 1;                     // [m]
  double radius_i = 1e-3, radius_j = 1e-3;  // [m]
  double gap = 0;                           ///< between the surfaces at the start [m]
};

/// Of the second particle relative to the first: displacement along x, at the contact along y and z [m], rotation
/// about x, y and z [rad].
struct PairMotion {
  double normal = 0, shear_y = 0, shear_z = 0, twist = 0, bend_y = 0, bend_z = 0;
};

class HeldPair {
 public:
  static constexpr double radius = 1e-3, density = 2650;

  explicit HeldPair(std::unique_ptr<ContactLaw> law, bool bonded = true, double step = 1e9)
      : HeldPair(std::move(law), PairSetup{bonded, step}) {}
  HeldPair(std::unique_ptr<ContactLaw> law, const PairSetup& setup) : law_(std::move(law)), setup_(setup) {
    PackedParticles two;
    two.position = {Vec3::Zero(), Vec3(start(), 0, 0)};
    two.radius = {setup.radius_i, setup.radius_j};
    two.outline = SpecimenShape::Outline::box;
    EngineSettings settings;
    settings.safety = setup.step;
    simulation_ =
        std::make_unique<Simulation>(assemble(two, {density}, setup.dimension, setup.thickness), *law_, settings);
    const double touching = setup.radius_i + setup.radius_j;
    simulation_->bond({GapMeasure::absolute, setup.gap + (setup.bonded ? 1e-9 : -1e-3) * touching, std::nullopt});
    simulation_->prepare();
    for (const Index k : {0, 1}) simulation_->hold(k, dof::all, Vec3::Zero(), Vec3::Zero());
    simulation_->forces();
    simulation_->mark_start_of_loading();
  }

  /// Straight to these displacements [m] in n steps.
  void lead(double normal, double shear, int n = 100) {
    PairMotion to = now_;
    to.normal = normal;
    to.shear_y = shear;
    lead(to, n);
  }

  /// Shear turns both particles the same way, bending in proportion to the other's lever arm: the centres stay on x.
  void lead(const PairMotion& to, int n = 100) {
    const auto part = [&](double PairMotion::*m) { return (to.*m - now_.*m) / n; };
    const PairMotion by{part(&PairMotion::normal), part(&PairMotion::shear_y), part(&PairMotion::shear_z),
                        part(&PairMotion::twist),  part(&PairMotion::bend_y),  part(&PairMotion::bend_z)};
    const double dt = simulation_->time_step();
    for (int k = 0; k < n; ++k) {
      now_.normal += by.normal;
      const double distance = start() + now_.normal - 0.5 * by.normal,
                   half_gap = 0.5 * (distance - setup_.radius_i - setup_.radius_j);
      const double share_i = -(setup_.radius_j + half_gap) / distance,
                   share_j = (setup_.radius_i + half_gap) / distance;
      const Vec3 roll(0, by.shear_z / distance, -by.shear_y / distance), bend(0, by.bend_y, by.bend_z),
          twist(0.5 * by.twist, 0, 0);
      simulation_->hold(0, dof::all, Vec3::Zero(), (roll + share_i * bend - twist) / dt);
      simulation_->hold(1, dof::all, Vec3(by.normal / dt, 0, 0), (roll + share_j * bend + twist) / dt);
      const Vec3 force = this->force(), moment = this->moment();
      simulation_->advance();
      simulation_->forces();
      work_ += 0.5 * ((force + this->force()).dot(Vec3(by.normal, by.shear_y, by.shear_z)) +
                      (moment + this->moment()).dot(Vec3(by.twist, by.bend_y, by.bend_z)));
    }
    now_ = to;
  }

  Vec3 force() const {  ///< on the first particle: tension positive [N]
    const PairForce& f = simulation_->state().pairs.force[0];
    return {f.fx, f.fy, f.fz};
  }
  Vec3 moment() const {  ///< on the first particle, beside that of the force [N m]
    const auto& m = simulation_->state().pairs.moment;
    return m.empty() ? Vec3::Zero() : m[0];
  }
  double normal_force() const { return force().x(); }
  double shear_force() const { return force().y(); }
  double history(const std::string& name) const {
    const auto columns = law_->columns();
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].name == name) return simulation_->state().pairs.columns[c][0];
    ADD_FAILURE() << "no column " << name;
    return 0;
  }
  BondState bond() const { return simulation_->state().pairs.state[0]; }
  EnergyLedger energy() { return simulation_->view().energy; }
  double work() const { return work_; }  ///< by the trapezoidal rule over the forces [J]
  double unaccounted() {
    const EnergyLedger e = energy();
    return work_ - e.elastic - e.friction - e.contact - e.fracture;
  }
  Simulation& simulation() { return *simulation_; }
  const PairMotion& now() const { return now_; }
  ContactLaw& law() { return *law_; }

 private:
  double start() const { return setup_.radius_i + setup_.radius_j + setup_.gap; }

  std::unique_ptr<ContactLaw> law_;
  PairSetup setup_;
  std::unique_ptr<Simulation> simulation_;
  PairMotion now_;
  double work_ = 0;
};

}  // namespace breccia::testing
