// SPDX-License-Identifier: BSD-3-Clause
/// A simulation made by hand, and a host that keeps what a post-processor says: plugins are tested through their shared
/// library, as the program uses them.
#pragma once

#include <dlfcn.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "breccia/postprocessor.hpp"

namespace breccia::test {

/// Owns what the spans of a SimulationView point to.
struct FakeSimulation {
  int dimension = 3;
  double thickness = 1;
  std::vector<Vec3> position, reference;
  std::vector<double> radius, mass;
  std::vector<Index> id;

  std::vector<Index> pair_i, pair_j, pair_bond;
  std::vector<double> rest_length;
  std::vector<BondState> pair_state;
  std::vector<PairForce> force;

  std::vector<Index> bond_i, bond_j, bond_pair;
  std::vector<double> initial_distance;
  std::vector<Index> crack_of;
  std::vector<Crack> cracks;
  std::vector<BondState> bond_state;

  std::vector<WallContact> wall_contacts;
  SpecimenShape specimen;
  EnergyLedger energy;

  Index add_particle(const Vec3& x, double r) {
    position.push_back(x);
    reference.push_back(x);
    radius.push_back(r);
    mass.push_back(r * r * r);
    id.push_back(Index(id.size()));
    return id.back();
  }
  /// A pair that was never glued, with the force on i.
  std::size_t add_pair(Index i, Index j, const Vec3& on_i = Vec3::Zero()) {
    const double distance = (position[j] - position[i]).norm();
    pair_i.push_back(i);
    pair_j.push_back(j);
    pair_bond.push_back(PairsView::no_bond);
    rest_length.push_back(distance);
    pair_state.push_back(BondState::unbonded);
    force.push_back({on_i.x(), on_i.y(), on_i.z(), 0, 0, 0, 0.5 * (distance - radius[i] - radius[j]), 0});
    return pair_i.size() - 1;
  }
  std::size_t add_bond(Index i, Index j, const Vec3& on_i = Vec3::Zero()) {
    const std::size_t pair = add_pair(i, j, on_i);
    pair_bond[pair] = Index(bond_i.size());
    pair_state[pair] = BondState::intact;
    bond_i.push_back(i);
    bond_j.push_back(j);
    bond_pair.push_back(Index(pair));
    initial_distance.push_back(rest_length[pair]);
    crack_of.push_back(BondsView::no_crack);
    bond_state.push_back(BondState::intact);
    return bond_i.size() - 1;
  }
  void break_bond(std::size_t bond, BondState how) {
    bond_state[bond] = how;
    crack_of[bond] = Index(cracks.size());
    cracks.push_back({1, position[bond_i[bond]], (position[bond_j[bond]] - position[bond_i[bond]]).normalized()});
    pair_state[bond_pair[bond]] = how;
  }
  void set_force(std::size_t pair, const Vec3& on_i) {
    force[pair].fx = on_i.x();
    force[pair].fy = on_i.y();
    force[pair].fz = on_i.z();
  }

