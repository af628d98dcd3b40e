// SPDX-License-Identifier: BSD-3-Clause
/// Two spheres on the x axis, and a law called on them as the engine calls it.
#pragma once

#include <array>
#include <memory>

#include "engine/interactions.hpp"

namespace breccia::test {

struct PairRig {
  static constexpr double r1 = 2e-3, r2 = 3e-3, dt = 1e-7;  // [m], [m], [s]

  /// For laws with at most four columns of history and no moments.
  explicit PairRig(std::unique_ptr<ContactLaw> its_law) : law(std::move(its_law)) {
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k] = &history[k];
    batch.end = 1;
    batch.i = &first;
    batch.j = &second;
    batch.rest_length = &rest;
    batch.state = &state;
    batch.columns = columns.data();
    batch.motion = motion;
    motion[0].radius = r1;
    motion[1].radius = r2;
    motion[0].mass = 1e-4;
    motion[1].mass = 2e-4;
    batch.force = &force;
    batch.dissipated = &dissipated;
    batch.chunk_broke = &broke;
    batch.time_step = dt;
    law->prepare({});
  }
  PairRig(const PairRig&) = delete;
  PairRig& operator=(const PairRig&) = delete;

  /// Sets the overlap [m], moves sphere 2 along y by `slip` [m] in one step, and evaluates.
  void step(double overlap, double slip) {
    motion[1].position = Vec3(r1 + r2 - overlap, 0, 0);
    motion[1].velocity = Vec3(0, slip / dt, 0);
    Interactions(*law).evaluate(batch);
  }
  double energy() const { return Interactions(*law).energy(batch); }

  std::unique_ptr<ContactLaw> law;
  PairBatch batch;
  Index first = 0, second = 1;
  double rest = r1 + r2, history[4] = {};
  Dissipated dissipated;
  ParticleMotion motion[2];
  std::array<double*, 4> columns;
  BondState state = BondState::unbonded;
  PairForce force;  ///< on sphere 1
  std::uint8_t broke = 0;
};

}  // namespace breccia::test
