// SPDX-License-Identifier: BSD-3-Clause
/// Laws from their libraries that add up, and a simulation of theirs.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "support/support.hpp"

namespace breccia::testing {

struct Several {
  using Laws = std::vector<std::pair<std::string, Json>>;

  Several(const PackedParticles& packing, const Laws& list, double tolerance, EngineSettings settings = {},
          int dimension = 3, double thickness = 1, double density = 2650) {
    std::vector<NamedLaw> named;
    for (const auto& [name, config] : list) {
      laws.push_back(make_law(config, name));
      named.push_back({laws.back().get(), name});
    }
    simulation =
        std::make_unique<Simulation>(assemble(packing, {density}, dimension, thickness), Interactions(named), settings);
    simulation->bond({GapMeasure::relative, tolerance, std::nullopt});
    simulation->prepare();
  }
  Simulation* operator->() { return simulation.get(); }

  /// Where a particle of the packing has come to stand.
  Index of(Index id) const {
    const auto& ids = simulation->state().particles.id;
    return Index(std::find(ids.begin(), ids.end(), id) - ids.begin());
  }
  /// Gives a particle of the packing these velocities, and lets it go.
  void throw_it(Index id, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
    simulation->hold(of(id), dof::all, velocity, spin);
    simulation->release(of(id), dof::all);
  }
  void lead(Index id, const Vec3& displacement) {
    simulation->hold(of(id), dof::all, displacement / simulation->time_step(), Vec3::Zero());
  }
  void step(int n = 1) {
    for (int k = 0; k < n; ++k) {
      if (!simulation->forces_known()) simulation->forces();
      simulation->advance();
      simulation->forces();
    }
  }

  std::vector<std::unique_ptr<ContactLaw>> laws;
  std::unique_ptr<Simulation> simulation;
};

/// Two spheres on the x axis; `gap` between the surfaces.
inline PackedParticles two_spheres(double radius_i, double radius_j, double gap = 0) {
  PackedParticles p;
  p.position = {Vec3::Zero(), Vec3(radius_i + radius_j + gap, 0, 0)};
  p.radius = {radius_i, radius_j};
  p.outline = SpecimenShape::Outline::box;
  return p;
}

/// What becomes of two spheres that are thrown at each other.
struct Impact {
  double force = 0, overlap = 0, time = 0;  ///< the largest [N], [m]; how long they touch [s]
  double least_force = 0;                   ///< along the normal, pushes positive [N]
  int steps = 0;                            ///< while they touch
  double kinetic = 0;                       ///< before [J]
  Vec3 velocity[2], spin[2];                ///< afterwards, of the packing's first and second
  EnergyLedger energy;
};

/// Both are given their velocities and spin freely, but what is held already.
inline Impact impact(Several& s, const Vec3& first, const Vec3& second) {
  const auto& p = s->state().particles;
  const Index a = s.of(0), b = s.of(1);
  s.throw_it(0, first);
  if (p.held[b] != dof::all) s.throw_it(1, second);
  s->forces();
  s->mark_start_of_loading();
  const double touching = p.radius()[a] + p.radius()[b];
  Impact i;
  i.kinetic = s->view().energy.kinetic;
  for (int k = 0; k < 10000000; ++k) {
    s.step();
    const Vec3 branch = p.position()[b] - p.position()[a];
    const double overlap = touching - branch.norm(), push = -p.force()[a].dot(branch.normalized());
    i.force = std::max(i.force, push);
    i.least_force = std::min(i.least_force, push);
    i.overlap = std::max(i.overlap, overlap);
    if (overlap > 0) ++i.steps;
    else if (i.steps > 0) break;
  }
  EXPECT_GT(i.steps, 0);
  i.time = i.steps * s->time_step();
  for (const Index which : {0, 1}) {
    i.velocity[which] = p.velocity()[s.of(which)];
    i.spin[which] = p.angular_velocity()[s.of(which)];
  }
  i.energy = s->view().energy;
  return i;
}

}  // namespace breccia::testing
