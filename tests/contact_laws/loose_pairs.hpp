// SPDX-License-Identifier: BSD-3-Clause
/// Many pairs of particles, each pair by itself, on which a law is called as the engine calls it.
#pragma once

#include <cstring>
#include <memory>
#include <random>

#include "engine/interactions.hpp"

namespace breccia::testing {

struct LoosePairs {
  static constexpr double dt = 1e-8;  // [s]

  /// Bonded pairs of particles of 0.5 to 1.5 mm that touch, in any direction of space or of the plane z = 0.
  LoosePairs(std::unique_ptr<ContactLaw> its_law, std::size_t n, int dimension, bool in_plane, bool swapped = false)
      : law(std::move(its_law)),
        motion(2 * n),
        force(n),
        moment(n),
        rest(n),
        state(n, BondState::intact),
        history(law->columns().size(), std::vector<double>(n)) {
    std::mt19937_64 random(1);
    const auto uniform = [&] { return 2 * (double(random() >> 11) * 0x1p-53) - 1; };
    for (Index k = 0; k < n; ++k) {
      first.push_back(swapped ? 2 * k + 1 : 2 * k);
      second.push_back(swapped ? 2 * k : 2 * k + 1);
      for (const Index a : {2 * k, 2 * k + 1}) {
        motion[a].mass = 1e-4;
        motion[a].radius = 1e-3 + 0.5e-3 * uniform();
      }
      rest[k] = motion[2 * k].radius + motion[2 * k + 1].radius;
      motion[2 * k].position = 1e-2 * Vec3(uniform(), uniform(), in_plane ? 0 : uniform());
      Vec3 n_k(uniform(), uniform(), uniform());
      if (in_plane) n_k.z() = 0;
      motion[2 * k + 1].position = motion[2 * k].position + rest[k] * n_k.normalized();
    }
    Assembly a;
    a.dimension = dimension;
    a.radius = {&motion[0].radius, motion.size(), sizeof motion[0]};
    a.mass = {&motion[0].mass, motion.size(), sizeof motion[0]};
    law->prepare(a);
    for (auto& c : history) columns.push_back(c.data());
    const std::size_t chunks = (n + PairBatch::chunk - 1) / PairBatch::chunk;
    dissipated.assign(chunks, {});
    broke.assign(chunks, 0);
    batch.end = n;
    batch.i = first.data();
    batch.j = second.data();
    batch.rest_length = rest.data();
    batch.state = state.data();
    batch.columns = columns.data();
    batch.motion = motion.data();
    batch.force = force.data();
    batch.moment = moment.data();
    batch.dissipated = dissipated.data();
    batch.chunk_broke = broke.data();
    batch.time_step = dt;
    Interactions(*law).initialise(batch);
  }
  LoosePairs(const LoosePairs&) = delete;
  LoosePairs& operator=(const LoosePairs&) = delete;

  /// Each particle takes one random step of this share of its radius, and turns by as much; `frame` turns the motion.
  void wander(std::mt19937_64& random, double share, bool in_plane, const Mat3& frame = Mat3::Identity()) {
    const auto uniform = [&] { return 2 * (double(random() >> 11) * 0x1p-53) - 1; };
    for (ParticleMotion& one : motion) {
      const Vec3 v(uniform(), uniform(), uniform()), w(uniform(), uniform(), uniform());
      const double size = share / dt;
      one.velocity = size * one.radius * (frame * (in_plane ? Vec3(v.x(), v.y(), 0) : v));
      one.angular_velocity = size * (frame * (in_plane ? Vec3(0, 0, w.z()) : w));
      one.position += dt * one.velocity;
    }
    Interactions(*law).evaluate(batch);
  }

  std::size_t count(BondState which) const { return std::size_t(std::count(state.begin(), state.end(), which)); }

  std::unique_ptr<ContactLaw> law;
  PairBatch batch;
  std::vector<Index> first, second;
  std::vector<ParticleMotion> motion;
  std::vector<PairForce> force;
  std::vector<Vec3> moment;
  std::vector<double> rest;
  std::vector<BondState> state;
  std::vector<std::vector<double>> history;
  std::vector<double*> columns;
  std::vector<Dissipated> dissipated;
  std::vector<std::uint8_t> broke;
};

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace breccia::testing
