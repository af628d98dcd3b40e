// SPDX-License-Identifier: BSD-3-Clause
/// The contact laws of a workflow, made from their plugins.
#pragma once

#include <memory>
#include <vector>

#include "engine/assembly.hpp"
#include "engine/interactions.hpp"
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

  /// Around calls of the engine: what a law threw within comes out. It goes before what the engine makes of the numbers
  /// that the law did not give.
  template <class F>
  void within(F&& engine) {
    try {
      engine();
    } catch (...) {
      check();
      throw;
    }
    check();
  }
  bool has_failed() const;

  /// Name of a column of history: that of the law alone, and behind the law's name where there are several.
  std::string column_name(std::size_t law, const std::string& column) const;

 private:
  void check() {
    for (auto& law : laws_) law->check();
  }

  std::vector<std::unique_ptr<GuardedLaw>> laws_;  ///< with those for certain materials
  std::vector<NamedLaw> named_;
};

}  // namespace breccia
