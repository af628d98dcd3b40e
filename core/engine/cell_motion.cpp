// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cell_motion.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "breccia/error.hpp"
#include "engine/chunks.hpp"

namespace breccia {
namespace {

/// Block by block, as all sums over particles.
Vec3 centre_of_mass(const Particles& p, int threads) {
  const std::size_t blocks = (p.size() + particle_block - 1) / particle_block;
  std::vector<Vec3> moments(blocks, Vec3::Zero());
  std::vector<double> masses(blocks, 0.0);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t b = 0; b < blocks; ++b)
    for (std::size_t a = b * particle_block; a < std::min(p.size(), (b + 1) * particle_block); ++a) {
      moments[b] += p.mass()[a] * p.position()[a];
      masses[b] += p.mass()[a];
    }
  Vec3 moment = Vec3::Zero();
  double mass = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    moment += moments[b];
    mass += masses[b];
  }
  return moment / mass;
}

}  // namespace

CellMotion lead_cell(State& s, int threads) {
  s.energy.boundary_work -=
      0.5 * s.time_step * s.cell_forces.across.cwiseProduct(s.cell_velocity + s.cell_velocity_asked).sum();
  CellMotion motion{s.cell_velocity * s.cell.inverse(), s.cell_velocity_asked * s.cell.inverse(), Vec3::Zero()};
  s.cell_velocity = s.cell_velocity_asked;
  if (motion.any()) motion.centre = centre_of_mass(s.particles, threads);
  return motion;
}

void move_cell(State& s) {
  if (s.cell_velocity.isZero(0)) return;
  const double strain = s.time_step * (s.cell_velocity * s.cell.inverse()).norm();
  s.strained += strain;
  s.strained_since_look += strain;
  s.cell = Cell(s.cell.vectors() + s.time_step * s.cell_velocity);
}

double cell_work_behind(const State& s) {
  return -0.5 * s.time_step * s.cell_forces.across.cwiseProduct(s.cell_velocity).sum();
}

void refuse_narrow_cell(const Space& space, double length) {
  for (int k = 0; k < 3; ++k) {
    if (!space.cell.repeats(k) || space.cell.width(k) > 2 * length) continue;
    char text[240];
    std::snprintf(text, sizeof text,
                  "along %c space repeats itself after %.4g m, and particles feel each other up to %.4g m away: one "
                  "could meet two images of another. Make the cell wider than %.4g m",
                  "xyz"[k], space.cell.width(k), length, 2 * length);
    throw UserError(text);
  }
}

}  // namespace breccia
