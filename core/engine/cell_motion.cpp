// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cell_motion.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "breccia/error.hpp"
#include "engine/chunks.hpp"

namespace breccia {
namespace {

Vec3 centre_of_mass(const Particles& p, RankLink* link) {
  std::vector<ExactSum> sums(4);
  for (int k = 0; k < 3; ++k)
    add_block_by_block(p, sums[std::size_t(k)], [&](std::size_t a) { return p.mass()[a] * p.position()[a][k]; });
  add_block_by_block(p, sums[3], [&](std::size_t a) { return p.mass()[a]; });
  const std::vector<double> all = totals(sums, link);
  return Vec3(all[0], all[1], all[2]) / all[3];
}

}  // namespace

CellMotion lead_cell(State& s, RankLink* link) {
  s.energy.boundary_work -=
      0.5 * s.time_step * s.cell_forces.across.cwiseProduct(s.cell_velocity + s.cell_velocity_asked).sum();
  CellMotion motion{s.cell_velocity * s.cell.inverse(), s.cell_velocity_asked * s.cell.inverse(), Vec3::Zero()};
  s.cell_velocity = s.cell_velocity_asked;
  if (motion.any()) motion.centre = centre_of_mass(s.particles, link);
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
