// SPDX-License-Identifier: BSD-3-Clause
#include "check/packing_cases.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "breccia/atomic_file.hpp"
#include "breccia/packing_tools/radius_distribution.hpp"
#include "check/example.hpp"
#include "check/made_specimen.hpp"
#include "config/problem.hpp"

namespace breccia {
namespace {

constexpr const char* range_of_radii = "{distribution: uniform, min: 0.5 mm, max: 0.9 mm}";

const ParamSpec* member(const ParamSpec& root, const std::string& name) {
  const auto it =
      std::find_if(root.members.begin(), root.members.end(), [&](const ParamSpec& p) { return p.name == name; });
  return it == root.members.end() ? nullptr : &*it;
}

/// Whether it is a container as Breccia's packings have it.
bool has_container(const ParamSpec& root) {
  const ParamSpec* p = member(root, "container");
  return p && p->type == ParamType::group && member(*p, "shape");
}

struct Form {
  const char* shape;
  const char* container;
  int dimension;
  bool periodic;
  const char* name;
};
constexpr Form forms[] = {
    {"box", "{shape: box, size: [8 mm, 7 mm, 10 mm]}", 3, false, "3D, box"},
    {"cylinder", "{shape: cylinder, diameter: 8.5 mm, height: 10 mm}", 3, false, "3D, cylinder"},
    {"sphere", "{shape: sphere, diameter: 10 mm}", 3, false, "3D, sphere"},
    {"box", "{shape: box, size: [20 mm, 30 mm]}", 2, false, "2D, box"},
    {"sphere", "{shape: sphere, diameter: 26 mm}", 2, false, "2D, disc"},
    {"box", "{shape: box, size: [8 mm, 7 mm, 10 mm]}", 3, true, "3D, box, periodic"},
    {"box", "{shape: box, size: [20 mm, 30 mm]}", 2, true, "2D, box, periodic"},
};

/// The particles of a form as a table, in millimetres; `repeats`: of a cell that repeats itself.
std::filesystem::path write_particles(const std::filesystem::path& folder, const Form& form, bool repeats) {
  const PackedParticles p = made_packing({"", form.dimension, SpecimenShape::Outline::box, repeats}, true);
  std::string text = "x,y,z,radius\n";
  for (std::size_t k = 0; k < p.radius.size(); ++k)
    text += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g}\n", 1e3 * p.position[k].x(), 1e3 * p.position[k].y(),
                        1e3 * p.position[k].z(), 1e3 * p.radius[k]);
  const std::filesystem::path file =
      folder / fmt::format("particles_{}{}.csv", form.dimension, repeats ? "_periodic" : "");
  write_file(file, text);
  return file;
}

std::optional<Container> container_of(const Json& config, int dimension) {
  if (!config.contains("container")) return {};
  Schema<ContainerConfig> schema;
  ContainerConfig::describe(schema);
  return schema.load(config["container"]).make(dimension);
}

/// `repeats`: the particles that it is given do, which they may also where the specimen does not.
std::optional<std::string> preset(const ParamSpec& p, const Form& form, bool fill, bool repeats,
                                  const std::filesystem::path& folder) {
  if (p.name == "container" && fill) return form.container;
  // Rather than a number of particles; so loose that small containers can be filled.
  if (p.name == "porosity") return form.dimension == 2 ? "0.24" : "0.48";
  if (p.type == ParamType::path && p.required && p.example.ends_with(".csv"))
    return "'" + write_particles(folder, form, repeats).string() + "'";
  if (p.name == "period" && p.type == ParamType::quantity_list) {
    if (!repeats) return {};
    const Vec3 length = made_packing({"", form.dimension, SpecimenShape::Outline::box, true}, true).period;
    return form.dimension == 2 ? fmt::format("[{} m, {} m]", length.x(), length.y())
                               : fmt::format("[{} m, {} m, {} m]", length.x(), length.y(), length.z());
  }
  if (p.name == "radius" && p.type == ParamType::group && member(p, "distribution")) return range_of_radii;
  if (p.type != ParamType::quantity || p.unit != "m") return {};
  if (p.name == "radius") return "0.7 mm";
  if (p.name == "radius_min") return "0.5 mm";
  if (p.name == "radius_max") return "0.9 mm";
  return {};
}

