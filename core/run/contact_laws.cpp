// SPDX-License-Identifier: BSD-3-Clause
#include "run/contact_laws.hpp"

#include <algorithm>

#include "run/listed.hpp"

namespace breccia {
namespace {

/// Of a value in its written form, checked: `check_distribution`.
Distribution distribution_of(const Json& j, const ParamSpec& parameter) {
  Distribution d;
  const std::string shape = j.at("distribution");
  d.shape = shape == "weibull"     ? Distribution::Shape::weibull
            : shape == "lognormal" ? Distribution::Shape::lognormal
            : shape == "uniform"   ? Distribution::Shape::uniform
                                   : Distribution::Shape::normal;
  d.mean = j.at("mean");
  if (j.contains("modulus")) d.modulus = j["modulus"];
  if (j.contains("standard_deviation")) d.deviation = j["standard_deviation"];
  if (j.contains("coefficient_of_variation")) d.deviation = j["coefficient_of_variation"].get<double>() * d.mean;
  if (parameter.lower) d.lower = parameter.lower->value;
  if (parameter.upper) d.upper = parameter.upper->value;
  if (j.contains("min")) d.lower = j["min"].get<double>();
  if (j.contains("max")) d.upper = j["max"].get<double>();
  return d;
}

std::optional<Distribution> scatter_of(const Json& config, const ParamSpec& parameter, const std::string& law) {
  const auto value = config.find(parameter.name);
  if (value == config.end() || !value->is_object()) return std::nullopt;
  const Distribution d = distribution_of(*value, parameter);
  // Few draws would be left of what is cut away; and what is left would have another mean by far.
  if (d.share_within() < 0.5)
    throw UserError("contact_law " + law + ": " + parameter.name +
                    ": more than half of the distribution lies outside of what it may be; make it narrower");
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
  const auto make = [&](const PluginChoice& c) {
    return laws_.emplace_back(std::make_unique<GuardedLaw>(registry.create<ContactLaw>(c), c.type)).get();
  };
  const std::size_t n = materials.size();
  const auto number = [&](const Json& name) {
    return std::uint32_t(std::find_if(materials.begin(), materials.end(),
                                      [&](const Material& m) { return m.name == name.get<std::string>(); }) -
                         materials.begin());
  };
  for (const PluginChoice& choice : choices.plugins) {
    PluginChoice whole = choice;
    whole.config.erase("between");
    NamedLaw named{make(whole), result_label(choice)};
    named.seed = seed;
    std::vector<Json> config_of_kind(1, whole.config);
    if (choice.config.contains("between") && n > 1) {
      named.of_kind.assign(n * n, named.law);
      config_of_kind.assign(n * n, whole.config);
      for (const Json& item : choice.config["between"]) {
        Json own = item;
        own.erase("materials");
        const std::uint32_t a = number(item["materials"][0]), b = number(item["materials"][1]);
        named.of_kind[kind_of_pair(a, b, n)] = make({choice.type, own});
        config_of_kind[kind_of_pair(a, b, n)] = own;
      }
    }
    for (const ParamSpec& parameter : registry.documentation(ContactLaw::kind, choice.type).root.members) {
      if (!parameter.per_bond) continue;
      ScatteredParameter scattered{parameter.name, {}};
      for (const Json& config : config_of_kind) scattered.of_kind.push_back(scatter_of(config, parameter, choice.type));
      if (std::any_of(scattered.of_kind.begin(), scattered.of_kind.end(), [](const auto& d) { return d.has_value(); }))
        named.scatter.push_back(std::move(scattered));
    }
    named_.push_back(std::move(named));
  }
  (void)interactions();  // what it refuses is said here
}

Interactions ContactLaws::interactions() const { return Interactions(named_); }

bool ContactLaws::has_failed() const {
  return std::any_of(laws_.begin(), laws_.end(), [](const auto& law) { return law->has_failed(); });
}

std::string ContactLaws::column_name(std::size_t law, const std::string& column) const {
  return size() == 1 ? column : name(law) + "_" + column;
}

}  // namespace breccia
