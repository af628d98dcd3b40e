// SPDX-License-Identifier: BSD-3-Clause
#include "run/contact_laws.hpp"

#include <algorithm>

#include "config/distribution_spec.hpp"
#include "config/places.hpp"
#include "run/listed.hpp"

namespace breccia {
namespace {

/// Of a value in its written form, checked: `check_distribution`.
Distribution distribution_of(const Json& j, const ParamSpec& parameter) {
  const DistributionConfig c = load_distribution(j);
  Distribution d;
  switch (c.shape) {
    case DistributionShape::normal:
      d.shape = Distribution::Shape::normal;
      break;
    case DistributionShape::lognormal:
      d.shape = Distribution::Shape::lognormal;
      break;
    case DistributionShape::weibull:
      d.shape = Distribution::Shape::weibull;
      break;
    case DistributionShape::uniform:
      d.shape = Distribution::Shape::uniform;
      break;
  }
  d.mean = c.mean;
  d.modulus = c.modulus.value_or(0);
  d.deviation = c.standard_deviation.value_or(c.coefficient_of_variation.value_or(0) * c.mean);
  if (parameter.lower) d.lower = parameter.lower->value;
  if (parameter.upper) d.upper = parameter.upper->value;
  if (c.min) d.lower = c.min;
  if (c.max) d.upper = c.max;
  return d;
}

/// `section`: the path of what `config` was written as.
std::optional<Distribution> scatter_of(const Json& config, const ParamSpec& parameter, const std::string& section) {
  const auto value = config.find(parameter.name);
  if (value == config.end() || !value->is_object()) return std::nullopt;
  const Distribution d = distribution_of(*value, parameter);
  // Few draws would be left of what is cut away; and what is left would have another mean by far.
  if (d.share_within() < 0.5) {
    const std::string path = section + "." + parameter.name;
    throw AtPath(path, path + ": more than half of the distribution lies outside of what it may be; make it narrower");
  }
  return d;
}

}  // namespace

PluginStack with_means(PluginStack laws) {
  for (PluginChoice& law : laws.plugins)
    for (auto& [key, value] : law.config.items())
      if (value.is_object() && value.contains("distribution")) value = Json(value.at("mean"));
  return laws;
}

ContactLaws::ContactLaws(const Registry& registry, const PluginStack& choices, const std::vector<Material>& materials,
                         std::uint64_t seed) {
  const auto make = [&](const PluginChoice& c, const std::string& section) {
    return laws_.emplace_back(std::make_unique<GuardedLaw>(registry.create<ContactLaw>(c), c.type, section)).get();
  };
  const std::size_t n = materials.size();
  const auto number = [&](const Json& name) {
    return std::uint32_t(std::find_if(materials.begin(), materials.end(),
                                      [&](const Material& m) { return m.name == name.get<std::string>(); }) -
                         materials.begin());
  };
  for (std::size_t l = 0; l < choices.plugins.size(); ++l) {
    const PluginChoice& choice = choices.plugins[l];
    const std::string section = choices.plugins.size() == 1 ? "contact_law" : "contact_law[" + std::to_string(l) + "]";
    PluginChoice whole = choice;
    whole.config.erase("between");
    NamedLaw named{make(whole, section), result_label(choice)};
    named.seed = seed;
    std::vector<Json> config_of_kind(1, whole.config);
    std::vector<std::string> section_of_kind(1, section);
    if (choice.config.contains("between") && n > 1) {
      named.of_kind.assign(n * n, named.law);
      config_of_kind.assign(n * n, whole.config);
      section_of_kind.assign(n * n, section);
      for (std::size_t k = 0; k < choice.config["between"].size(); ++k) {
        const Json& item = choice.config["between"][k];
        Json own = item;
        own.erase("materials");
        const std::uint32_t a = number(item["materials"][0]), b = number(item["materials"][1]);
        const std::size_t kind = kind_of_pair(a, b, n);
        section_of_kind[kind] = section + ".between[" + std::to_string(k) + "]";
        named.of_kind[kind] = make({choice.type, own}, section_of_kind[kind]);
        config_of_kind[kind] = own;
      }
    }
    for (const ParamSpec& parameter : registry.documentation(ContactLaw::kind, choice.type).root.members) {
      if (!parameter.per_bond) continue;
      ScatteredParameter scattered{parameter.name, {}, parameter.unit};
      for (std::size_t k = 0; k < config_of_kind.size(); ++k)
        scattered.of_kind.push_back(scatter_of(config_of_kind[k], parameter, section_of_kind[k]));
      if (std::any_of(scattered.of_kind.begin(), scattered.of_kind.end(), [](const auto& d) { return d.has_value(); }))
        named.scatter.push_back(std::move(scattered));
    }
    named_.push_back(std::move(named));
  }
  try {
    (void)interactions();  // what it refuses is said here
  } catch (const UserError& e) { throw AtPath("contact_law", e.what()); }
}

Interactions ContactLaws::interactions() const { return Interactions(named_); }

bool ContactLaws::has_failed() const {
  return std::any_of(laws_.begin(), laws_.end(), [](const auto& law) { return law->has_failed(); });
}

std::string ContactLaws::column_name(std::size_t law, const std::string& column) const {
  return size() == 1 ? column : name(law) + "_" + column;
}

}  // namespace breccia
