// SPDX-License-Identifier: BSD-3-Clause
/// The contact laws of a workflow, made from their plugins.
#pragma once

#include <memory>
#include <vector>

#include "engine/assembly.hpp"
#include "engine/interactions.hpp"
#include "engine/meeting_parts.hpp"
#include "plugin/registry.hpp"
#include "workflow/guarded_law.hpp"

namespace breccia {

/// The same with the means of what scatters: for a pair that stands for all.
PluginStack with_means(PluginStack laws);

class ContactLaws {
 public:
  /// UserError when two of them make bonds. `materials`: what `between` speaks of; `seed`: of what scatters.
  ContactLaws(const Registry& registry, const PluginStack& choices, const std::vector<Material>& materials = {{}},
              std::uint64_t seed = 1);

  Interactions interactions() const;  ///< for as long as this lives
  ContactLaw& law(std::size_t k) const { return *named_[k].law; }
  const NamedLaw& named(std::size_t k) const { return named_[k]; }
  const std::string& name(std::size_t law) const { return named_[law].name; }
  std::size_t size() const { return named_.size(); }

  /// From now on `within` is called on all ranks together. `others` outlives this.
  void meet(MeetingParts& others) { others_ = &others; }
  /// Around calls of the engine: what a law threw within comes out, on whichever rank, as a PluginFault of one text on
  /// all of them. It goes before what the engine makes of the numbers that the law did not give.
  template <class F>
  void within(F&& engine) {
    if (!others_ || !others_->link()) return here(engine);
    std::exception_ptr of_all;  // what else one rank meets alone (no memory), it cannot tell: the others are elsewhere
    try {
      engine();
    } catch (const UserError&) { of_all = std::current_exception(); }
    bool mine = false;
    try {
      others_->together([&] {
        mine = true;
        check();
        mine = false;
      });
    } catch (const UserError& e) {
      if (mine) throw;
      throw PluginFault(e.what());
    }
    if (of_all) std::rethrow_exception(of_all);
  }
  /// The same in a step, which has no message to spare: where there are several ranks, those go on together until
  /// somebody asks all of them for `has_failed` and calls `tell`.
  template <class F>
  void in_step(F&& engine) {
    if (!others_ || !others_->link()) return here(engine);
    try {
      engine();
    } catch (const UserError&) {  // on all ranks
      tell();
      throw;
    }
  }
  /// The same of what ranks do together after a step, each part of which they end together as well.
  template <class F>
  void in_row(F&& engine) {
    if (!others_ || !others_->link()) return here(engine);
    engine();
  }
  /// Throws on all ranks what a law has thrown on one.
  void tell() {
    within([] {});
  }
  bool has_failed() const;  ///< on this rank

  /// Name of a column of history: that of the law alone, and behind the law's name where there are several.
  std::string column_name(std::size_t law, const std::string& column) const;

 private:
  template <class F>
  void here(F&& engine) {
    try {
      engine();
    } catch (...) {
      check();
      throw;
    }
    check();
  }
  void check() {
    for (auto& law : laws_) law->check();
  }

  std::vector<std::unique_ptr<GuardedLaw>> laws_;  ///< with those for certain materials
  std::vector<NamedLaw> named_;
  MeetingParts* others_ = nullptr;
};

}  // namespace breccia
