// SPDX-License-Identifier: BSD-3-Clause
/// One declaration per parameter. `Schema<Config>` binds each member of a plain struct to its name, type,
/// unit, range, default, documentation and source; the type-erased `ParamSpec` tree that comes out of it
/// feeds parsing, checking, `describe`, the documentation and the JSON Schema.
///
///   struct Config { double friction; std::optional<double> strength; };
///   static void describe(Schema<Config>& s) {
///     s.param("friction", &Config::friction).unit("1").at_least(0).doc("Coulomb coefficient").fallback(0.5);
///     s.param("strength", &Config::strength).unit("Pa").above(0).doc("...");
///   }
///
/// The core turns the YAML text into a JSON value that already satisfies the spec (SI numbers, defaults
/// filled in); `Schema<Config>::load` only copies it into the struct.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "breccia/error.hpp"
#include "breccia/param_spec.hpp"
#include "breccia/si_unit.hpp"
#include "breccia/types.hpp"

namespace breccia {

/// Values by names that the user chooses, in the order of the workflow.
template <class T>
struct ByName : std::vector<std::pair<std::string, T>> {};

template <class T>
class Schema;

namespace detail {

template <class M>
struct is_optional : std::false_type {};
template <class M>
struct is_optional<std::optional<M>> : std::true_type {
  using inner = M;
};
template <class M>
struct is_vector : std::false_type {};
template <class M>
struct is_vector<std::vector<M>> : std::true_type {
  using inner = M;
};
template <class M>
struct is_by_name : std::false_type {};
template <class M>
struct is_by_name<ByName<M>> : std::true_type {
  using inner = M;
};
template <class M>
concept Described = requires(Schema<M>& s) {
  M::describe(s);
};

template <class M>
constexpr ParamType param_type() {
  if constexpr (is_optional<M>::value) return param_type<typename is_optional<M>::inner>();
  else if constexpr (std::is_same_v<M, bool>) return ParamType::boolean;
  else if constexpr (std::is_integral_v<M>) return ParamType::integer;
  else if constexpr (std::is_floating_point_v<M>) return ParamType::quantity;
  else if constexpr (std::is_enum_v<M>) return ParamType::choice;
  else if constexpr (std::is_same_v<M, std::string>) return ParamType::text;
  else if constexpr (std::is_same_v<M, std::filesystem::path>) return ParamType::path;
  else if constexpr (std::is_same_v<M, std::vector<double>> || std::is_same_v<M, Vec3>) return ParamType::quantity_list;
  else if constexpr (std::is_same_v<M, PluginChoice>) return ParamType::plugin;
  else if constexpr (std::is_same_v<M, std::vector<PluginChoice>>) return ParamType::plugin_list;
  else if constexpr (std::is_same_v<M, PluginStack>) return ParamType::plugin_stack;
  else if constexpr (std::is_same_v<M, Json>) return ParamType::free_form;
  else if constexpr (std::is_same_v<M, std::vector<std::string>>) return ParamType::text_list;
  else if constexpr (std::is_same_v<M, ByName<double>>) return ParamType::quantity_map;
  else if constexpr (is_by_name<M>::value) return ParamType::group_map;
  else if constexpr (is_vector<M>::value) return ParamType::group_list;
  else return ParamType::group;
}

template <class M>
void load_value(const Json& j, M& m);

}  // namespace detail

/// Chained after `Schema::param`; each call fills one field of the `ParamSpec`.
template <class M>
class ParamBuilder {
 public:
  ParamBuilder(std::vector<ParamSpec>& all, std::size_t at, std::map<std::string, long>* names)
      : all_(all), at_(at), names_(names) {}
  ParamBuilder& unit(SiUnit u) {
    spec().unit = u;
    return *this;
  }
  ParamBuilder& doc(std::string d) {
    spec().doc = std::move(d);
    return *this;
  }
  ParamBuilder& source(std::string s) {
    spec().source = std::move(s);
    return *this;
  }
  ParamBuilder& example(std::string e) {
    spec().example = std::move(e);
    return *this;
  }
  ParamBuilder& above(double v) {
    spec().lower = Bound{v, false};
    return *this;
  }
  ParamBuilder& at_least(double v) {
    spec().lower = Bound{v, true};
    return *this;
  }
  ParamBuilder& below(double v) {
    spec().upper = Bound{v, false};
    return *this;
  }
  ParamBuilder& at_most(double v) {
    spec().upper = Bound{v, true};
    return *this;
  }
  ParamBuilder& items(std::size_t low, std::size_t high) {
    spec().min_items = low;
    spec().max_items = high;
    return *this;
  }
  ParamBuilder& kind(std::string k) {
    spec().plugin_kind = std::move(k);
    return *this;
  }
  /// The value taken when the key is absent, in SI (for a choice: its name; for a group or list: JSON).
  ParamBuilder& fallback(Json v) {
    spec().fallback = std::move(v);
    spec().required = false;
    return *this;
  }
  /// One admissible name of an enumeration.
  template <class E>
  ParamBuilder& choice(std::string name, E value, std::string doc) {
    (*names_)[name] = static_cast<long>(value);
    spec().choices.push_back({std::move(name), std::move(doc)});
    return *this;
  }

