// SPDX-License-Identifier: BSD-3-Clause
#include "run/contact_laws.hpp"

#include <algorithm>

namespace breccia {

ContactLaws::ContactLaws(const Registry& registry, const PluginStack& choices) {
  for (const PluginChoice& c : choices.plugins) {
    if (std::find(names_.begin(), names_.end(), c.type) != names_.end())
      throw UserError("contact_law: `" + c.type + "` stands twice in the list: its parameters can only have one value");
    laws_.push_back(registry.create<ContactLaw>(c));
    names_.push_back(c.type);
  }
  (void)interactions();  // what it refuses is said here
}

Interactions ContactLaws::interactions() const {
  std::vector<NamedLaw> named;
  for (std::size_t k = 0; k < laws_.size(); ++k) named.push_back({laws_[k].get(), names_[k]});
  return Interactions(std::move(named));
}

std::string ContactLaws::column_name(std::size_t law, const std::string& column) const {
  return laws_.size() == 1 ? column : names_[law] + "_" + column;
}

}  // namespace breccia