/// Of each parameter that is a choice without a default all values: each is one more `--set`.
std::vector<std::vector<std::string>> choices(const ParamSpec& root, const std::vector<std::string>& parameters) {
  std::vector<std::vector<std::string>> all = {{}};
  for (const ParamSpec& p : root.members) {
    if (p.type != ParamType::choice || !p.required || !p.fallback.is_null() || is_given(parameters, p.name)) continue;
    std::vector<std::vector<std::string>> longer;
    for (const auto& before : all)
      for (const Choice& c : p.choices) {
        longer.push_back(before);
        longer.back().push_back(p.name + "=" + c.name);
      }
    if (longer.size() > 24) return all;
    all = std::move(longer);
  }
  return all;
}

}  // namespace

std::vector<PackingWays> packing_cases(const Registry& registry, const std::string& name,
                                       const std::vector<std::string>& parameters, const std::filesystem::path& folder,
                                       std::vector<std::pair<std::string, std::string>>& refused) {
  const ParamSpec& root = registry.documentation(Packing::kind, name).root;
  const bool filled = has_container(root), own = is_given(parameters, "container");
  std::vector<PackingWays> all;
  for (const Form& form : forms) {
    // Without a container, or with the user's, it is asked once in each dimension, with walls and without.
    if ((!filled || own) && std::string_view(form.shape) != "box") continue;
    const std::string where =
        filled && !own ? form.name
                       : std::string(form.dimension == 2 ? "2D" : "3D") + (form.periodic ? ", periodic" : "");
    PackingWays ways;
    std::string why;
    const auto ask = [&](const std::vector<std::string>& choice, bool repeats) {
      std::vector<std::string> given = parameters;
      given.insert(given.end(), choice.begin(), choice.end());
      PackingCase c;
      try {
        c.choice = example_plugin(registry, Packing::kind, name, given,
                                  [&](const ParamSpec& p) { return preset(p, form, filled && !own, repeats, folder); });
        if (filled) c.container = container_of(c.choice.config, form.dimension);
      } catch (const ConfigError& e) {
        if (e.problems().front().file == "--set") throw;  // the user's, in every form
        why = e.problems().front().text;
        return;
      } catch (const UserError& e) {
        why = e.what();
        return;
      }
      c.form = c.name = where;
      for (const std::string& value : choice) c.name += ", " + value.substr(value.find('=') + 1);
      c.request.dimension = form.dimension;
      c.request.thickness = form.dimension == 2 ? 0.01 : 1;
      for (int k = 0; k < form.dimension; ++k) c.request.periodic[std::size_t(k)] = form.periodic;
      ways.push_back(std::move(c));
    };
    for (const auto& choice : choices(root, parameters)) {
      ask(choice, form.periodic);
      if (!form.periodic && member(root, "period")) ask(choice, true);
    }
    if (ways.empty()) refused.emplace_back(where, why);
    else all.push_back(std::move(ways));
  }
  return all;
}

std::optional<PackingCase> enlarged(const PackingCase& of, double factor) {
  if (!of.container) return {};
  PackingCase more = of;
  Json& container = more.choice.config["container"];
  for (const char* length : {"diameter", "height"})
    if (container.contains(length)) container[length] = factor * container[length].get<double>();
  if (container.contains("size"))
    for (Json& length : container["size"]) length = factor * length.get<double>();
  more.container = container_of(more.choice.config, of.request.dimension);
  return more;
}

std::optional<AskedRadii> asked_radii(const Json& config) {
  const auto number = [&](const char* name) -> std::optional<double> {
    return config.contains(name) && config[name].is_number() ? std::optional(config[name].get<double>()) : std::nullopt;
  };
  if (const auto radius = number("radius")) return AskedRadii{*radius, *radius, *radius, 0.0};
  if (const auto least = number("radius_min"), most = number("radius_max"); least && most)
    return AskedRadii{*least, *most, {}, {}};
  if (!config.contains("radius") || !config["radius"].is_object() || !config["radius"].contains("distribution"))
    return {};
  Schema<RadiusConfig> schema;
  RadiusConfig::describe(schema);
  const RadiusLaw law = schema.load(config["radius"]).law();
  return AskedRadii{law.min, law.max, law.mean, law.standard_deviation};
}

}  // namespace breccia