 private:
  ParamSpec& spec() { return all_[at_]; }
  std::vector<ParamSpec>& all_;
  std::size_t at_;
  std::map<std::string, long>* names_;
};

template <class T>
class Schema {
 public:
  Schema() { doc_.root.type = ParamType::group; }

  Schema& summary(std::string s) {
    doc_.summary = std::move(s);
    return *this;
  }
  Schema& details(std::string s) {
    doc_.details = std::move(s);
    return *this;
  }
  Schema& source(std::string s) {
    doc_.source = std::move(s);
    return *this;
  }
  Schema& licence(std::string s) {
    doc_.licence = std::move(s);
    return *this;
  }
  Schema& exactly_one_of(std::vector<std::string> names) {
    doc_.root.exactly_one_of.push_back(std::move(names));
    return *this;
  }
  Schema& at_most_one_of(std::vector<std::string> names) {
    doc_.root.at_most_one_of.push_back(std::move(names));
    return *this;
  }
  Schema& removed(std::string name, std::string hint) {
    doc_.root.removed[std::move(name)] = std::move(hint);
    return *this;
  }

  /// Of a declared parameter: it may scatter from bond to bond. The law's kernel says so, see `PerBond`.
  Schema& mark_per_bond(const std::string& name) {
    const auto found = std::find_if(doc_.root.members.begin(), doc_.root.members.end(),
                                    [&](const ParamSpec& p) { return p.name == name; });
    BRECCIA_ASSERT(found != doc_.root.members.end() && found->type == ParamType::quantity);
    found->per_bond = true;
    return *this;
  }

  /// A list whose items change what was declared so far, for the case that `of` says. In the configuration each item
  /// is the whole section with its changes, and what `of` is.
  Schema& changes(std::string name, std::string doc, ParamSpec of) {
    ParamSpec list;
    list.name = std::move(name);
    list.type = ParamType::group_list;
    list.doc = std::move(doc);
    list.required = false;
    list.changes_section = true;
    list.members.push_back(std::move(of));
    for (ParamSpec p : doc_.root.members) {
      p.required = false;
      p.fallback = nullptr;
      list.members.push_back(std::move(p));
    }
    list.at_most_one_of = doc_.root.exactly_one_of;
    for (const auto& names : doc_.root.at_most_one_of) list.at_most_one_of.push_back(names);
    doc_.root.members.push_back(std::move(list));
    return *this;
  }

  /// Declares a parameter. A `std::optional` member may be left out; others need a value or a fallback.
  template <class M>
  ParamBuilder<M> param(std::string name, M T::*member) {
    ParamSpec p;
    p.name = name;
    p.type = detail::param_type<M>();
    p.required = !detail::is_optional<M>::value;
    describe_members<M>(p);
    if constexpr (std::is_same_v<M, Vec3>) p.min_items = p.max_items = 3;
    auto names = std::make_shared<std::map<std::string, long>>();
    loaders_.push_back([name, member, names](const Json& j, T& t) {
      const auto it = j.find(name);
      if (it == j.end() || it->is_null()) return;
      load_member<M>(*it, t.*member, *names);
    });
    doc_.root.members.push_back(std::move(p));
    return {doc_.root.members, doc_.root.members.size() - 1, names.get()};
  }
  /// Of a member that the configuration inherits.
  template <class M, class Base>
  requires(std::is_base_of_v<Base, T> && !std::is_same_v<Base, T>) ParamBuilder<M> param(std::string name,
                                                                                         M Base::*member) {
    return param(std::move(name), static_cast<M T::*>(member));
  }

