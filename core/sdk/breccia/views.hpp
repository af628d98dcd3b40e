// SPDX-License-Identifier: BSD-3-Clause
/// What a plugin may see of the simulation: read-only spans, in SI units. Index order is the engine's
/// (spatial); `ParticlesView::id` gives the order of the packing. Spans live until the call returns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "breccia/exact_sum.hpp"
#include "breccia/space.hpp"
#include "breccia/strided.hpp"

namespace breccia {

/// Where a specimen stands and how large it is, as measured from its particles when loading begins.
struct SpecimenShape {
  enum class Outline {
    cylinder,
    box,
    ellipsoid,  ///< a sphere before loading
    irregular   ///< whatever the container was: its volume was given, the cross-section is volume/height
  };
  Outline outline = Outline::cylinder;
  Vec3 base = Vec3::Zero();    ///< centre of the lower end face [m]
  Vec3 axis = Vec3::UnitZ();   ///< unit vector from the lower to the upper end
  double height = 0;           ///< along the axis [m]
  Vec3 extent = Vec3::Zero();  ///< of the bounding box along x, y, z; for a cylinder 2R in the two cross directions [m]
  double cross_section_area =
      0;              ///< normal to the axis, the largest there is [m2]; in two dimensions width x thickness
  double volume = 0;  ///< [m3]
};

struct ParticlesView {
  Strided<const Vec3> position, velocity, angular_velocity, initial_position;  // [m], [m/s], [rad/s], [m]
  Strided<const Vec3> force, torque;    ///< undamped resultants at the current positions [N], [N m]
  std::span<const Vec3> applied_force;  ///< by the protocol; empty when there is none [N]
  /// Of the applied force and of the force that holds a particle: (point where it acts - centre) (x) force [N m]; empty
  /// when there is none.
  std::span<const Mat3> boundary_moment;
  Strided<const double> radius, mass;      // [m], [kg]
  std::span<const std::uint8_t> held;      ///< velocity components that follow the protocol or the plane: bits of `dof`
  std::span<const Index> id;               ///< number in the packing
  std::span<const std::uint8_t> material;  ///< row of `SimulationView::materials`; empty when there is but one
  std::size_t size() const { return radius.size(); }
};

/// What a pair does to its two particles, at the point half-way between their surfaces.
struct alignas(32) PairForce {
  double fx, fy, fz;  ///< force on particle i; minus this on j [N]
  double half_gap;    ///< (distance - r_i - r_j)/2: the lever arms are r + half_gap [m]
};

/// Pairs that the engine follows now: intact bonds, contacts, and neighbours that may touch soon.
struct PairsView {
  std::span<const Index> i, j;          ///< i < j
  std::span<const double> rest_length;  ///< centre distance without force [m]
  std::span<const BondState> state;
  std::span<const Index> bond;  ///< its row in BondsView, or no_bond
  std::span<const PairForce> force;
  std::span<const Vec3> moment;                  ///< on i, minus this on j [N m]; empty unless the law has moments
  std::vector<std::span<const double>> columns;  ///< the law's history, one per `ContactLaw::columns()`
  std::size_t size() const { return i.size(); }
  static constexpr Index no_bond = 0xffffffffu;
};

/// Where and when a bond broke.
struct Crack {
  double time;        // [s]
  Vec3 position;      ///< contact point [m]
  Vec3 normal;        ///< unit vector i to j
  double energy = 0;  ///< that the bond released as it broke, in one step or bit by bit: its part of the ledger's
                      ///< `fracture` [J]
};

/// Every bond made at the start, whatever became of it.
struct BondsView {
  std::span<const Index> i, j;
  std::span<const double> initial_distance;  ///< centre distance when it was made [m]
  std::span<const BondState> state;
  std::span<const Index> pair;      ///< its row in PairsView, or no_pair when it broke and parted
  std::span<const Index> crack_of;  ///< row in `cracks`, or no_crack while it is intact
  std::span<const Crack> cracks;    ///< in the order in which they came
  std::size_t size() const { return i.size(); }
  const Crack* crack(std::size_t bond) const { return crack_of[bond] == no_crack ? nullptr : &cracks[crack_of[bond]]; }
  static constexpr Index no_pair = 0xffffffffu, no_crack = 0xffffffffu;
};

struct WallView {
  std::string name;
  Vec3 point, normal;  ///< of a plane: a point [m] and the unit vector toward the specimen; of a cylinder: its axis
  Vec3 velocity, displacement;  // [m/s], [m]
  Vec3 force;                   ///< of the particles on the wall [N]
  double normal_force;          ///< sum of the particles' normal forces on it, whatever their directions [N]
  double cylinder_radius;       ///< 0: a plane [m]
  std::size_t contacts = 0;     ///< particles that press on it
};

/// One particle pressing on one wall.
struct WallContact {
  Index particle, wall;
  Vec3 point;  ///< where it touches [m]
  Vec3 force;  ///< on the particle [N]
};

/// Where the boundary work went, since the start of loading [J].
struct EnergyLedger {
  double initial = 0;        ///< elastic and kinetic, when loading began
  double boundary_work = 0;  ///< done by walls, prescribed motion and applied forces on the particles
  double elastic = 0;        ///< stored now in pairs and wall contacts
  double kinetic = 0;        ///< now
  double friction = 0;       ///< dissipated by sliding, of pairs and walls
  double damping = 0;        ///< dissipated by the non-viscous damping
  double contact = 0;        ///< dissipated otherwise in contacts (viscous, plastic)
  double fracture = 0;       ///< released by breaking bonds
  double accounted() const { return elastic + kinetic + friction + damping + contact + fracture; }
  double error() const { return initial + boundary_work - accounted(); }
};

/// OwnRows of a list that stand side by side: `for (const std::size_t k : view.own_pairs())`.
class OwnRows {
 public:
  class Iterator {
   public:
    explicit Iterator(std::size_t row) : row_(row) {}
    std::size_t operator*() const { return row_; }
    Iterator& operator++() {
      ++row_;
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    std::size_t row_;
  };

