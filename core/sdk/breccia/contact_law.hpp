// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `contact_law`: the force between two particles.
///
/// A law is a small, trivially copyable struct over scalars, written once (see `plugins/contact_law/elastic_brittle`):
///
///   struct MyLaw {
///     struct Config { ... };  // what the workflow says, checked and documented
///     static void describe(Schema<Config>&);
///     struct State { double spring_x, spring_y, spring_z; };  // history of one pair, doubles only
///     static constexpr std::array columns{StateColumn<State>{&State::spring_x, "shear_spring_x", "m"}, ...};
///     MyLaw(const Config&, const Assembly&);  // derives constants, once
///     BRECCIA_KERNEL State initial(const Contact&) const;
///     BRECCIA_KERNEL ContactForce operator()(const Contact&, State&) const;  // no branches: ?: vectorises
///     BRECCIA_KERNEL double energy(const Contact&, const State&) const;      // stored, recoverable [J]
///     BRECCIA_KERNEL ContactStiffness stiffness(const Contact&) const;       // for the time step
///   };
///   BRECCIA_CONTACT_LAW(MyLaw, "my_law")
///
/// It may also say, as `static constexpr bool`: `has_moments` (false), `needs_mass` (false), `makes_bonds` (true; of a
/// list of laws only one may), `respects_protection` (false; true: bonds whose `breakable` is 0 are never damaged).
///
/// The loop over the pairs of a chunk is a template instantiated inside the plugin: one virtual call per 64 pairs.
#pragma once

#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "breccia/chunk_loop.hpp"
#include "breccia/contact.hpp"
#include "breccia/coulomb.hpp"
#include "breccia/plugin.hpp"
#include "breccia/views.hpp"

namespace breccia {

class BRECCIA_API ContactLaw : public Plugin {
 public:
  static constexpr const char* kind = "contact_law";
  struct ColumnDoc {
    std::string name, unit;
  };
  virtual std::vector<ColumnDoc> columns() const = 0;
  virtual bool has_moments() const = 0;
  virtual bool makes_bonds() const { return true; }  ///< of a list of laws only one may
  virtual bool needs_mass() const { return true; }
  virtual bool respects_protection() const { return false; }  ///< never damages a bond that a protocol protects
  virtual void prepare(const Assembly& assembly) = 0;         ///< once, before anything else
  /// `history` in all of these: one array per column, that of the chunk's pairs.
  virtual void initialise(const PairChunk& chunk, double* const* history) = 0;  ///< history of new pairs
  /// `adds`: to what the laws before in the list have answered; else writes.
  virtual void evaluate(const PairChunk& chunk, double* const* history, PairAnswer& answer, bool adds) = 0;
  virtual void stiffness(const PairChunk& chunk, ContactStiffness* of_pair) = 0;
  virtual void energy(const PairChunk& chunk, double* const* history, double* of_pair) = 0;  ///< stored [J]
  virtual Json derived() const { return Json::object(); }  ///< constants it derived, for the summary
};

/// Makes a plugin of a law struct.
template <class Law>
class ContactLawOf final : public ContactLaw {
  static_assert(std::is_trivially_copyable_v<Law>, "a law is copied into the step loop: keep containers in its Config");
  static constexpr auto all = std::make_index_sequence<Law::columns.size()>{};

 public:
  using Config = typename Law::Config;
  static void describe(Schema<Config>& s) { Law::describe(s); }
  explicit ContactLawOf(const Config& config) : config_(config) {}

  std::vector<ColumnDoc> columns() const override {
    std::vector<ColumnDoc> docs;
    for (const auto& c : Law::columns) docs.push_back({c.name, c.unit});
    return docs;
  }
  bool has_moments() const override { return detail::law_has_moments<Law>(); }
  bool makes_bonds() const override { return detail::law_makes_bonds<Law>(); }
  bool needs_mass() const override { return detail::law_needs_mass<Law>(); }
  bool respects_protection() const override { return detail::law_respects_protection<Law>(); }
  void prepare(const Assembly& assembly) override { law_.emplace(config_, assembly); }
  void initialise(const PairChunk& chunk, double* const* history) override {
    detail::for_each_contact(chunk, [&](const Contact& c, std::size_t k) {
      typename Law::State s = law_->initial(c);
      detail::store_state<Law>(s, history, k, all);
    });
  }
  void evaluate(const PairChunk& chunk, double* const* history, PairAnswer& answer, bool adds) override {
    adds ? detail::evaluate_chunk<Law, true>(*law_, chunk, history, answer)
         : detail::evaluate_chunk<Law, false>(*law_, chunk, history, answer);
  }
  void stiffness(const PairChunk& chunk, ContactStiffness* of_pair) override {
    detail::for_each_contact(chunk, [&](const Contact& c, std::size_t k) { of_pair[k] = law_->stiffness(c); });
  }
  void energy(const PairChunk& chunk, double* const* history, double* of_pair) override {
    detail::for_each_contact(chunk, [&](const Contact& c, std::size_t k) {
      typename Law::State s;
      detail::load_state<Law>(s, history, k, all);
      of_pair[k] = law_->energy(c, s);
    });
  }
  Json derived() const override {
    if constexpr (requires { law_->derived(); }) return law_->derived();
    else return Json::object();
  }

 private:
  Config config_;
  std::optional<Law> law_;
};

/// A vector kept in the contact plane (a tangential spring, a bending spring) follows the pair: it is turned into the
/// present plane and with the pair's mean spin about n. Second order in the step: a reflection at the plane normal to
/// the middle's normal takes what was normal to the old normal to what is normal to the new one, and keeps its length
/// (two reflections, of which the first, at the old plane, changes nothing, are the shortest rotation between the two).
struct PlaneVector {
  double x, y, z;
};
BRECCIA_KERNEL PlaneVector follow_plane(const Contact& c, double x, double y, double z) {
  const double twice = 2 * (x * c.mid_x + y * c.mid_y + z * c.mid_z);
  x -= twice * c.mid_x;
  y -= twice * c.mid_y;
  z -= twice * c.mid_z;
  const double along = x * c.nx + y * c.ny + z * c.nz;  // of higher order: what a stretch in the same step adds
  x -= along * c.nx;
  y -= along * c.ny;
  z -= along * c.nz;
  const double sine = c.spin, cosine = 1 - 0.5 * c.spin * c.spin;
  return {cosine * x + sine * (c.ny * z - c.nz * y), cosine * y + sine * (c.nz * x - c.nx * z),
          cosine * z + sine * (c.nx * y - c.ny * x)};
}

}  // namespace breccia

#define BRECCIA_CONTACT_LAW(Law, name) BRECCIA_PLUGIN(::breccia::ContactLawOf<Law>, "contact_law", name)
