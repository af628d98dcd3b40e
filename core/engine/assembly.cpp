// SPDX-License-Identifier: BSD-3-Clause
#include "engine/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "engine/parts.hpp"
#include "engine/specimen.hpp"

namespace breccia {
namespace {

/// Spreads the low 21 bits so that two zero bits follow each.
std::uint64_t spread(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", v);
  return text;
}

void refuse_bad(const PackedParticles& p) {
  if (p.position.empty()) throw UserError("the packing has no particles");
  BRECCIA_ASSERT(p.position.size() == p.radius.size());
  for (std::size_t k = 0; k < p.position.size(); ++k) {
    if (!p.position[k].allFinite())
      throw UserError("particle " + std::to_string(k) + " of the packing has a position that is not a finite number");
    if (!(p.radius[k] > 0) || !std::isfinite(p.radius[k]))
      throw UserError("particle " + std::to_string(k) + " of the packing has a radius that is not a positive number");
  }
  if (!p.period.allFinite() || (p.period.array() < 0).any())
    throw UserError("the packing has a period that is not a positive number");
}

}  // namespace

std::vector<Index> morton_order(Strided<const Vec3> points) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), Index(0));
  if (points.empty()) return order;
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double scale = 2097151.0 / std::max((high - low).maxCoeff(), 1e-300);
  std::vector<std::uint64_t> code(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 cell = (points[k] - low) * scale;
    code[k] =
        spread(std::uint64_t(cell.x())) | spread(std::uint64_t(cell.y())) << 1 | spread(std::uint64_t(cell.z())) << 2;
  }
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return code[a] < code[b]; });
  return order;
}

State assemble(const PackedParticles& packing, const Materials& materials, int dimension, double thickness,
               RankLink* link) {
  refuse_bad(packing);
  BRECCIA_ASSERT(!materials.list.empty() && materials.list.size() <= Materials::most);
  BRECCIA_ASSERT(materials.of_particle.empty() || materials.of_particle.size() == packing.radius.size());
  State s;
  s.dimension = dimension;
  s.thickness = thickness;
  for (const Material& m : materials.list) s.materials.push_back(m.name);
  const auto material_of = [&](Index k) {
    return materials.of_particle.empty() ? std::uint8_t(0) : materials.of_particle[k];
  };
  const auto mass_of = [&](Index k) {
    return materials.list.at(material_of(k)).density * s.solid_volume(packing.radius[k]);
  };
  const std::vector<Index> order = morton_order(packing.position);
  for (const Index k : order) {
    const double r = packing.radius[k], m = mass_of(k);
    if (dimension == 2 && packing.position[k].z() != 0)
      throw UserError("a two-dimensional packing must lie in the plane z = 0");
    if (!std::isnormal(m * r * r) || !std::isnormal(m))
      throw UserError("particle " + std::to_string(k) + " of the packing, of radius " + number(r) +
                      " m, has a mass of " + number(m) + " kg, which cannot be reckoned with: check radii and " +
                      (materials.list.size() == 1 ? "material.density"
                                                  : "materials." + materials.list[material_of(k)].name + ".density"));
  }
  Particles& p = s.particles;
  Index first = 0, end = Index(order.size());
  if (link) {
    const std::vector<Index> shares = even_shares(order.size(), link->ranks());
    first = shares[std::size_t(link->rank())];
    end = shares[std::size_t(link->rank()) + 1];
    for (Index row = first; row < end; ++row) p.row.push_back(row);
  }
  const std::size_t n = end - first;
  p.motion.reserve(n);
  p.id.reserve(n);
  for (Index row = first; row < end; ++row) {
    const Index k = order[row];
    ParticleMotion& one = p.motion.emplace_back();
    one.position = packing.position[k];
    one.radius = packing.radius[k];
    one.mass = mass_of(k);
    one.inertia = one.mass * s.gyration(one.radius);
    if (materials.list.size() > 1) p.material.push_back(material_of(k));
    p.id.push_back(k);
  }
  p.load.resize(n);
  p.reference_position.assign(p.position().begin(), p.position().end());
  p.held.assign(n, dimension == 2 ? dof::out_of_plane : std::uint8_t(0));
  s.cell = s.reference_cell = Cell::box(packing.period);
  s.specimen =
      measure_specimen(p.position(), p.radius(), s.cell.repeats() ? SpecimenShape::Outline::box : packing.outline,
                       packing.axis, s, packing.container_volume, link);
  return s;
}

}  // namespace breccia
