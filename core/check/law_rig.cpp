// SPDX-License-Identifier: BSD-3-Clause
#include "check/law_rig.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

constexpr double density = 2650;  // [kg/m3]

double mass_of(double radius) { return density * 4.0 / 3.0 * M_PI * radius * radius * radius; }

}  // namespace

LawRig::LawRig(ContactLaw& law, const Start& start, double time_step, std::size_t width)
    : law_(law), start_(start), dt_(time_step), width_(width), chunk_(std::make_unique<PairChunk>()) {
  r_[0] = start.radius_i;
  r_[1] = start.radius_j;
  if (start.swapped) std::swap(r_[0], r_[1]);
  rest_ = r_[0] + r_[1] + start.gap;
  x_[0] = Vec3::Zero();
  x_[1] = start.turned * Vec3(start.swapped ? -rest_ : rest_, 0, 0);
  for (int e = 0; e < 2; ++e) v_[e] = w_[e] = Vec3::Zero();
  intact_ = start.bonded;
  columns_.assign(law.columns().size(), std::vector<double>(PairChunk::capacity));
  for (auto& c : columns_) history_.push_back(c.data());
  gather();
  law_.initialise(*chunk_, history_.data());
  last_ = evaluate();
}

void LawRig::gather() {
  PairChunk& g = *chunk_;
  const Vec3 d = x_[1] - x_[0], v = v_[1] - v_[0];
  g.size = width_;  // the same pair in each place: the vector loop, as a run has it
  g.time_step = dt_;
  for (std::size_t k = 0; k < g.size; ++k) {
    g.dx[k] = d.x();
    g.dy[k] = d.y();
    g.dz[k] = d.z();
    g.vx[k] = v.x();
    g.vy[k] = v.y();
    g.vz[k] = v.z();
    g.wix[k] = w_[0].x();
    g.wiy[k] = w_[0].y();
    g.wiz[k] = w_[0].z();
    g.wjx[k] = w_[1].x();
    g.wjy[k] = w_[1].y();
    g.wjz[k] = w_[1].z();
    g.ri[k] = r_[0];
    g.rj[k] = r_[1];
    g.mi[k] = mass_of(r_[0]);
    g.mj[k] = mass_of(r_[1]);
    g.rest[k] = rest_;
    g.intact[k] = g.may_break[k] = intact_ ? 1 : 0;
    g.kind[k] = 0;
  }
}

PairResponse LawRig::evaluate() {
  auto answer = std::make_unique<PairAnswer>();
  *answer = {};
  // A law that adds to others sees the normal force of a spring before it.
  const bool adds = !law_.makes_bonds();
  const double stretch = distance() - rest_;
  if (adds && (intact_ || stretch < 0)) std::fill_n(answer->normal, PairAnswer::n, spring_before * stretch);
  law_.evaluate(*chunk_, history_.data(), *answer, adds);
  const PairAnswer& a = *answer;
  PairResponse r;
  r.force = Vec3(a.fx[0], a.fy[0], a.fz[0]);
  const Vec3 lever(a.tx[0], a.ty[0], a.tz[0]),
      moment = law_.has_moments() ? Vec3(a.mx[0], a.my[0], a.mz[0]) : Vec3(0, 0, 0);
  r.torque_i = (r_[0] + a.half_gap[0]) * lever + moment;
  r.torque_j = (r_[1] + a.half_gap[0]) * lever - moment;
  r.breaks = a.breaks[0];
  r.friction = a.friction[0];
  r.contact = a.contact[0];
  r.fracture = a.fracture[0];
  if (r.breaks != 0) intact_ = false;
  return r;
}

PairResponse LawRig::step(const PairMotion& motion) {
  const int i = start_.swapped ? 1 : 0, j = 1 - i;
  v_[i] = start_.turned * motion.velocity_i;
  v_[j] = start_.turned * motion.velocity_j;
  w_[i] = start_.turned * motion.spin_i;
  w_[j] = start_.turned * motion.spin_j;
  for (int e = 0; e < 2; ++e) x_[e] += dt_ * v_[e];
  gather();
  const PairResponse before = last_;
  last_ = evaluate();
  const double done = -0.5 * dt_ *
                      ((before.force + last_.force).dot(v_[0] - v_[1]) + (before.torque_i + last_.torque_i).dot(w_[0]) +
                       (before.torque_j + last_.torque_j).dot(w_[1]));
  work_ += done;
  way_ += std::abs(done);
  return last_;
}

double LawRig::energy() {
  std::vector<double> stored(PairChunk::capacity);
  law_.energy(*chunk_, history_.data(), stored.data());
  return stored[0];
}

ContactStiffness LawRig::stiffness() {
  std::vector<ContactStiffness> all(PairChunk::capacity);
  law_.stiffness(*chunk_, history_.data(), all.data());
  return all[0];
}

std::vector<double> LawRig::history() const {
  std::vector<double> values;
  for (const auto& c : columns_) values.push_back(c[0]);
  return values;
}

}  // namespace breccia