  /// A rule between parameters, for what ranges cannot say; adds to the issues what is wrong.
  Schema& check(std::function<void(const T&, Issues&)> rule) {
    rules_.push_back(std::move(rule));
    return *this;
  }

  T load(const Json& j) const {
    T t{};
    for (const auto& f : loaders_) f(j, t);
    return t;
  }
  Issues check(const Json& j) const { return rules_on(load(j)); }
  Issues rules_on(const T& t) const {
    Issues issues;
    for (const auto& rule : rules_) rule(t, issues);
    return issues;
  }
  const Documentation& documentation() const { return doc_; }

 private:
  template <class M>
  static void describe_members(ParamSpec& p) {
    if constexpr (detail::is_optional<M>::value) {
      describe_members<typename detail::is_optional<M>::inner>(p);
    } else if constexpr (detail::Described<M>) {
      take_group<M>(p);
    } else if constexpr (detail::is_by_name<M>::value) {
      describe_members<typename detail::is_by_name<M>::inner>(p);
    } else if constexpr (detail::is_vector<M>::value) {
      if constexpr (detail::Described<typename M::value_type>) take_group<typename M::value_type>(p);
    }
  }
  template <class G>
  static void take_group(ParamSpec& p) {
    Schema<G> s;
    G::describe(s);
    const ParamSpec& r = s.documentation().root;
    p.members = r.members;
    p.exactly_one_of = r.exactly_one_of;
    p.at_most_one_of = r.at_most_one_of;
    p.removed = r.removed;
  }
  template <class M>
  static void load_member(const Json& j, M& m, const std::map<std::string, long>& names) {
    if constexpr (detail::is_optional<M>::value) {
      typename detail::is_optional<M>::inner v{};
      load_member(j, v, names);
      m = std::move(v);
    } else if constexpr (std::is_enum_v<M>) {
      m = static_cast<M>(names.at(j.get<std::string>()));
    } else {
      detail::load_value(j, m);
    }
  }

  Documentation doc_;
  std::vector<std::function<void(const Json&, T&)>> loaders_;
  std::vector<std::function<void(const T&, Issues&)>> rules_;
};

template <class M>
void detail::load_value(const Json& j, M& m) {
  if constexpr (std::is_same_v<M, std::filesystem::path>) {
    m = j.get<std::string>();
  } else if constexpr (std::is_same_v<M, Vec3>) {
    for (int k = 0; k < 3; ++k) m[k] = j.at(k).get<double>();
  } else if constexpr (std::is_same_v<M, PluginChoice>) {
    m.type = j.at("type").get<std::string>();
    m.config = j;
    m.config.erase("type");
  } else if constexpr (std::is_same_v<M, PluginStack>) {
    m.plugins.clear();
    for (const Json& one : j.is_array() ? j : Json::array({j})) load_value(one, m.plugins.emplace_back());
  } else if constexpr (std::is_same_v<M, Json>) {
    m = j;
  } else if constexpr (Described<M>) {
    Schema<M> s;
    M::describe(s);
    m = s.load(j);
  } else if constexpr (is_by_name<M>::value) {
    m.clear();
    for (const auto& [name, value] : j.items())
      load_value(value, m.emplace_back(name, typename M::value_type::second_type{}).second);
  } else if constexpr (std::is_floating_point_v<M>) {
    m = j.is_object() ? j.at("mean").template get<M>() : j.template get<M>();  // of a distribution
  } else if constexpr (is_vector<M>::value && !std::is_same_v<M, std::vector<double>> &&
                       !std::is_same_v<M, std::vector<std::string>>) {
    m.clear();
    for (const Json& e : j) load_value(e, m.emplace_back());
  } else {
    m = j.get<M>();
  }
}

}  // namespace breccia
