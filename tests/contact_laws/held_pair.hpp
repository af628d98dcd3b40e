// SPDX-License-Identifier: BSD-3-Clause
/// Two touching spheres of 1 mm that the engine leads along a path, held in all directions.
#pragma once

#include <gtest/gtest.h>

#include "support/support.hpp"

namespace breccia::testing {

class HeldPair {
 public:
  static constexpr double radius = 1e-3, density = 2650;

  /// `step` in critical steps: nothing moves freely, so it may be so long that rates vanish.
  explicit HeldPair(std::unique_ptr<ContactLaw> law, bool bonded = true, double step = 1e9) : law_(std::move(law)) {
    PackedParticles two;
    two.position = {Vec3::Zero(), Vec3(2 * radius, 0, 0)};
    two.radius = {radius, radius};
    two.outline = SpecimenShape::Outline::box;
    EngineSettings settings;
    settings.safety = step;
    simulation_ = std::make_unique<Simulation>(assemble(two, {density}, 3, 1), *law_, settings);
    simulation_->bond({GapMeasure::relative, bonded ? 1e-9 : -1e-3, std::nullopt});
    simulation_->prepare();
    for (const Index k : {0, 1}) simulation_->hold(k, dof::all, Vec3::Zero(), Vec3::Zero());
    simulation_->forces();
    simulation_->mark_start_of_loading();
  }

  /// Straight to these displacements [m] in n steps. Shear turns both spheres the same way: the centres stay on x.
  void lead(double normal, double shear, int n = 100) {
    const double normal_step = (normal - normal_) / n, shear_step = (shear - shear_) / n, dt = simulation_->time_step();
    for (int k = 0; k < n; ++k) {
      normal_ += normal_step;
      const Vec3 spin(0, 0, -shear_step / (2 * radius + normal_) / dt);
      simulation_->hold(0, dof::all, Vec3::Zero(), spin);
      simulation_->hold(1, dof::all, Vec3(normal_step / dt, 0, 0), spin);
      const double pull = normal_force(), drag = shear_force();
      simulation_->advance();
      simulation_->forces();
      work_ += 0.5 * ((pull + normal_force()) * normal_step + (drag + shear_force()) * shear_step);
    }
    normal_ = normal;
    shear_ = shear;
  }

  double normal_force() const { return simulation_->state().pairs.force[0].fx; }  ///< tension positive [N]
  double shear_force() const { return simulation_->state().pairs.force[0].fy; }
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

 private:
  std::unique_ptr<ContactLaw> law_;
  std::unique_ptr<Simulation> simulation_;
  double normal_ = 0, shear_ = 0, work_ = 0;
};

}  // namespace breccia::testing
