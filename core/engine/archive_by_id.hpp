// SPDX-License-Identifier: BSD-3-Clause
/// Lists of a specimen in a checkpoint: particles in the order of the packing, pairs and bonds in that of the whole,
/// whatever the engine's order is. Of a specimen in parts each rank writes and reads its share of each list.
#pragma once

#include <optional>
#include <vector>

#include "breccia/archive.hpp"
#include "engine/dealt_lists.hpp"
#include "model/state.hpp"

namespace breccia {

inline std::vector<Index> inverse_of(const std::vector<Index>& id) {
  std::vector<Index> row(id.size());
  for (Index k = 0; k < id.size(); ++k) row[id[k]] = k;
  return row;
}

class SpecimenArchive {
 public:
  /// `particles` outlive this. `parts`: of a specimen in parts, else null; all ranks archive together then, each
  /// through an archive of its own, which has `SharedLists`.
  SpecimenArchive(Archive& archive, const Particles& particles, const Parts* parts)
      : archive_(archive),
        p_(particles),
        parts_(parts),
        shared_(parts ? dynamic_cast<SharedLists*>(&archive) : nullptr),
        row_(parts ? std::vector<Index>() : inverse_of(particles.id)) {
    BRECCIA_ASSERT(!parts || shared_);
  }
  Archive& plain() { return archive_; }
  bool reading() const { return archive_.reading(); }
  const Parts* parts() const { return parts_; }
  std::size_t size() const { return parts_ ? parts_->rows() : p_.size(); }  ///< particles of the whole

  /// A value for each particle.
  template <class T>
  void by_id(std::string_view name, Strided<T> values) {
    if (parts_) return by_id_of_parts(name, values);
    std::vector<T> ordered(p_.size());
    if (!reading())
      for (std::size_t k = 0; k < values.size(); ++k) ordered[p_.id[k]] = values[k];
    archive_(name, Strided<T>(ordered));
    if (reading())
      for (std::size_t k = 0; k < values.size(); ++k) values[k] = ordered[p_.id[k]];
  }
  /// One that is empty, or has a value for each particle.
  template <class T>
  void by_id(std::string_view name, std::vector<T>& values) {
    std::uint8_t there = !values.empty();
    archive_(std::string(name) + "_is_there", there);
    if (reading()) values.assign(there ? p_.size() : 0, T());
    if (there) by_id(name, Strided<T>(values));
  }

  /// Pairs or bonds of a part.
  struct Listed {
    std::size_t counted = 0;  ///< to be written: from where on those are that are counted here
    ListShare share;          ///< what they are of the whole
    ListDeal deal;            ///< to be read
  };
  Listed pairs, bonds;
  /// What is to be written of such a list: all ranks ask together.
  ListShare counted_share(std::size_t counted) const {
    const auto of_all = parts_->link().numbers_of_all(counted);
    ListShare share{0, counted, 0};
    for (std::size_t r = 0; r < of_all.size(); ++r) {
      if (r < std::size_t(parts_->link().rank())) share.first += of_all[r];
      share.total += of_all[r];
    }
    return share;
  }

  /// A value for each pair or bond; or of none of them.
  template <class T>
  void list(std::string_view name, std::vector<T>& values, const Listed& of) {
    if (!parts_) return archive_(name, values);
    if (reading()) {
      const std::vector<T> slab = read_slab<T>(name);
      const std::size_t total = shared_->total();
      if (total > 0) expect(name, total, of.deal.total());
      values = total > 0 ? of.deal(slab) : std::vector<T>();
      return;
    }
    if (!parts_->link().any(!values.empty())) return write_share(name, std::vector<T>(), ListShare{});
    std::vector<T> own(of.share.rows);
    if (!values.empty()) std::copy(values.begin() + std::ptrdiff_t(of.counted), values.end(), own.begin());
    write_share(name, std::move(own), of.share);
  }
  /// Numbers of particles: here rows of the whole, or where they stand in this part; in the file the packing's.
  void rows(std::string_view name, std::vector<Index>& numbers, const Listed& of) {
    if (parts_ && reading()) return;  // `find_rows` has read them
    std::vector<Index> ids;
    if (!reading()) ids = numbers_in_packing(numbers);
    list(name, ids, of);
    if (!reading()) return;
    numbers.clear();
    for (const Index k : ids) numbers.push_back(row_.at(k));
  }
  /// Of each pair its bond, or the other way round. Of a part that is read they are found anew.
  void links(std::string_view name, std::vector<Index>& to, const Listed& of, const Listed& others) {
    if (parts_ && reading()) return;
    if (!parts_) return archive_(name, to);
    std::vector<Index> places = to;
    static_assert(PairsView::no_bond == BondsView::no_pair);
    for (Index& k : places)
      if (k != PairsView::no_bond) k = Index(k - others.counted + others.share.first);
    list(name, places, of);
  }
  /// Several of them.
  template <class T>
  void lists(std::string_view name, std::vector<std::vector<T>>& columns, const Listed& of) {
    if (!parts_) return archive_(name, columns);
    const Archive::Group group(archive_, name);
    std::uint64_t size = columns.size();
    archive_("size", size);
    if (reading()) columns.resize(std::min<std::size_t>(size, columns.size()));
    for (std::size_t c = 0; c < size; ++c) {
      if (c == columns.size()) columns.emplace_back();  // where there is no more, reading ends
      list(std::to_string(c), columns[c], of);
    }
  }
  /// Of a part: rows of the whole of all pairs or bonds that have an own particle, in their order, and how the rest of
  /// them is to be dealt.
  void find_rows(std::vector<Index>& i, std::vector<Index>& j, Listed& of) {
    std::vector<Index> slab[2];
    std::size_t total = 0;
    for (const int end : {0, 1}) {
      const char* const name = end == 0 ? "i" : "j";
      const std::vector<Index> ids = read_slab<Index>(name);
      if (end == 0) total = shared_->total();
      expect(name, shared_->total(), total);
      slab[end] = order().rows_of(ids);
    }
    of.deal = ListDeal(*parts_, {&slab[0], &slab[1]}, total);
    i = of.deal(slab[0]);
    j = of.deal(slab[1]);
  }

