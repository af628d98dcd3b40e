// SPDX-License-Identifier: BSD-3-Clause
#include "engine/walls.hpp"

#include <algorithm>

#include "breccia/coulomb.hpp"

namespace breccia {

Facing facing(const Wall& w, const Vec3& x) {
  const Vec3 from = x - w.point;
  if (w.cylinder_radius <= 0) return {from.dot(w.normal), w.normal};
  const Vec3 radial = from - from.dot(w.normal) * w.normal;
  const double off = radial.norm();
  return {w.cylinder_radius - off, off > 0 ? Vec3(-radial / off) : Vec3::Zero()};
}

void rebuild_wall_touches(State& s, double reach) {
  std::vector<WallTouch> old;
  old.swap(s.wall_touches);
  std::size_t next = 0;
  for (Index w = 0; w < s.walls.size(); ++w) {
    const Wall& wall = s.walls[w];
    for (Index a = Index(s.particles.first_own()); a < s.particles.end_own(); ++a) {
      if (facing(wall, s.particles.position()[a]).distance - s.particles.radius()[a] > reach) continue;
      while (next < old.size() && (old[next].wall < w || (old[next].wall == w && old[next].particle < a))) ++next;
      const bool known = next < old.size() && old[next].wall == w && old[next].particle == a;
      s.wall_touches.push_back(known ? old[next] : WallTouch{a, w});
    }
  }
}

namespace {
constexpr std::size_t of_wall = 4;  // force, normal force
}

std::size_t wall_sums(const State& s) { return s.walls.empty() ? 0 : of_wall * s.walls.size() + 1; }

void wall_forces(State& s, ExternalLoads& loads, std::span<ExactSum> sums) {
  const Particles& p = s.particles;
  const double dt = s.time_step;
  for (const WallTouch& t : s.wall_touches) loads.restart(t.particle, p);
  for (WallTouch& t : s.wall_touches) {
    const Wall& w = s.walls[t.wall];
    const double r = p.radius()[t.particle];
    const Facing f = facing(w, p.position()[t.particle]);
    t.overlap = r - f.distance;
    t.force.setZero();
    if (t.overlap <= 0) {
      t.spring.setZero();
      continue;
    }
    const double pressed = w.normal_stiffness * t.overlap;
    const Vec3 arm = -(r - t.overlap) * f.normal;  // from the centre to the contact point
    if (w.friction > 0) {
      // As between particles (`follow_plane`): the velocities belong to the middle of the step, and so does the
      // geometry that they are measured in. A cylinder's normal turns as the particle slides round.
      const Vec3 relative = p.velocity()[t.particle] - w.velocity;
      const Facing middle = facing(w, p.position()[t.particle] - 0.5 * dt * relative);
      Vec3 slip = relative - middle.distance * p.angular_velocity()[t.particle].cross(middle.normal);
      slip -= slip.dot(middle.normal) * middle.normal;
      slip -= slip.dot(f.normal) * f.normal;
      t.spring -= 2 * t.spring.dot(middle.normal) * middle.normal;
      t.spring -= t.spring.dot(f.normal) * f.normal;
      const Vec3 trial = t.spring + dt * slip;
      const CoulombSlip slider =
          coulomb_slip(w.shear_stiffness, trial.norm(), t.spring.dot(trial), w.friction * pressed);
      sums.back().add(slider.work);
      t.spring = slider.keep * trial;
      t.force = -w.shear_stiffness * t.spring;
    }
    t.force += pressed * f.normal;
    loads.add(t.particle, t.force, arm.cross(t.force));
    ExactSum* const on_wall = &sums[of_wall * t.wall];
    for (int k = 0; k < 3; ++k) on_wall[k].add(-t.force[k]);
    on_wall[3].add(pressed);
  }
}

void take_wall_forces(State& s, std::span<const double> totals) {
  if (s.walls.empty()) return;
  const double dt = s.time_step;
  s.energy.friction += totals.back();
  const double* of = totals.data();
  for (Wall& w : s.walls) {
    w.force = Vec3(of[0], of[1], of[2]);
    w.normal_force = of[3];
    of += of_wall;
    s.energy.boundary_work -= w.force.dot(w.velocity + w.previous_velocity) * 0.5 * dt;
    w.previous_velocity = w.velocity;
  }
}

double wall_work_ahead(const State& s) {
  double sum = 0;
  for (const Wall& w : s.walls) sum -= w.force.dot(w.velocity) * 0.5 * s.time_step;
  return sum;
}

void move_walls(State& s) {
  double fastest = 0;
  for (Wall& w : s.walls) {
    w.point += s.time_step * w.velocity;
    w.displacement += s.time_step * w.velocity;
    fastest = std::max(fastest, w.velocity.norm());
  }
  s.walls_moved += s.time_step * fastest;
  s.walls_moved_since_look += s.time_step * fastest;
}

void add_wall_energy(const State& s, ExactSum& to) {
  for (const WallTouch& t : s.wall_touches) {
    const Wall& w = s.walls[t.wall];
    if (t.overlap > 0)
      to.add(0.5 * (w.normal_stiffness * t.overlap * t.overlap + w.shear_stiffness * t.spring.squaredNorm()));
  }
}

}  // namespace breccia
