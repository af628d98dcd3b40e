// SPDX-License-Identifier: BSD-3-Clause
/// A workflow with every type of parameter and three plugins, none of them in a shared library.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "config/plugin_directory.hpp"

namespace breccia::fake {

struct BrittleLaw {
  double bond_modulus, tensile_strength, friction, angle;
  std::optional<double> damping;
  enum class Model { model_1, model_2 } kind;
  static void describe(Schema<BrittleLaw>& s) {
    s.summary("brittle bonds").details("F = K u | no more").source("a paper, Eq. 1");
    s.param("model", &BrittleLaw::kind)
        .choice("model_1", Model::model_1, "arithmetic means")
        .choice("model_2", Model::model_2, "harmonic means")
        .doc("how stiffness follows from radii")
        .fallback("model_1");
    s.param("bond_modulus", &BrittleLaw::bond_modulus).unit("Pa").above(0).example("10 GPa").doc("modulus of the bond");
    s.param("tensile_strength", &BrittleLaw::tensile_strength)
        .unit("Pa")
        .above(0)
        .at_most(1e9)
        .example("40 MPa")
        .doc("strength of the bond")
        .source("Eq. 25");
    s.param("friction", &BrittleLaw::friction).at_least(0).example("0.5").doc("Coulomb coefficient").fallback(0.5);
    s.param("angle", &BrittleLaw::angle).unit("rad").at_least(0).below(1.5).doc("friction angle").fallback(0.25);
    s.param("damping", &BrittleLaw::damping).unit("kg/s").above(0).doc("viscous");
    s.removed("cohesion", "write `tensile_strength`");
    s.check([](const BrittleLaw& c, Issues& issues) {
      if (c.tensile_strength > c.bond_modulus) issues.push_back({"tensile_strength", "is above the bond modulus"});
    });
  }
};

struct SoftLaw {
  double stiffness;
  static void describe(Schema<SoftLaw>& s) {
    s.summary("linear springs");
    s.param("stiffness", &SoftLaw::stiffness).unit("N/m").above(0).example("15 MN/m").doc("of a contact");
  }
};

struct Wall {
  Vec3 point;
  double friction;
  static void describe(Schema<Wall>& s) {
    s.param("point", &Wall::point).unit("m").example("[0 m, 0 m, 0 m]").doc("a point on it");
    s.param("friction", &Wall::friction).at_least(0).doc("of the wall").fallback(0.0);
  }
};

struct Stress {
  double every;
  bool symmetric;
  std::vector<Wall> walls;
  static void describe(Schema<Stress>& s) {
    s.summary("mean stress");
    s.param("every", &Stress::every).unit("s").above(0).doc("between samples").fallback(0.001);
    s.param("symmetric", &Stress::symmetric).doc("drop the antisymmetric part").fallback(true);
    s.param("walls", &Stress::walls).items(0, 2).doc("walls that count").fallback(Json::array());
    s.check([](const Stress& c, Issues& issues) {
      for (std::size_t k = 0; k < c.walls.size(); ++k)
        if (c.walls[k].friction > 5)
          issues.push_back({"walls[" + std::to_string(k) + "].friction", "is beyond belief"});
    });
  }
};

struct Specimen {
  std::optional<double> height, slenderness;
  std::optional<double> porosity;
  double diameter;
  static void describe(Schema<Specimen>& s) {
    s.param("diameter", &Specimen::diameter).unit("m").above(0).example("23 mm").doc("of the cylinder");
    s.param("height", &Specimen::height).unit("m").above(0).doc("of the cylinder");
    s.param("slenderness", &Specimen::slenderness).above(0).doc("height over diameter");
    s.param("porosity", &Specimen::porosity).at_least(0).below(1).doc("share of voids");
    s.exactly_one_of({"height", "slenderness"});
  }
};

struct Workflow {
  std::string title;
  std::uint64_t seed;
  std::int64_t steps;
  double safety;
  bool gravity;
  Specimen specimen;
  std::filesystem::path particles;
  std::vector<double> levels;
  PluginChoice contact_law;
  std::vector<PluginChoice> postprocessor;
  Json expected;
  std::optional<double> quick, slow;
  std::optional<std::filesystem::path> base;
  static void describe(Schema<Workflow>& s) {
    s.param("title", &Workflow::title).doc("a line for the report").fallback("untitled");
    s.param("seed", &Workflow::seed).at_least(0).doc("of random numbers").fallback(1);
    s.param("steps", &Workflow::steps).at_least(1).at_most(1000000000).doc("at most").fallback(1000);
    s.param("safety", &Workflow::safety).above(0).at_most(1).doc("share of the critical time step").fallback(0.5);
    s.param("gravity", &Workflow::gravity).doc("weight").fallback(false);
    s.param("specimen", &Workflow::specimen).doc("its shape");
    s.param("particles", &Workflow::particles).doc("a file").fallback("particles.csv");
    s.param("levels", &Workflow::levels).unit("Pa").items(1, 4).above(0).doc("of stress").fallback({1e6, 2e6});
    s.param("contact_law", &Workflow::contact_law).kind("contact_law").doc("between particles");
    s.param("postprocessor", &Workflow::postprocessor)
        .kind("postprocessor")
        .doc("measurements")
        .fallback(Json::array({{{"type", "stress"}}}));
    s.param("expected", &Workflow::expected).doc("reference values").fallback(Json::object());
    s.param("quick", &Workflow::quick).doc("one way");
    s.param("slow", &Workflow::slow).doc("another way");
    s.param("base", &Workflow::base).doc("a file to build on");
    s.at_most_one_of({"quick", "slow"});
  }
};

class Plugins final : public PluginDirectory {
 public:
  Plugins() {
    add<BrittleLaw>("contact_law", "brittle");
    add<SoftLaw>("contact_law", "soft");
    add<Stress>("postprocessor", "stress");
  }
  std::vector<std::string> names(const std::string& kind) const override {
    std::vector<std::string> all;
    for (const auto& [key, entry] : entries_)
      if (key.first == kind) all.push_back(key.second);
    if (kind == "contact_law") all.insert(all.begin(), "absent");  // a file that does not load
    return all;
  }
  const Documentation& documentation(const std::string& kind, const std::string& name) const override {
    return find(kind, name).doc;
  }
  Issues check(const std::string& kind, const std::string& name, const Json& config) const override {
    return find(kind, name).check(config);
  }

