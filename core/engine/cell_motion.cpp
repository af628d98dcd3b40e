// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cell_motion.hpp"

#include <cstdio>

#include "breccia/error.hpp"
#include "engine/chunks.hpp"

namespace breccia {
namespace {

/// Block by block, as all sums over particles.
Vec3 centre_of_mass(const Particles& p) {
  Vec3 moment = Vec3::Zero();
  double mass = 0;
  for (std::size_t first = 0; first < p.size(); first += particle_block) {
    Vec3 of_block = Vec3::Zero();
    double in_block = 0;
    for (std::size_t a = first; a < std::min(p.size(), first + particle_block); ++a) {
      of_block += p.mass[a] * p.position[a];
      in_block += p.mass[a];
    }
    moment += of_block;
    mass += in_block;
  }
  return moment / mass;
}

CellField field_of(const State& s, const Mat3& velocity) {
  if (velocity.isZero(0)) return {};
  return {velocity * s.cell.inverse(), centre_of_mass(s.particles)};
}

}  // namespace

CellField cell_field(const State& s) { return field_of(s, s.cell_velocity); }

void lead_cell(State& s) {
  s.energy.boundary_work -=
      0.5 * s.time_step * s.cell_forces.across.cwiseProduct(s.cell_velocity + s.cell_velocity_asked).sum();
  if (s.cell_velocity_asked == s.cell_velocity) return;
  const CellField push = field_of(s, s.cell_velocity_asked - s.cell_velocity);
  s.cell_velocity = s.cell_velocity_asked;
  Particles& p = s.particles;
  double work = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Vec3 more = push.at(p.position[a]);
    for (int k = 0; k < 3; ++k) {
      if (p.held[a] >> k & 1) continue;
      double& v = p.velocity[a][k];
      work += p.mass[a] * more[k] * (v + 0.5 * more[k]) + 0.5 * s.time_step * p.force[a][k] * more[k];
      v += more[k];
    }
  }
  s.energy.boundary_work += work;
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
