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
/// A law whose parameters may scatter from bond to bond names them in `per_bond()`, see `PerBond`.
///
/// It may also say, as `static constexpr bool`: `has_moments` (false), `needs_mass` (false), `makes_bonds` (true; of a
/// list of laws only one may), `respects_protection` (false; true: bonds whose `breakable` is 0 are never damaged).
///
/// The loop over the pairs of a chunk is a template instantiated inside the plugin: one virtual call per 64 pairs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

#include "breccia/chunk_loop.hpp"
#include "breccia/contact.hpp"
#include "breccia/coulomb.hpp"
#include "breccia/law_checks.hpp"
#include "breccia/plugin.hpp"
#include "breccia/result_name.hpp"
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
  /// Where pairs of some materials have parameters of their own: the law of each kind of pair, all of this type and
  /// prepared. Not called when there is but one.
  virtual void take_kinds(std::span<ContactLaw* const> of_kind) { (void)of_kind; }
  /// Of the parameters that may, those that scatter: before `prepare`. The engine gives each a column behind those of
  /// `columns()`: the bond's value over the mean that the configuration has; 1 for pairs that are no bonds.
  virtual void scatter(const std::vector<std::string>& parameters) { (void)parameters; }
  /// `history` in all of these: one array per column, that of the chunk's pairs.
  virtual void initialise(const PairChunk& chunk, double* const* history) = 0;  ///< history of new pairs
  /// `adds`: to what the laws before in the list have answered; else writes.
  virtual void evaluate(const PairChunk& chunk, double* const* history, PairAnswer& answer, bool adds) = 0;
  virtual void stiffness(const PairChunk& chunk, double* const* history, ContactStiffness* of_pair) = 0;
  virtual void energy(const PairChunk& chunk, double* const* history, double* of_pair) = 0;  ///< stored [J]
  /// The law's answer to one pair of a chunk, by itself and whole: with moments even if it does not say that it has
  /// any. Moves the pair's history on. For `breccia check`.
  virtual ContactForce answer(const PairChunk& chunk, std::size_t k, double* const* history) = 0;
  virtual Results derived() const { return {}; }  ///< constants it derived, for the summary
};

/// Makes a plugin of a law struct.
template <class Law>
class ContactLawOf final : public ContactLaw {
  static_assert(std::is_trivially_copyable_v<Law>, "a law is copied into the step loop: keep containers in its Config");
  static_assert(detail::columns_cover_state<Law>(),
                "`columns` must name each member of State once, and State must hold doubles only: what is not named is "
                "lost after each step");
  static_assert(detail::column_names_differ<Law>(), "the names in `columns` must differ, and none may be empty");
  static constexpr auto all = std::make_index_sequence<Law::columns.size()>{};
  static constexpr std::size_t constants = detail::per_bond_count<Law>();

