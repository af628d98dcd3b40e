// SPDX-License-Identifier: BSD-3-Clause
#include "run/packing_parts.hpp"

#include "engine/meeting_parts.hpp"
#include "engine/migration.hpp"
#include "engine/shared_lists.hpp"
#include "run/run_ranks.hpp"

namespace breccia {
namespace {

struct Dealt {
  Vec3 position;
  double radius;
  std::uint8_t material;
};

template <class T>
void to_first(std::vector<T>& values, RankLink& link) {
  const std::vector<std::size_t> sizes = link.numbers_of_all(values.size());
  std::vector<T> all(link.first() ? std::accumulate(sizes.begin(), sizes.end(), std::size_t(0)) : 0);
  link.gather(values.data(), sizes, sizeof(T), all.data(), false);
  values = std::move(all);
}

void bring_together(PackingOutcome& packing, RankLink& link) {
  to_first(packing.particles.position, link);
  to_first(packing.particles.radius, link);
  for (auto& column : packing.particles.columns) to_first(column.second, link);
  packing.in_pieces = false;
}

/// What is no list is told by the first.
void tell_shape(PackedParticles& p, const RunRanks& ranks) {
  std::vector<double> shape{double(p.outline), p.container_volume};
  for (const Vec3& v : {p.axis, p.period}) shape.insert(shape.end(), v.begin(), v.end());
  shape = ranks.told(shape);
  p.outline = SpecimenShape::Outline(int(shape[0]));
  p.container_volume = shape[1];
  p.axis = Vec3(shape[2], shape[3], shape[4]);
  p.period = Vec3(shape[5], shape[6], shape[7]);
}

/// From the first rank to all, a little at a time: it never has them twice.
void deal_out(PackingOutcome& packing, std::vector<std::uint8_t>& material, RankLink& link) {
  PackedParticles& p = packing.particles;
  const std::size_t n = packing.count, ranks = std::size_t(link.ranks());
  const Slabs slabs(n, link.ranks());
  const std::size_t most = n / ranks + 1, at_once = std::max<std::size_t>(1, (std::size_t(1) << 20) / ranks);
  std::vector<Dealt> own;
  for (std::size_t begin = 0; begin < most; begin += at_once) {
    std::vector<std::vector<Dealt>> to(ranks);
    for (std::size_t r = 0; link.first() && r < ranks; ++r)
      for (std::size_t k = begin; k < std::min(begin + at_once, slabs.rows(int(r))); ++k) {
        const std::size_t of = slabs.first(int(r)) + k;
        to[r].push_back({p.position[of], p.radius[of], material.empty() ? std::uint8_t(0) : material[of]});
      }
    const std::vector<Dealt> some = sent(link, to);
    own.insert(own.end(), some.begin(), some.end());
  }
  p.position.clear();
  p.radius.clear();
  material.clear();
  for (const Dealt& d : own) {
    p.position.push_back(d.position);
    p.radius.push_back(d.radius);
    material.push_back(d.material);
  }
  p.columns.clear();
  packing.in_pieces = true;
}

}  // namespace

Materials deal_packing(PackingOutcome& packing, const Workflow& workflow, RankLink* link) {
  if (!link) return workflow.materials_of(packing.particles);
  const auto& way = workflow.material_of;
  if (packing.in_pieces && way && (way->shares || way->grains || way->column)) bring_together(packing, *link);
  Materials materials;
  MeetingParts(link).together([&] {
    if (packing.in_pieces || link->first()) materials = workflow.materials_of(packing.particles);
    else materials.list = workflow.material_list();
  });
  if (packing.in_pieces) return materials;
  tell_shape(packing.particles, RunRanks(link));
  deal_out(packing, materials.of_particle, *link);
  if (materials.list.size() == 1) materials.of_particle.clear();
  return materials;
}

}  // namespace breccia
