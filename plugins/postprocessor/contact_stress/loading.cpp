// SPDX-License-Identifier: BSD-3-Clause
#include "loading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "breccia/block_sum.hpp"

namespace breccia {

DirectionBin& DirectionBin::operator+=(const DirectionBin& o) {
  contacts += o.contacts;
  compressed += o.compressed;
  tensile += o.tensile;
  yielded += o.yielded;
  compression += o.compression;
  tension += o.tension;
  yield += o.yield;
  return *this;
}

double axial_stress(const SimulationView& view) {
  const ParticlesView& p = view.particles;
  const Vec3& axis = view.specimen.axis;
  const auto part = [&](const Vec3& arm, const Vec3& force) { return arm.dot(axis) * force.dot(axis); };
  BlockSum<double> of_pairs(view), of_boundary(view);
  for (const std::size_t k : view.own_pairs()) {
    const PairForce& f = view.pairs.force[k];
    of_pairs.add(view.pairs.i[k],
                 part(view.branch(p.position[view.pairs.i[k]], p.position[view.pairs.j[k]]), Vec3(f.fx, f.fy, f.fz)));
  }
  ExactSumOf<double> of_walls;
  for (const WallContact& c : view.wall_contacts) of_walls.add(part(c.point - p.position[c.particle], c.force));
  if (!p.boundary_moment.empty())
    for (const std::size_t k : view.own_particles()) of_boundary.add(k, axis.dot(p.boundary_moment[k] * axis));
  const auto [pairs, walls, boundary] = view.sum(of_pairs.exact(), of_walls, of_boundary.exact());
  return -(pairs + walls + boundary) / view.specimen.volume;
}

std::vector<DirectionBin> by_direction(const SimulationView& view, std::size_t bins, double area_factor,
                                       std::optional<double> limit) {
  std::vector<DirectionBin> all(bins);
  std::vector<ExactSum> sums(3 * bins);  // of each interval: compression, tension, yield
  const ParticlesView& p = view.particles;
  for (const std::size_t k : view.own_pairs()) {
    const PairForce& f = view.pairs.force[k];
    if (view.pairs.state[k] != BondState::intact && f.fx == 0 && f.fy == 0 && f.fz == 0) continue;
    const Index i = view.pairs.i[k], j = view.pairs.j[k];
    const Vec3 n = view.branch(p.position[i], p.position[j]).normalized();
    const double r = std::min(p.radius[i], p.radius[j]);
    const double area = area_factor * (view.dimension == 2 ? 2 * r * view.thickness : std::numbers::pi * r * r);
    const double pressure = -(f.fx * n.x() + f.fy * n.y() + f.fz * n.z()) / area;  // the force on i points away from j
    const double share = std::asin(std::min(1.0, std::abs(n.dot(view.specimen.axis)))) / (0.5 * std::numbers::pi);
    const std::size_t at = std::min(bins - 1, std::size_t(share * double(bins)));
    DirectionBin& bin = all[at];
    ++bin.contacts;
    if (pressure > 0) {
      ++bin.compressed;
      sums[3 * at].add(pressure);
    } else if (pressure < 0) {
      ++bin.tensile;
      sums[3 * at + 1].add(-pressure);
    }
    if (limit && pressure >= *limit) {
      ++bin.yielded;
      sums[3 * at + 2].add(pressure);
    }
  }
  for (const DirectionBin& bin : all)
    for (const std::size_t count : {bin.contacts, bin.compressed, bin.tensile, bin.yielded})
      sums.emplace_back().add(double(count));
  const std::vector<double> of_all = view.sums(sums);
  for (std::size_t b = 0; b < bins; ++b) {
    const double *const of = &of_all[3 * b], *const count = &of_all[3 * bins + 4 * b];
    all[b] = {std::size_t(count[0]),
              std::size_t(count[1]),
              std::size_t(count[2]),
              std::size_t(count[3]),
              of[0],
              of[1],
              of[2]};
  }
  return all;
}

void FirstLoading::sample(const SimulationView& view, double area_factor, std::optional<double> limit) {
  const double stress = axial_stress(view);
  if (!(stress > (highest_ ? highest_->axial_stress : 0.0))) return;
  highest_ = Snapshot{stress, view.time, by_direction(view, bins_, area_factor, limit)};
  if (!levels_.empty() && stress < step * levels_.back().axial_stress) return;
  levels_.push_back(*highest_);
  // What lies too low by now for any share, down to the last one below it.
  std::size_t low = 0;
  while (low + 1 < levels_.size() && levels_[low + 1].axial_stress <= lowest_share_ * stress) ++low;
  levels_.erase(levels_.begin(), levels_.begin() + std::ptrdiff_t(low));
}

const Snapshot* FirstLoading::at(double share) const {
  if (!highest_) return nullptr;
  const double wanted = share * highest_->axial_stress;
  const Snapshot* best = &*highest_;
  for (const Snapshot& s : levels_)
    if (std::abs(s.axial_stress - wanted) < std::abs(best->axial_stress - wanted)) best = &s;
  return best;
}

}  // namespace breccia