  OwnRows() = default;
  OwnRows(std::size_t first, std::size_t behind) : first_(first), behind_(behind) {}
  Iterator begin() const { return Iterator(first_); }
  Iterator end() const { return Iterator(behind_); }
  std::size_t first() const { return first_; }
  std::size_t behind() const { return behind_; }  ///< the row after the last
  std::size_t size() const { return behind_ - first_; }
  bool contain(std::size_t row) const { return row >= first_ && row < behind_; }

 private:
  std::size_t first_ = 0, behind_ = 0;
};

/// Those who see the other parts of the same specimen, each on a rank of its own. All call the same functions in the
/// same order with as many numbers; each waits for the others. Throws where one of them cannot go on.
class OtherParts {
 public:
  virtual void add(std::span<ExactSum> sums) = 0;       ///< each becomes that of all parts
  virtual void largest(std::span<double> numbers) = 0;  ///< each becomes the largest of all parts; no NaN
  /// The records of all parts, one after the other; of each as many as it likes.
  virtual std::vector<std::byte> all(std::span<const std::byte> own, std::size_t record_bytes) = 0;

 protected:
  ~OtherParts() = default;
};

/// What `SimulationView` shows when it is one part of a specimen that several ranks share. Its lists hold what belongs
/// to this rank and copies of what others have and these meet: of an own particle all pairs, bonds and wall contacts
/// are there. Each particle, pair and bond of the specimen counts in one part, a pair or bond in that of its lower
/// particle. Of a copied particle there are motion, reference position and constants; forces on it are not whole.
/// Wall contacts are those of own particles; `cracks` stand in no order of time. What is no list (walls, ledger,
/// specimen, cell) is that of the whole.
struct PartOfSpecimen {
  OtherParts* others = nullptr;
  OwnRows particles, pairs, bonds;  ///< that count here
  int number = 0, count = 1;        ///< of this part, from 0 on; how many there are
  Index first_row = 0;              ///< of the first own particle, in the whole: own ones stand side by side there, too
};

inline constexpr std::size_t particle_block = 256;  ///< of the engine

/// What one may ask over the whole specimen, of which this shows all or a part.
struct SeenInPart {
  std::optional<PartOfSpecimen> part;  ///< none: this is all of it
  /// So many particles, in the order of their rows, never come apart: parts are made of such blocks. See `BlockSum`.
  std::size_t block = particle_block;

