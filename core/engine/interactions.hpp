// SPDX-License-Identifier: BSD-3-Clause
/// The laws between particles, one after the other: their forces add up on each pair.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "breccia/contact_law.hpp"
#include "engine/distribution.hpp"
#include "engine/pair_batch.hpp"

namespace breccia {

/// A parameter that each bond draws for itself.
struct ScatteredParameter {
  std::string name;
  std::vector<std::optional<Distribution>> of_kind;  ///< by kind of pair; one for all, if one
  std::string unit = "1";
};

/// A law and what a user calls it. With several materials there is a kind of pair for each two of them, see
/// `kind_of_pair`.
struct NamedLaw {
  ContactLaw* law;  ///< outlives what uses it
  std::string name;
  std::vector<ContactLaw*> of_kind = {};  ///< where pairs of some kinds have parameters of their own, all kinds' laws
  std::vector<ScatteredParameter> scatter = {};
  std::uint64_t seed = 1;  ///< of what scatters
};

/// Which two of the materials they are, in either order.
constexpr std::uint32_t kind_of_pair(std::uint32_t a, std::uint32_t b, std::size_t materials) {
  const std::uint32_t low = a < b ? a : b, high = a < b ? b : a;
  return low * std::uint32_t(materials) + high;
}

/// What the bond of the two particles of these ids draws, over the distribution's mean: it depends on nothing else.
double drawn(const NamedLaw& law, const ScatteredParameter& parameter, const Distribution& distribution, Index a,
             Index b);

/// Gathers the pairs of a batch chunk by chunk, calls each law once for a chunk, and adds the answers to particles and
/// sums. Each law has its own columns of history, side by side in the order of the list.
class Interactions {
 public:
  /// UserError when two of them make bonds.
  explicit Interactions(std::vector<NamedLaw> laws);
  Interactions(ContactLaw& law, std::string name = "contact_law") : Interactions({NamedLaw{&law, std::move(name)}}) {}

  const std::vector<NamedLaw>& laws() const { return laws_; }
  std::size_t size() const { return laws_.size(); }
  std::string names() const;  ///< "`a` and `b`", for messages
  std::size_t columns() const { return columns_; }
  bool has_moments() const { return has_moments_; }
  bool makes_bonds() const { return makes_bonds_; }
  bool respects_protection() const { return respects_protection_; }  ///< the law that makes bonds does
  bool has_kinds() const { return has_kinds_; }                      ///< the forces of a pair depend on its materials

  void prepare(const Assembly& assembly);
  void initialise(const PairBatch& batch) const;  ///< history of new pairs
  void evaluate(const PairBatch& batch) const;
  void stiffness(const PairBatch& batch, ContactStiffness* out) const;  ///< out[k - begin], of all laws together
  double energy(const PairBatch& batch) const;                          ///< stored in the batch, in order [J]
  double energy(const PairBatch& batch, std::size_t law) const;         ///< of one law [J]

 private:
  void draw(const PairBatch& batch) const;

  std::vector<NamedLaw> laws_;
  std::vector<std::size_t> first_column_;
  std::size_t columns_ = 0;
  bool has_moments_ = false, makes_bonds_ = false, respects_protection_ = false, needs_mass_ = false,
       has_kinds_ = false;
};

}  // namespace breccia