 public:
  using Config = typename Law::Config;
  static void describe(Schema<Config>& s) {
    Law::describe(s);
    if constexpr (constants > 0)
      for (const auto& c : Law::per_bond()) s.mark_per_bond(c.parameter);
    ParamSpec of;
    of.name = "materials";
    of.type = ParamType::text_list;
    of.min_items = of.max_items = 2;
    of.example = "[quartz, feldspar]";
    of.doc = "the two of a pair; the same twice: pairs within that material";
    s.changes("between", "what differs for pairs of certain materials", std::move(of));
  }
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
  void prepare(const Assembly& assembly) override {
    laws_.assign(1, Law(config_, assembly));
    if (!has_moments() && detail::fills_moments(laws_.front(), assembly.radius.empty() ? 1e-3 : assembly.radius[0]))
      throw UserError("it fills moments, which would be lost: say `static constexpr bool has_moments = true;`");
  }
  void take_kinds(std::span<ContactLaw* const> of_kind) override {
    std::vector<Law> laws;
    for (ContactLaw* law : of_kind) laws.push_back(static_cast<ContactLawOf*>(law)->laws_.front());
    laws_ = std::move(laws);
    table_ = detail::LawTable<Law>(laws_);
  }
  void scatter(const std::vector<std::string>& parameters) override {
    if constexpr (constants > 0) {
      scatters_ = !parameters.empty();
      for (std::size_t c = 0; c < constants; ++c) {
        const auto at = std::find(parameters.begin(), parameters.end(), Law::per_bond()[c].parameter);
        column_[c] = at == parameters.end() ? 0 : Law::columns.size() + std::size_t(at - parameters.begin());
      }
    }
  }
  void initialise(const PairChunk& chunk, double* const* history) override {
    detail::for_each_contact(chunk, [&](const Contact& c, std::size_t k) {
      typename Law::State s = laws_[kind(chunk, k)].initial(c);
      detail::store_state<Law>(s, history, k, all);
    });
  }
  void evaluate(const PairChunk& chunk, double* const* history, PairAnswer& answer, bool adds) override {
    if (scatters_ || (chunk.mixed && laws_.size() > 1)) {
      const detail::Variety<Law> v = variety(chunk, history);
      if (v.kind)
        adds ? detail::evaluate_varied<Law, true, true>(v, chunk, history, answer)
             : detail::evaluate_varied<Law, false, true>(v, chunk, history, answer);
      else
        adds ? detail::evaluate_varied<Law, true, false>(v, chunk, history, answer)
             : detail::evaluate_varied<Law, false, false>(v, chunk, history, answer);
    } else {
      const Law& law = laws_[kind(chunk, 0)];
      adds ? detail::evaluate_chunk<Law, true>(law, chunk, history, answer)
           : detail::evaluate_chunk<Law, false>(law, chunk, history, answer);
    }
  }
  void stiffness(const PairChunk& chunk, double* const* history, ContactStiffness* of_pair) override {
    for_each(chunk, history, [&](const Law& law, const Contact& c, std::size_t k) { of_pair[k] = law.stiffness(c); });
  }
  void energy(const PairChunk& chunk, double* const* history, double* of_pair) override {
    for_each(chunk, history, [&](const Law& law, const Contact& c, std::size_t k) {
      typename Law::State s;
      detail::load_state<Law>(s, history, k, all);
      of_pair[k] = law.energy(c, s);
    });
  }
  ContactForce answer(const PairChunk& chunk, std::size_t k, double* const* history) override {
    typename Law::State s;
    detail::load_state<Law>(s, history, k, all);
    const ContactForce f =
        detail::law_of(variety(chunk, history), k)(detail::contact_of<true>(chunk, k, chunk.time_step, 0.0), s);
    detail::store_state<Law>(s, history, k, all);
    return f;
  }
  Results derived() const override {
    if constexpr (requires(const Law& law) { law.derived(); }) return laws_.front().derived();
    else return {};
  }

 private:
  std::size_t kind(const PairChunk& chunk, std::size_t k) const {
    return laws_.size() == 1 ? 0 : chunk.kind[chunk.mixed ? k : 0];
  }
  detail::Variety<Law> variety(const PairChunk& chunk, double* const* history) const {
    static constexpr auto ones = [] {
      std::array<double, PairChunk::capacity> a{};
      a.fill(1.0);
      return a;
    }();
    detail::Variety<Law> v;
    v.of_kind = laws_.data();
    v.kind = laws_.size() > 1 && chunk.mixed ? chunk.kind : nullptr;
    if (!v.kind) v.of_kind += kind(chunk, 0);
    v.table = &table_;
    for (std::size_t c = 0; c < constants; ++c) v.factor[c] = column_[c] ? history[column_[c]] : ones.data();
    return v;
  }
  template <class F>
  void for_each(const PairChunk& chunk, double* const* history, F&& f) const {
    const detail::Variety<Law> v = variety(chunk, history);
    detail::for_each_contact(chunk, [&](const Contact& c, std::size_t k) { f(detail::law_of(v, k), c, k); });
  }

  Config config_;
  std::vector<Law> laws_;        ///< of each kind of pair, or the one for all
  detail::LawTable<Law> table_;  ///< the same, for the step loop; empty where there is but one
  bool scatters_ = false;
  std::array<std::size_t, constants + 1> column_{};  ///< of the factors of each constant; 0: none
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

#define BRECCIA_CONTACT_LAW(Law, name) \
  BRECCIA_PLUGIN(::breccia::ContactLawOf<::breccia::detail::LawOrNone<Law>>, "contact_law", name)
