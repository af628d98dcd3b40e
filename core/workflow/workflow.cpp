// SPDX-License-Identifier: BSD-3-Clause
#include "workflow/workflow.hpp"

#include <algorithm>
#include <map>

#include "config/suggest.hpp"

namespace breccia {

std::vector<Material> Workflow::material_list() const {
  std::vector<Material> list;
  if (material) list.push_back({material->density});
  else
    for (const auto& [key, m] : *materials) list.push_back({m.density, key});
  return list;
}

Materials Workflow::materials_of(const PackedParticles& particles) const {
  Materials all;
  all.list = material_list();
  Space within = space();
  within.cell = Cell::box(particles.period);
  if (material_of) all.of_particle = assign_materials(*material_of, all.list, particles, within, std::uint64_t(seed));
  return all;
}

namespace {

/// Names of materials are those of `materials`, wherever they stand.
void check_materials(const Workflow& w, Issues& issues) {
  std::vector<std::string> known;
  if (w.materials)
    for (const auto& [name, m] : *w.materials) known.push_back(name);
  const auto check = [&](const std::string& name, const std::string& where) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    issues.push_back({where, known.empty() ? "there are no `materials` in this workflow"
                                           : "no material is named `" + name + "`" + suggestion(name, known)});
  };
  if (w.material_of) {
    for (const auto& [name, where] : w.material_of->names()) check(name, "material_of." + where);
    Schema<MaterialOfConfig> schema;
    MaterialOfConfig::describe(schema);
    for (const Issue& issue : schema.rules_on(*w.material_of))
      issues.push_back({"material_of." + issue.path, issue.text});
  } else if (known.size() > 1) {
    issues.push_back({"materials", "there are several, and no `material_of` that says which particle is of which"});
  }
  for (std::size_t l = 0; l < w.contact_law.plugins.size(); ++l) {
    const Json& config = w.contact_law.plugins[l].config;
    if (!config.contains("between")) continue;
    const std::string law =
        w.contact_law.plugins.size() == 1 ? "contact_law" : "contact_law[" + std::to_string(l) + "]";
    std::map<std::pair<std::string, std::string>, std::size_t> seen;
    for (std::size_t k = 0; k < config["between"].size(); ++k) {
      const std::string where = law + ".between[" + std::to_string(k) + "].materials";
      const std::string p = config["between"][k]["materials"][0], q = config["between"][k]["materials"][1];
      check(p, where + "[0]");
      check(q, where + "[1]");
      if (const auto [first, is_new] = seen.emplace(std::minmax(p, q), k); !is_new)
        issues.push_back({where, "the pair of `" + p + "` and `" + q + "` stands in between[" +
                                     std::to_string(first->second) + "] already"});
    }
  }
}

/// `every: 2 ms`, meant as simulated time, would write one at each step.
void check_checkpoints(const CheckpointsConfig& c, Issues& issues) {
  if (c.every < 1)
    issues.push_back({"checkpoints.every",
                      "is time of the clock, and must be at least 1 s; simulated time between two checkpoints is "
                      "`checkpoints.every_simulated`"});
}

void check_periodic(const Workflow& w, Issues& issues) {
  const std::vector<std::string> known =
      w.dimension == 2 ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"};
  for (std::size_t k = 0; k < w.periodic.size(); ++k) {
    const std::string where = "periodic[" + std::to_string(k) + "]";
    const auto at = w.periodic.begin() + std::ptrdiff_t(k);
    if (std::find(known.begin(), known.end(), *at) == known.end())
      issues.push_back(
          {where, "a direction is " + std::string(w.dimension == 2 ? "x or y" : "x, y or z") + ", not `" + *at + "`"});
    else if (std::find(w.periodic.begin(), at, *at) != at) issues.push_back({where, "`" + *at + "` is given twice"});
  }
}

}  // namespace

PackingRequest Workflow::packing_request() const {
  PackingRequest request{space(), std::uint64_t(seed)};
  for (const std::string& direction : periodic) request.periodic[std::size_t(direction[0] - 'x')] = true;
  return request;
}

EngineSettings Workflow::engine_settings(int threads) const {
  EngineSettings settings;
  settings.damping = {damping.translational, damping.rotational};
  settings.time_step = engine.time_step;
  settings.safety = engine.time_step_safety;
  settings.added_mass = engine.added_mass;
  settings.skin = engine.skin;
  settings.threads = threads;
  return settings;
}

