// SPDX-License-Identifier: BSD-3-Clause
#include "check/packing_measures.hpp"

#include <cstring>
#include <set>

#include "breccia/images.hpp"
#include "engine/specimen.hpp"

namespace breccia {
namespace {

double overhang_of(const PackedParticles& packed, const Container& container) {
  double most = -1e300;
  for (std::size_t k = 0; k < packed.radius.size(); ++k) {
    Container::Walls walls;
    const std::size_t n = container.walls(packed.position[k], walls);
    for (std::size_t w = 0; w < n; ++w) most = std::max(most, 1 - walls[w].distance / packed.radius[k]);
  }
  return most;
}

/// Far fewer coordinates than particles, in each direction.
bool is_orderly(const PackedParticles& p, double length, int dimension) {
  for (int k = 0; k < dimension; ++k) {
    std::set<long long> different;
    for (const Vec3& x : p.position) different.insert(std::llround(x[k] / (1e-6 * length)));
    if (different.size() > 3 + p.position.size() / 3) return false;
  }
  return true;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace

PackingMeasures measure_packing(const PackedParticles& packed, const PackingRequest& request,
                                const std::optional<Container>& container) {
  PackingMeasures m;
  Space space = request;
  space.cell = Cell::box(packed.period);
  const double n = double(packed.radius.size());
  m.least = m.most = packed.radius.front();
  m.low = m.high = packed.position.front();
  if (container) {
    const bool open = request.repeats() && container->shape() == Container::Shape::box;
    m.overhang = overhang_of(packed, open ? container->opened(request.periodic) : *container);
  }
  for (std::size_t k = 0; k < packed.radius.size(); ++k) {
    const double r = packed.radius[k];
    const Vec3& x = packed.position[k];
    m.mean += r / n;
    m.least = std::min(m.least, r);
    m.most = std::max(m.most, r);
    m.low = m.low.cwiseMin(x);
    m.high = m.high.cwiseMax(x);
  }
  for (const double r : packed.radius) m.deviation += (r - m.mean) * (r - m.mean) / n;
  m.deviation = std::sqrt(m.deviation);
  m.solid = solid_volume(packed.radius, space);
  double nearest = 1e300, overlap = 0;
  const auto pair = [&](Index i, Index j) {
    const double d = space.branch(packed.position[i], packed.position[j]).norm();
    nearest = std::min(nearest, d);
    overlap = std::max(overlap, 1 - d / (packed.radius[i] + packed.radius[j]));
  };
  double cutoff = 2 * m.most;
  for (int k = 0; k < 3; ++k)
    if (space.cell.repeats(k)) cutoff = std::min(cutoff, 0.499 * space.cell.width(k));
  for_each_pair_within(space, packed.position, cutoff, pair);
  m.nearest = nearest / m.least;
  m.overlap = overlap;
  m.orderly = is_orderly(packed, m.mean, request.dimension);
  return m;
}

std::optional<double> measured_as(const std::string& name, const PackedParticles& packed, const PackingMeasures& m) {
  if (name == "particles") return double(packed.radius.size());
  if (name == "porosity" && packed.container_volume > 0) return 1 - m.solid / packed.container_volume;
  if (name == "radius_mean") return m.mean;
  if (name == "radius_standard_deviation") return m.deviation;
  if (name == "radius_min") return m.least;
  if (name == "radius_max") return m.most;
  if (name == "max_overlap") return m.overlap;
  if (name == "period_x") return packed.period.x();
  if (name == "period_y") return packed.period.y();
  if (name == "period_z") return packed.period.z();
  return {};
}

bool same_packing(const PackedParticles& a, const PackedParticles& b) {
  return same_bytes(a.radius, b.radius) && same_bytes(a.position, b.position) && a.columns == b.columns;
}

PackedParticles joined(PackedParticles first, const PackedParticles& second) {
  const auto append = [](auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); };
  append(first.position, second.position);
  append(first.radius, second.radius);
  for (std::size_t c = 0; c < std::min(first.columns.size(), second.columns.size()); ++c)
    append(first.columns[c].second, second.columns[c].second);
  return first;
}

bool same_report(const PackedParticles& a, const PackedParticles& b) {
  const auto same = [](const AskedGot& x, const AskedGot& y) {
    return x.name == y.name && x.unit == y.unit && x.asked == y.asked && x.got == y.got;
  };
  return a.outline == b.outline && a.axis == b.axis && a.container_volume == b.container_volume &&
         a.period == b.period && std::equal(a.report.begin(), a.report.end(), b.report.begin(), b.report.end(), same);
}

}  // namespace breccia