  SimulationView view() const {
    SimulationView v;
    v.dimension = dimension;
    v.thickness = thickness;
    v.particles.position = position;
    v.particles.initial_position = reference;
    v.particles.radius = radius;
    v.particles.mass = mass;
    v.particles.id = id;
    v.pairs.i = pair_i;
    v.pairs.j = pair_j;
    v.pairs.bond = pair_bond;
    v.pairs.rest_length = rest_length;
    v.pairs.state = pair_state;
    v.pairs.force = force;
    v.bonds.i = bond_i;
    v.bonds.j = bond_j;
    v.bonds.pair = bond_pair;
    v.bonds.initial_distance = initial_distance;
    v.bonds.crack_of = crack_of;
    v.bonds.cracks = cracks;
    v.bonds.state = bond_state;
    v.wall_contacts = wall_contacts;
    v.specimen = specimen;
    v.energy = energy;
    return v;
  }
};

class FakeHost final : public SilentHost {
 public:
  void warn(std::string_view text) override { warnings.emplace_back(text); }
  std::vector<std::string> warnings;
};

/// Recorder and curves in one.
class FakeCurves final : public Recorder, public Curves {
 public:
  std::size_t add(Column column) override {
    for (const Column& c : columns_)
      if (c.name == column.name) throw UserError("two curves are called " + c.name);
    columns_.push_back(std::move(column));
    values_.emplace_back();
    return columns_.size() - 1;
  }
  void set(std::size_t column, double value) override { values_.at(column).push_back(value); }
  const std::vector<Column>& columns() const override { return columns_; }
  std::span<const double> column(std::string_view name) const override {
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (columns_[k].name == name) return values_[k];
    throw UserError("there is no curve called " + std::string(name));
  }
  std::size_t rows() const override { return values_.empty() ? 0 : values_[0].size(); }

  double last(std::string_view name) const { return column(name).back(); }
  void add_column(const std::string& name, std::vector<double> values) {
    add({name, "1", ""});
    values_.back() = std::move(values);
  }

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<double>> values_;
};

class FakeSummary final : public Summary {
 public:
  void headline(const ResultName& name, Json value) override {
    if (!headlines.emplace(name.key(), std::move(value)).second)
      throw std::logic_error("headline given twice: " + name.key());
  }
  void own(const ResultName& name, Json value) override {
    const std::string key = name.key();
    if (!given_.insert(key).second) throw std::logic_error("key given twice: " + key);
    const std::size_t dot = key.find('.');
    if (dot == key.npos) owned[key] = std::move(value);
    else owned[key.substr(0, dot)][Json::json_pointer(pointer(key.substr(dot)))] = std::move(value);
  }
  void table(Table table) override {
    const std::string name = table.name;
    if (!tables.emplace(name, std::move(table)).second) throw std::logic_error("table given twice: " + name);
  }
  std::map<std::string, Json> headlines, owned;
  std::map<std::string, Table> tables;

 private:
  static std::string pointer(std::string dotted) {
    for (char& c : dotted) c = c == '.' ? '/' : c;
    return dotted;
  }
  std::set<std::string> given_;
};

/// A post-processor from its library, configured as the core would: defaults filled in.
class LoadedPostprocessor {
 public:
  explicit LoadedPostprocessor(const std::string& name, Json config = Json::object()) {
    const std::string file = std::string(BRECCIA_POSTPROCESSORS) + "/breccia_postprocessor." + name + ".so";
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) throw std::runtime_error(dlerror());
    const auto* descriptor = static_cast<const BrecciaPluginDescriptor*>(dlsym(library, "breccia_plugin"));
    if (!descriptor) throw std::runtime_error(file + " is no plugin");
    Factory* factory = descriptor->factory();
    for (const ParamSpec& p : factory->documentation().root.members)
      if (!config.contains(p.name) && !p.fallback.is_null()) config[p.name] = p.fallback;
    issues = factory->check(config);
    plugin_ = factory->create(config);
  }
  Postprocessor* operator->() { return static_cast<Postprocessor*>(plugin_.get()); }

  FakeCurves curves;
  FakeHost host;
  Issues issues;

  void begin(const SimulationView& view) { (*this)->begin(view, curves, host); }
  void sample(const SimulationView& view) { (*this)->sample(view, curves); }
  FakeSummary finish(const SimulationView& view) {
    FakeSummary summary;
    (*this)->finish(view, curves, summary);
    return summary;
  }
  std::vector<double> field(const SimulationView& view, const std::string& name) {
    std::vector<Field> all;
    (*this)->fields(view, all);
    for (Field& f : all)
      if (f.name == name) return f.values;
    throw std::logic_error("no field " + name);
  }

 private:
  std::unique_ptr<Plugin> plugin_;
};

}  // namespace breccia::test