  /// Near walls: particle, wall and what has come of their friction; of a part those of own particles. By wall, then by
  /// row.
  void touches(std::string_view name, std::vector<WallTouch>& of) {
    if (parts_) return touches_of_parts(name, of);
    archive_.records(name, of, std::pair("wall", &WallTouch::wall), std::pair("spring", &WallTouch::spring),
                     std::pair("force", &WallTouch::force), std::pair("overlap", &WallTouch::overlap));
    std::vector<Index> particles;
    for (const WallTouch& t : of) particles.push_back(t.particle);
    rows(std::string(name) + "_particles", particles, {});
    for (std::size_t k = 0; k < of.size(); ++k) of[k].particle = particles.at(k);
  }
  /// And which bonds they are of. Returns, of a part that is read, which of the whole's cracks stand here.
  std::vector<Index> cracks(Bonds& bonds);

  /// Records of own blocks, chunks or groups of them: as many as there are, on all ranks.
  template <class T>
  void own_records(std::string_view name, std::vector<T>& own) {
    if (!parts_) return archive_(name, own);
    const ListShare share = counted_share(own.size());
    if (!reading()) return write_share(name, own, share);
    std::vector<T> got;
    {
      const SharedLists::Rows rows(*shared_, share);
      archive_(name, got);
    }
    own.swap(got);
  }

 private:
  const PackingOrder& order() {
    if (!order_) order_.emplace(*parts_, p_);
    return *order_;
  }
  std::vector<Index> numbers_in_packing(const std::vector<Index>& of) const {
    std::vector<Index> ids;
    for (const Index k : of) ids.push_back(p_.id[k]);
    return ids;
  }
  static void expect(std::string_view name, std::size_t there, std::size_t wanted) {
    if (there != wanted)
      throw UserError("the checkpoint does not fit this program: " + std::string(name) + ": " + std::to_string(there) +
                      " values where " + std::to_string(wanted) + " belong");
  }
  template <class T>
  std::vector<T> read_slab(std::string_view name) {
    std::vector<T> slab;
    const SharedLists::Rows rows(*shared_, parts_->link().rank(), parts_->link().ranks());
    archive_(name, slab);
    return slab;
  }
  template <class T>
  void write_share(std::string_view name, std::vector<T> own, const ListShare& share) {
    const SharedLists::Rows rows(*shared_, share);
    archive_(name, own);
  }
  template <class T>
  void by_id_of_parts(std::string_view name, Strided<T> values) {
    const ListShare share = Slabs(parts_->rows(), parts_->link().ranks()).of(parts_->link().rank());
    std::vector<T> slab(share.rows);
    if (!reading()) {
      if (shared_->wants_values()) {
        std::vector<T> own;
        for (std::size_t a = p_.first_own(); a < p_.end_own(); ++a) own.push_back(values[a]);
        slab = order().to_slab(own);
      }
      return write_share(name, std::move(slab), share);
    }
    {
      const SharedLists::Rows rows(*shared_, share);
      archive_(name, Strided<T>(slab));
    }
    const std::vector<T> own = order().from_slab(slab);
    std::vector<T> all(p_.size());
    std::copy(own.begin(), own.end(), all.begin() + std::ptrdiff_t(p_.first_own()));
    parts_->link().forward(all);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = all[k];
  }
  /// Of records of which each rank has a slab the members named, as `Archive::records` has them.
  template <class Record, class... T>
  void slab_of_records(std::string_view name, std::vector<Record>& slab, std::size_t total,
                       std::pair<const char*, T Record::*>... members) {
    const Archive::Group group(archive_, name);
    std::uint64_t size = total;
    archive_("size", size);
    const auto member = [&]<class M>(const char* which, M Record::*of) {
      if (reading()) {
        const std::vector<M> values = read_slab<M>(which);
        expect(which, shared_->total(), size);
        slab.resize(values.size());
        for (std::size_t k = 0; k < values.size(); ++k) slab[k].*of = values[k];
        return;
      }
      std::vector<M> values;
      for (const Record& r : slab) values.push_back(r.*of);
      write_share(which, std::move(values), Slabs(size, parts_->link().ranks()).of(parts_->link().rank()));
    };
    (member(members.first, members.second), ...);
  }
  void touches_of_parts(std::string_view name, std::vector<WallTouch>& of);
  std::vector<std::size_t> places_of(const std::vector<WallTouch>& touches, std::size_t& total) const;

  Archive& archive_;
  const Particles& p_;
  const Parts* parts_;
  SharedLists* shared_;
  const std::vector<Index> row_;  ///< of each number of the packing
  std::optional<PackingOrder> order_;
};

}  // namespace breccia