void Workflow::describe(Schema<Workflow>& s) {
  const Json none = Json::array(), defaults = Json::object();
  s.summary("A bonded-particle simulation");
  s.param("base", &Workflow::base)
      .doc(
          "a workflow file to build on, relative to this one; it may have a base itself and need not be complete. "
          "Mappings "
          "are merged key by key; values and lists given here replace those of the base whole, and so does a plugin's "
          "section with another `type`. A parameter given here drops those of the base that exclude it (`tolerance`, "
          "`coordination_number`). Relative paths start at the file in which they are written; anchors end with it");
  s.param("name", &Workflow::name).fallback("").doc("of the result folder; default: the name of the file");
  s.param("description", &Workflow::description).fallback("").doc("what it shows");
  s.param("seed", &Workflow::seed).at_least(0).fallback(1).doc("of all random numbers");
  s.param("dimension", &Workflow::dimension)
      .at_least(2)
      .at_most(3)
      .fallback(3)
      .doc("2: discs that move in the plane z = 0; 3: spheres");
  s.param("thickness", &Workflow::thickness).unit("m").above(0).fallback(1.0).doc("of the discs, out of plane");
  s.param("periodic", &Workflow::periodic)
      .items(0, 3)
      .fallback(none)
      .example("[x, y, z]")
      .doc(
          "directions along which space repeats itself: no surface, no platens there; the packing says after which "
          "length (as a rule the size of its container). In two dimensions x and y");
  s.param("plugins", &Workflow::plugins)
      .fallback(none)
      .example("[build/breccia_contact_law.mine.so]")
      .doc("plugins from outside Breccia's own folder, by their files or folders; relative paths start at this file");
  s.param("packing", &Workflow::packing).kind("packing").doc("how the particles are arranged");
  s.param("material", &Workflow::material).doc("of all particles");
  s.param("materials", &Workflow::materials)
      .items(1, Materials::most)
      .example("{quartz: {density: 2650 kg/m3}, feldspar: {density: 2560 kg/m3}}")
      .doc("several, by names; `material_of` says which particle is of which");
  s.param("material_of", &Workflow::material_of).doc("which particle is made of which of the `materials`");
  s.exactly_one_of({"material", "materials"});
  s.param("bonding", &Workflow::bonding)
      .doc(
          "which neighbours are glued together before loading; where no contact law makes bonds, which are contacts by "
          "whose stiffness a test is led");
  s.param("contact_law", &Workflow::contact_law)
      .kind("contact_law")
      .doc("the force between two particles; of a list of laws the forces add up, and one of them may make bonds");
  s.param("damping", &Workflow::damping).fallback(defaults).doc("non-viscous damping of the motion");
  s.param("protocol", &Workflow::protocol).kind("protocol").doc("the test");
  s.param("engine", &Workflow::engine).fallback(defaults).doc("numerical settings");
  s.param("sampling", &Workflow::sampling).fallback(defaults).doc("when curves are measured");
  s.param("curves", &Workflow::curves).fallback(defaults).doc("files of the curves");
  s.param("checkpoints", &Workflow::checkpoints)
      .fallback(defaults)
      .doc("states of the run from which `breccia run --resume` goes on, with the same results to the last bit");
  s.param("from", &Workflow::from)
      .doc(
          "begins where another run stood, with its particles, bonds and contacts: one specimen, several tests. "
          "Packing, bonds, materials and the types of the laws must be the same; parameters of the laws may differ "
          "where bonds and contacts keep nothing of them");
  s.param("checks", &Workflow::checks)
      .fallback(defaults)
      .doc("from where on input, or what becomes of it, is called almost surely wrong: warnings, no part of the test");
  s.param("postprocessors", &Workflow::postprocessors).kind("postprocessor").fallback(none).doc("what is measured");
  s.param("outputs", &Workflow::outputs)
      .kind("output")
      .fallback(none)
      .doc("files of the particles and bonds over time");
  s.param("renderers", &Workflow::renderers)
      .kind("renderer")
      .fallback(none)
      .doc("pictures, made from those files at the end");
  s.param("reference", &Workflow::reference)
      .fallback(defaults)
      .doc("published values to compare with: summary key to value, or text; copied into summary.json");
  s.param("variants", &Workflow::variants)
      .fallback(defaults)
      .example("{small: {packing: {particles: 1000}}}")
      .doc(
          "named changes of this workflow: `breccia run --variant small` lays those of `small` over it, as a file is "
          "laid over its base; "
          "the name of the variant is added to that of the workflow");
  s.param("provenance", &Workflow::provenance)
      .fallback(defaults)
      .doc("written by Breccia into resolved.yaml: versions and content hashes of what made the result");
}

namespace {

const Schema<Workflow>& schema_of_workflow() {
  static const Schema<Workflow> schema = [] {
    Schema<Workflow> s;
    Workflow::describe(s);
    s.check([](const Workflow& w, Issues& issues) {
      check_materials(w, issues);
      check_periodic(w, issues);
      check_checkpoints(w.checkpoints, issues);
    });
    return s;
  }();
  return schema;
}

}  // namespace

const ParamSpec& workflow_schema() { return schema_of_workflow().documentation().root; }

Issues workflow_issues(const Json& config) { return schema_of_workflow().check(config); }

}  // namespace breccia
