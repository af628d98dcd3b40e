// SPDX-License-Identifier: BSD-3-Clause
// Lists that are ordered by something else than particles: of walls, of time.
#include "engine/archive_by_id.hpp"

namespace breccia {

/// Where own touches stand in the list of the whole: by wall, of each wall by rank.
std::vector<std::size_t> SpecimenArchive::places_of(const std::vector<WallTouch>& touches, std::size_t& total) const {
  RankLink& link = parts_->link();
  std::size_t walls = 0;
  for (const WallTouch& t : touches) walls = std::max<std::size_t>(walls, t.wall + 1);
  walls = std::size_t(link.largest_of(double(walls)));
  std::vector<std::size_t> own(walls, 0);
  for (const WallTouch& t : touches) ++own[t.wall];
  const std::vector<std::size_t> all = parts_->gathered(own, true);
  std::vector<std::size_t> next(walls, 0), places;
  total = 0;
  for (std::size_t w = 0; w < walls; ++w)
    for (std::size_t r = 0; r < std::size_t(link.ranks()); ++r) {
      if (int(r) == link.rank()) next[w] = total;
      total += all[r * walls + w];
    }
  for (const WallTouch& t : touches) places.push_back(next[t.wall]++);
  return places;
}

void SpecimenArchive::touches_of_parts(std::string_view name, std::vector<WallTouch>& of) {
  std::vector<WallTouch> slab;
  std::size_t total = 0;
  if (!reading()) {
    const std::vector<std::size_t> places = places_of(of, total);
    for (const WallTouch& t : of) {
      slab.push_back(t);
      slab.back().particle = p_.id[t.particle];
    }
    slab = by_place(parts_->link(), places, slab, total);
  }
  slab_of_records(name, slab, total, std::pair("wall", &WallTouch::wall), std::pair("spring", &WallTouch::spring),
                  std::pair("force", &WallTouch::force), std::pair("overlap", &WallTouch::overlap));
  const std::string particles = std::string(name) + "_particles";
  if (!reading()) {
    std::vector<Index> ids;
    for (const WallTouch& t : slab) ids.push_back(t.particle);
    const Slabs slabs(total, parts_->link().ranks());
    return write_share(particles, std::move(ids), slabs.of(parts_->link().rank()));
  }
  total = shared_->total();
  const std::vector<Index> ids = read_slab<Index>(particles);
  expect(particles, shared_->total(), total);
  const std::vector<Index> rows = order().rows_of(ids);
  for (std::size_t k = 0; k < slab.size(); ++k) slab[k].particle = rows[k];
  of = ListDeal(*parts_, {&rows}, total)(slab);
  for (WallTouch& t : of) t.particle = Parts::here(p_, t.particle);
}

std::vector<Index> SpecimenArchive::cracks(Bonds& b) {
  const auto members = [&](auto&& f) {
    f(std::pair("time", &Crack::time), std::pair("position", &Crack::position), std::pair("normal", &Crack::normal),
      std::pair("energy", &Crack::energy));
  };
  if (!parts_) {
    list("crack_of", b.crack_of, bonds);
    members([&](auto... m) { archive_.records("cracks", b.cracks, m...); });
    return {};
  }
  RankLink& link = parts_->link();
  std::vector<Crack> slab;
  if (!reading()) {
    const Parts::CrackPlaces own = parts_->crack_places(b, p_);
    std::vector<Index> place_of(b.size(), BondsView::no_crack);
    for (std::size_t k = 0; k < own.bond.size(); ++k) {
      place_of[own.bond[k]] = Index(own.place[k]);
      slab.push_back(b.cracks[b.crack_of[own.bond[k]]]);
    }
    list("crack_of", place_of, bonds);
    slab = by_place(link, own.place, slab, own.total);
    members([&](auto... m) { slab_of_records("cracks", slab, own.total, m...); });
    return {};
  }
  list("crack_of", b.crack_of, bonds);
  members([&](auto... m) { slab_of_records("cracks", slab, 0, m...); });
  const Slabs slabs(shared_->total(), link.ranks());
  std::vector<std::size_t> kept;
  for (const Index c : b.crack_of)
    if (c != BondsView::no_crack) kept.push_back(c);
  std::sort(kept.begin(), kept.end());
  if (link.any(!kept.empty() && kept.back() >= slabs.total()))
    throw UserError("the checkpoint does not fit this program: a bond has a crack that there is not");
  b.cracks = at_places(link, kept, slab, slabs);
  for (Index& c : b.crack_of)
    if (c != BondsView::no_crack) c = Index(std::lower_bound(kept.begin(), kept.end(), c) - kept.begin());
  return {kept.begin(), kept.end()};
}

}  // namespace breccia