  /// Over the whole specimen, of terms that each part has added for what counts in it: the same bits for any number of
  /// parts. Several in one go cost one message:
  ///
  ///     ExactSumOf<Mat3> moments;
  ///     ExactSumOf<std::size_t> touching;
  ///     for (const std::size_t k : view.own_pairs()) ...
  ///     const auto [sum, count] = view.sum(moments, touching);
  ///
  /// All parts ask alike; see `OtherParts`.
  template <class... T>
  auto sum(const ExactSumOf<T>&... of) const {
    std::vector<ExactSum> all;
    (all.insert(all.end(), of.sums().begin(), of.sums().end()), ...);
    const std::vector<double> values = sums(all);
    const double* at = values.data();
    const auto take = [&]<class Of>(const ExactSumOf<Of>&) {
      at += ExactSumOf<Of>::size;
      return ExactSumOf<Of>::of(at - ExactSumOf<Of>::size);
    };
    if constexpr (sizeof...(T) == 1) return (take(of), ...);
    else return std::tuple<T...>{take(of)...};
  }
  /// The same of as many as there are.
  std::vector<double> sums(std::span<ExactSum> of) const {
    if (part && part->others) part->others->add(of);
    std::vector<double> values;
    for (const ExactSum& s : of) values.push_back(s.value());
    return values;
  }
  /// The largest of all parts' numbers; no NaN.
  double max(double number) const {
    if (part && part->others) part->others->largest({&number, 1});
    return number;
  }
  void max(std::span<double> numbers) const {
    if (part && part->others) part->others->largest(numbers);
  }
  /// Records of all parts, for few of them. Those of own rows, in their order, come in the order of the whole.
  template <class T>
  std::vector<T> all(const std::vector<T>& own) const {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!part || !part->others) return own;
    const std::vector<std::byte> bytes = part->others->all(std::as_bytes(std::span(own)), sizeof(T));
    std::vector<T> records(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(records.data()), bytes.data(), bytes.size());
    return records;
  }
};

struct SimulationView : Space, SeenInPart {
  double time = 0, time_step = 0;  // [s]
  std::uint64_t step = 0;
  ParticlesView particles;
  PairsView pairs;
  BondsView bonds;
  std::span<const WallView> walls;
  std::span<const WallContact> wall_contacts;
  std::span<const std::string> materials;  ///< their names, one at the least
  SpecimenShape specimen;
  EnergyLedger energy;
  Cell initial_cell;  ///< at the start of loading
  /// Branch vector of two particles at the start of loading [m].
  Vec3 initial_branch(Index i, Index j) const {
    return Space{dimension, thickness, initial_cell}.branch(particles.initial_position[i],
                                                            particles.initial_position[j]);
  }

  // What counts here: all there is, unless this is a part.
  OwnRows own_particles() const { return part ? part->particles : OwnRows(0, particles.size()); }
  OwnRows own_pairs() const { return part ? part->pairs : OwnRows(0, pairs.size()); }
  OwnRows own_bonds() const { return part ? part->bonds : OwnRows(0, bonds.size()); }
  /// Of an own particle; by these rows protocols name particles.
  Index row_in_whole(std::size_t own) const {
    return part ? Index(own - part->particles.first()) + part->first_row : Index(own);
  }
  /// The other way round, of some rows of the whole in ascending order: those that are own particles, as rows here.
  /// Calls `f(k, row here)` with the place of each in `rows`.
  template <class F>
  void for_each_own(std::span<const Index> rows, F&& f) const {
    const OwnRows own = own_particles();
    const Index first = part ? part->first_row : 0, behind = Index(first + own.size());
    for (auto at = std::lower_bound(rows.begin(), rows.end(), first); at != rows.end() && *at < behind; ++at)
      f(std::size_t(at - rows.begin()), std::size_t(*at - first) + own.first());
  }
};

/// "feldspar-quartz" for each two materials that have bonds: `f(name, bonds)` with the rows of these in `bonds`. Not
/// called where there is but one material.
template <class F>
void for_each_pair_of_materials(const SimulationView& view, F&& f) {
  const auto& of = view.particles.material;
  if (of.empty()) return;
  const std::size_t n = view.materials.size();
  std::vector<std::vector<std::size_t>> rows(n * n);
  for (std::size_t b = 0; b < view.bonds.size(); ++b) {
    const std::size_t p = of[view.bonds.i[b]], q = of[view.bonds.j[b]];
    rows[p < q ? p * n + q : q * n + p].push_back(b);
  }
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!rows[k].empty()) f(view.materials[k / n] + "-" + view.materials[k % n], rows[k]);
}

}  // namespace breccia
