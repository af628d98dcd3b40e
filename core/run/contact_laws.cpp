// SPDX-License-Identifier: BSD-3-Clause
#include "run/contact_laws.hpp"

#include <algorithm>

#include "run/listed.hpp"

namespace breccia {

ContactLaws::ContactLaws(const Registry& registry, const PluginStack& choices) {
  for (const PluginChoice& c : choices.plugins) {
    laws_.push_back(std::make_unique<GuardedLaw>(registry.create<ContactLaw>(c), c.type));
    names_.push_back(result_label(c));
  }
  (void)interactions();  // what it refuses is said here
}

Interactions ContactLaws::interactions() const {
  std::vector<NamedLaw> named;
  for (std::size_t k = 0; k < laws_.size(); ++k) named.push_back({laws_[k].get(), names_[k]});
  return Interactions(std::move(named));
}

bool ContactLaws::has_failed() const {
  return std::any_of(laws_.begin(), laws_.end(), [](const auto& law) { return law->has_failed(); });
}

std::string ContactLaws::column_name(std::size_t law, const std::string& column) const {
  return laws_.size() == 1 ? column : names_[law] + "_" + column;
}

}  // namespace breccia