 private:
  struct Entry {
    Documentation doc;
    std::function<Issues(const Json&)> check;
  };
  template <class C>
  void add(const std::string& kind, const std::string& name) {
    auto schema = std::make_shared<Schema<C>>();
    C::describe(*schema);
    entries_[{kind, name}] = {schema->documentation(), [schema](const Json& j) { return schema->check(j); }};
  }
  const Entry& find(const std::string& kind, const std::string& name) const {
    const auto it = entries_.find({kind, name});
    if (it == entries_.end()) throw UserError("the plugin's file `absent.so` is truncated");
    return it->second;
  }
  std::map<std::pair<std::string, std::string>, Entry> entries_;
};

inline const ParamSpec& root() {
  static const Documentation doc = [] {
    Schema<Workflow> schema;
    Workflow::describe(schema);
    return schema.documentation();
  }();
  return doc.root;
}

/// A rule of the workflow as a whole.
inline Issues rules(const Json& config) {
  Issues issues;
  if (config["safety"].get<double>() > 0.9 && config["contact_law"]["type"] == "brittle")
    issues.push_back({"safety", "is too bold for brittle bonds"});
  return issues;
}

inline const char* const valid = R"(# a workflow with everything in it
title: "compression: \"dry\" rock"
seed: 42
steps: 1e6
safety: 30 %
gravity: true
specimen:
  diameter: 23 mm
  slenderness: 2.25
  porosity: 23 %
particles: ../data/spheres.csv
levels: [1 MPa, 70 psi, 0.1 GPa]
contact_law:
  type: brittle
  model: model_2
  bond_modulus: &stiff 10 GPa
  tensile_strength: 40 MPa
  angle: 30 deg
postprocessor:
  - type: stress
    every: 2 ms
    walls:
      - {point: [0 m, 1 mm, -2 cm], friction: 0.3}
      - point: [1 m, 1 m, 1 m]
  - type: stress
    name: second
    symmetric: false
expected:
  modulus: *stiff
  peaks: [1, 2.5, "3", true, ~]
  note: 'as in "table 2"'
slow: 3
)";

}  // namespace breccia::fake
