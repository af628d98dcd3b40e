// SPDX-License-Identifier: BSD-3-Clause
// From what a user asks for to what is driven.
#include <algorithm>

#include "breccia/text_file.hpp"
#include "config/reader.hpp"
#include "config/units.hpp"
#include "drive/drive.hpp"
#include "plugin/drawing.hpp"
#include "run/load_workflow.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// What of a workflow matters to a single pair.
struct PairConfig {
  PluginStack contact_law;
  MaterialConfig material;
  long dimension;
  double thickness;
};

bool is_workflow(const std::string& target) {
  const fs::path path = target;
  return fs::exists(path) || path.has_parent_path() || has_ending(path, ".yaml") || has_ending(path, ".yml");
}

PairConfig read_target(const DriveRequest& a, Registry& registry, Host& host) {
  if (is_workflow(a.target)) {
    const LoadedWorkflow loaded = load_workflow(a.target, a.overrides, registry);
    for (const std::string& doubt : loaded.warnings) host.warn(doubt);
    const Workflow& w = loaded.workflow;
    return {w.contact_law, {w.material_list().front().density}, w.dimension, w.thickness};
  }
  registry.documentation("contact_law", a.target);  // UserError for a name that no law has
  Schema<PairConfig> schema;
  schema.param("contact_law", &PairConfig::contact_law)
      .kind("contact_law")
      .doc("the force between two particles; of a list the forces add up");
  schema.param("material", &PairConfig::material).fallback(Json{{"density", 2650.0}}).doc("of the particles");
  schema.param("dimension", &PairConfig::dimension).at_least(2).at_most(3).fallback(3).doc("2: discs; 3: spheres");
  schema.param("thickness", &PairConfig::thickness).unit("m").above(0).fallback(1.0).doc("of the discs, out of plane");
  return schema.load(read_config("contact_law: {type: " + a.target + "}\n", "contact_law " + a.target,
                                 schema.documentation().root, registry, a.overrides));
}

double option(const char* name, const std::string& text, const std::string& unit) {
  try {
    return parse_quantity(text, unit);
  } catch (const UserError& e) { throw UserError(std::string(name) + ": " + e.what()); }
}

void set_radii(const DriveRequest& a, DriveSettings& s) {
  if (a.radius.empty()) return;
  if (a.radius.size() > 2)
    throw UserError("--radius: one radius for both particles, or two, not " + std::to_string(a.radius.size()));
  s.radius_i = option("--radius", a.radius.front(), "m");
  s.radius_j = option("--radius", a.radius.back(), "m");
  if (!(s.radius_i > 0 && s.radius_j > 0)) throw UserError("--radius: a radius must be above 0");
}

}  // namespace

std::optional<PluginChoice> drive_charts(const DrivePath& path, const Registry& registry, Host& host) {
  const auto usual = usual_renderer({}, registry, host);
  if (!usual) return {};
  struct Direction {
    double WayPoint::*moved;
    const char* chart;
  };
  std::string wanted;
  for (const Direction& d :
       {Direction{&WayPoint::normal, "{x: normal_displacement, y: normal_force, name: normal_force}"},
        {&WayPoint::shear, "{x: shear_displacement, y: shear_force, name: shear_force}"},
        {&WayPoint::rotation, "{x: rotation, y: bending_moment_N_m, name: bending_moment}"},
        {&WayPoint::twist, "{x: twist, y: torque_N_m, name: torque}"}})
    if (std::any_of(path.points.begin(), path.points.end(), [&](const WayPoint& p) { return p.*d.moved != 0; }))
      wanted += (wanted.empty() ? "" : ", ") + std::string(d.chart);
  if (wanted.empty()) return {};
  return renderer_settings(usual->type, {"comparisons=[" + wanted + "]"}, registry);
}

DriveSettings drive_settings(const DriveRequest& a, Registry& registry, Host& host) {
  const PairConfig config = read_target(a, registry, host);
  DriveSettings s;
  s.law = config.contact_law;
  s.density = config.material.density;
  s.dimension = int(config.dimension);
  s.thickness = config.thickness;
  set_radii(a, s);
  if (!a.gap.empty()) s.gap = option("--gap", a.gap, "m");
  if (!a.porosity.empty()) s.porosity = option("--porosity", a.porosity, "1");
  if (!(s.porosity > 0 && s.porosity < 1)) throw UserError("--porosity: must lie between 0 and 1");
  s.coordination_number = a.coordination_number;
  if (!(s.coordination_number > 0)) throw UserError("--coordination-number: must be above 0");
  s.bonded = !a.unbonded;
  s.steps = a.steps;
  return s;
}

}  // namespace breccia
