// SPDX-License-Identifier: BSD-3-Clause
/// Mistakes in a contact law that the compiler can find, each as one line that says what to mend.
#pragma once

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "breccia/contact.hpp"
#include "breccia/schema.hpp"

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "a contact law cannot be compiled with -ffast-math: results would depend on the compiler and the machine"
#endif

namespace breccia::detail {

template <class Law>
concept SaysConfig = requires {
  typename Law::Config;
};
template <class Law>
concept SaysState = requires {
  typename Law::State;
};
template <class Law>
concept Describes = requires(Schema<typename Law::Config>& s) {
  Law::describe(s);
};
template <class Law>
concept SaysColumns = requires {
  { Law::columns.size() } -> std::convertible_to<std::size_t>;
  { Law::columns.data()->member } -> std::convertible_to<double Law::State::*>;
};
template <class Law>
concept IsMade = std::is_constructible_v<Law, const typename Law::Config&, const Assembly&>;
template <class Law>
concept Begins = requires(const Law& law, const Contact& c) {
  { law.initial(c) } -> std::same_as<typename Law::State>;
};
template <class Law>
concept Answers = requires(const Law& law, const Contact& c, typename Law::State& s) {
  { law(c, s) } -> std::same_as<ContactForce>;
};
template <class Law>
concept Stores = requires(const Law& law, const Contact& c, const typename Law::State& s) {
  { law.energy(c, s) } -> std::convertible_to<double>;
};
template <class Law>
concept IsStiff = requires(const Law& law, const Contact& c) {
  { law.stiffness(c) } -> std::same_as<ContactStiffness>;
};

/// Whether a struct has what makes it a law; a compiler names each part that is missing.
template <class Law>
struct Complete {
  static_assert(SaysConfig<Law>, "the law lacks `struct Config`: what a workflow says of it");
  static_assert(!SaysConfig<Law> || Describes<Law>,
                "the law lacks `static void describe(breccia::Schema<Config>&)`: its parameters");
  static_assert(SaysState<Law>, "the law lacks `struct State`: the history of one pair, doubles only");
  static_assert(!SaysState<Law> || SaysColumns<Law>,
                "the law lacks `static constexpr std::array columns{breccia::StateColumn<State>{...}, ...}`");
  static_assert(!SaysConfig<Law> || IsMade<Law>,
                "the law lacks a constructor from `const Config&` and `const breccia::Assembly&`");
  static_assert(!SaysState<Law> || Begins<Law>,
                "the law lacks `State initial(const breccia::Contact&) const`: the history of a new pair");
  static_assert(!SaysState<Law> || Answers<Law>,
                "the law lacks `breccia::ContactForce operator()(const breccia::Contact&, State&) const`: its force");
  static_assert(!SaysState<Law> || Stores<Law>,
                "the law lacks `double energy(const breccia::Contact&, const State&) const`: what it stores");
  static_assert(
      IsStiff<Law>,
      "the law lacks `breccia::ContactStiffness stiffness(const breccia::Contact&) const`: for the time step");
  static constexpr bool value = SaysConfig<Law> && SaysState<Law> && Describes<Law> && SaysColumns<Law> &&
                                IsMade<Law> && Begins<Law> && Answers<Law> && Stores<Law> && IsStiff<Law>;
};

/// In place of a law that is not complete, so that nothing else is said of it.
struct NoLaw {
  struct Config {};
  static void describe(Schema<Config>&) {}
  struct State {};
  static constexpr std::array<StateColumn<State>, 0> columns{};
  NoLaw(const Config&, const Assembly&) {}
  State initial(const Contact&) const { return {}; }
  ContactForce operator()(const Contact&, State&) const { return {}; }
  double energy(const Contact&, const State&) const { return 0; }
  ContactStiffness stiffness(const Contact&) const { return {}; }
};
template <class Law>
using LawOrNone = std::conditional_t<Complete<Law>::value, Law, NoLaw>;

template <class Law>
constexpr bool columns_cover_state() {
  constexpr std::size_t n = Law::columns.size();
  if constexpr (std::is_empty_v<typename Law::State>) return n == 0;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (Law::columns[a].member == Law::columns[b].member) return false;
  return sizeof(typename Law::State) == n * sizeof(double);
}
template <class Law>
constexpr bool column_names_differ() {
  for (std::size_t a = 0; a < Law::columns.size(); ++a) {
    if (std::string_view(Law::columns[a].name).empty()) return false;
    for (std::size_t b = 0; b < a; ++b)
      if (std::string_view(Law::columns[a].name) == Law::columns[b].name) return false;
  }
  return true;
}

/// Whether a law answers with a moment to pairs that roll, bend and twist, bonded or pressed on each other.
template <class Law>
bool fills_moments(const Law& law, double radius) {
  for (const double intact : {1.0, 0.0}) {
    Contact c{};
    c.radius_i = radius;
    c.radius_j = 0.8 * radius;
    c.rest_length = c.touching();
    c.distance = 0.999 * c.rest_length;
    c.nz = c.mid_z = 1;
    c.intact = c.breakable = intact;
    c.shear_x = 1e-4 * radius;
    c.turn_x = c.turn_z = 1e-4;
    c.reduced_mass = c.time_step = 1;
    typename Law::State s = law.initial(c);
    c.normal_force = -1;
    const ContactForce f = law(c, s);
    if (f.moment_x != 0 || f.moment_y != 0 || f.moment_z != 0) return true;
  }
  return false;
}

}  // namespace breccia::detail
