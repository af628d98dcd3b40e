// SPDX-License-Identifier: BSD-3-Clause
#include "engine/assembly.hpp"

#include <cmath>
#include <cstdio>

#include "engine/curve_order.hpp"
#include "engine/meeting_parts.hpp"
#include "engine/parts.hpp"
#include "engine/specimen.hpp"

namespace breccia {
namespace {

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", v);
  return text;
}

/// Of a packing in pieces: that of this rank, and the number of its first particle.
struct Piece {
  const PackedParticles& packing;
  const Materials& materials;
  const Space& space;
  std::size_t first;

  std::uint8_t material(std::size_t k) const {
    return materials.of_particle.empty() ? std::uint8_t(0) : materials.of_particle[k];
  }
  void refuse_bad() const {
    const PackedParticles& p = packing;
    BRECCIA_ASSERT(p.position.size() == p.radius.size());
    BRECCIA_ASSERT(materials.of_particle.empty() || materials.of_particle.size() == p.radius.size());
    for (std::size_t k = 0; k < p.position.size(); ++k) {
      const std::string particle = "particle " + std::to_string(first + k) + " of the packing";
      const double r = p.radius[k];
      if (!p.position[k].allFinite()) throw UserError(particle + " has a position that is not a finite number");
      if (!(r > 0) || !std::isfinite(r)) throw UserError(particle + " has a radius that is not a positive number");
      if (space.dimension == 2 && p.position[k].z() != 0)
        throw UserError("a two-dimensional packing must lie in the plane z = 0");
      const Material& of = materials.list.at(material(k));
      const double m = of.density * space.solid_volume(r);
      if (!std::isnormal(m * r * r) || !std::isnormal(m))
        throw UserError(particle + ", of radius " + number(r) + " m, has a mass of " + number(m) +
                        " kg, which cannot be reckoned with: check radii and " +
                        (materials.list.size() == 1 ? "material.density" : "materials." + of.name + ".density"));
    }
    if (!p.period.allFinite() || (p.period.array() < 0).any())
      throw UserError("the packing has a period that is not a positive number");
  }
};

}  // namespace

State assemble(const PackedParticles& packing, const Materials& materials, int dimension, double thickness,
               RankLink* link) {
  BRECCIA_ASSERT(!materials.list.empty() && materials.list.size() <= Materials::most);
  State s;
  s.dimension = dimension;
  s.thickness = thickness;
  for (const Material& m : materials.list) s.materials.push_back(m.name);

  const std::size_t here = packing.radius.size();
  std::size_t before = 0, all = 0;
  const std::vector<std::size_t> sizes = link ? link->numbers_of_all(here) : std::vector{here};
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    if (link && r < std::size_t(link->rank())) before += sizes[r];
    all += sizes[r];
  }
  if (all == 0) throw UserError("the packing has no particles");
  const Piece piece{packing, materials, s, before};
  MeetingParts(link).together([&] { piece.refuse_bad(); });

  std::vector<OnCurve> sorted;
  sorted.reserve(here);
  for (std::size_t k = 0; k < here; ++k)
    sorted.push_back({0, Index(before + k), piece.material(k), packing.position[k], packing.radius[k]});
  std::vector<Index> first_row;
  if (link) first_row = even_shares(all, link->ranks());
  sort_along_curve(sorted, link, first_row);

  Particles& p = s.particles;
  const std::size_t n = sorted.size();
  p.motion.reserve(n);
  p.id.reserve(n);
  for (const OnCurve& placed : sorted) {
    ParticleMotion& one = p.motion.emplace_back();
    one.position = placed.position;
    one.radius = placed.radius;
    one.mass = materials.list.at(placed.material).density * s.solid_volume(placed.radius);
    one.inertia = one.mass * s.gyration(one.radius);
    if (materials.list.size() > 1) p.material.push_back(placed.material);
    p.id.push_back(placed.id);
    if (link) p.row.push_back(Index(first_row[std::size_t(link->rank())] + p.row.size()));
  }
  sorted = {};
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
