// SPDX-License-Identifier: BSD-3-Clause
/// The contact laws of a workflow, made from their plugins.
#pragma once

#include <memory>
#include <vector>

#include "engine/interactions.hpp"
#include "plugin/registry.hpp"

namespace breccia {

class ContactLaws {
 public:
  /// UserError when two of a kind are asked for, or two that make bonds.
  ContactLaws(const Registry& registry, const PluginStack& choices);

  Interactions interactions() const;  ///< for as long as this lives
  const std::vector<std::unique_ptr<ContactLaw>>& laws() const { return laws_; }
  const std::string& name(std::size_t law) const { return names_[law]; }
  std::size_t size() const { return laws_.size(); }
  /// Name of a column of history: that of the law alone, and behind the law's name where there are several.
  std::string column_name(std::size_t law, const std::string& column) const;

 private:
  std::vector<std::unique_ptr<ContactLaw>> laws_;
  std::vector<std::string> names_;
};

}  // namespace breccia
