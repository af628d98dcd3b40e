// SPDX-License-Identifier: BSD-3-Clause
#include "study/cases.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "breccia/text_file.hpp"
#include "config/at_path.hpp"
#include "config/each_value.hpp"
#include "config/reader.hpp"
#include "hash/sha256.hpp"
#include "results/curve_table.hpp"
#include "results/summary_keys.hpp"
#include "study/input_hash.hpp"
#include "workflow/plugin_section.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

/// The last part of a path, or all of it where another parameter ends in the same.
std::string short_name(const std::vector<StudyParameter>& all, const std::string& path) {
  const auto last = [](const std::string& p) { return split_path(p).back().name; };
  const auto alike =
      std::count_if(all.begin(), all.end(), [&](const StudyParameter& p) { return last(p.path) == last(path); });
  return alike == 1 ? last(path) : path;
}

std::string fit_for_a_name(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(c)) || std::string_view("._+-=").find(c) != std::string_view::npos;
    if (plain) out += c;
    else if (out.empty() || out.back() != '_') out += '_';
  }
  while (!out.empty() && (out[0] == '.' || out[0] == '-')) out.erase(0, 1);
  return out;
}

/// A study that gives `variants` a name means that variant of the workflow: it is laid over the workflow before the
/// study's other values, as `--variant` would have it. `{name: changes}` is a variant that the study itself defines.
void take_variant(ValuesOnTop& on_top) {
  std::vector<PlacedValue> rest;
  for (PlacedValue& v : on_top.values) {
    if (v.path != "variants" && v.path != "variant") {
      rest.push_back(std::move(v));
      continue;
    }
    const YamlNode& value = *v.value;
    const bool is_name = value.kind == YamlNode::Kind::scalar && !value.text.empty();
    const bool is_own = value.kind == YamlNode::Kind::mapping && value.entries.size() == 1 &&
                        value.entries[0].value->kind == YamlNode::Kind::mapping;
    if (!is_name && !is_own)
      refuse(
          {{value.place, v.path,
            "must be the name of one of the workflow's `variants`, or one mapping `{name: changes}`, for each case"}},
          {on_top.file});
    if (!on_top.variant.empty()) refuse({{v.place, v.path, "a second variant: a case has one"}}, {on_top.file});
    on_top.variant = is_name ? value.text : value.entries[0].key;
    if (!is_own) continue;
    on_top.changes = value.entries[0].value;
    if (const YamlEntry* inner = on_top.changes->find("variants"))
      refuse({{inner->place, v.path, "a variant has no variants of its own"}}, {on_top.file});
  }
  on_top.values = std::move(rest);
}

}  // namespace

Sweep::Sweep(const fs::path& file) : study_(load_study(file, Registry())) {
  read_workflows();
  name_cases();
}

void Sweep::read_workflows() {
  std::vector<Finding> findings;
  for (std::size_t k = 0; k < study_.workflow_files.size(); ++k) {
    BaseChain source;
    try {
      source = follow_bases(read_text(study_.workflow_files[k]), study_.workflow_files[k]);
      registry_with(plugin_paths(source, {study_.file, study_.fixed, {}, {}}));
    } catch (const UserError& e) {
      const std::string path = has_workflows() ? "workflows[" + std::to_string(k) + "].file" : "workflow";
      findings.push_back({study_.workflow_places[k], path, e.what()});
    }
    sources_.push_back(std::move(source));
  }
  if (!findings.empty()) refuse(std::move(findings), {study_.file});
}

void Sweep::name_cases() {
  std::set<std::string> names;
  for (std::size_t p = 0; p < study_.points.size(); ++p)
    for (std::size_t w = 0; w < sources_.size(); ++w) {
      std::string name;
      for (const PlacedValue& v : study_.points[p])
        name.append(name.empty() ? "" : "_")
            .append(short_name(study_.parameters, v.path))
            .append("=")
            .append(value_text(*v.value));
      if (has_workflows()) name.append("_").append(study_.workflow_names[w]);
      std::string folder = fit_for_a_name(name);
      const bool is_long = folder.size() > 150;
      if (is_long) folder.resize(130);
      if (is_long || names.contains(folder)) folder.append("_").append(sha256(name), 0, 12);
      names.insert(folder);
      cases_.push_back({cases_.size() + 1, p, w, folder});
    }
}

const SweepCase& Sweep::find(const std::string& name) const {
  for (const SweepCase& c : cases_)
    if (std::to_string(c.number) == name || c.folder == name) return c;
  throw UserError("the study has no case `" + name + "`: its cases are numbered from 1 to " +
                  std::to_string(cases_.size()) + " (see --cases)");
}

const Registry& Sweep::registry_with(const std::vector<fs::path>& plugins) const {
  auto& registry = registries_[plugins];
  if (!registry) {
    auto fresh = std::make_unique<Registry>();
    for (const fs::path& path : plugins) fresh->add(path);
    registry = std::move(fresh);
  }
  return *registry;
}

ValuesOnTop Sweep::values_of(const SweepCase& c) const {
  ValuesOnTop on_top{study_.file, study_.fixed, {}, {}};
  const StudyPoint& point = study_.points[c.point];
  on_top.values.insert(on_top.values.end(), point.begin(), point.end());
  take_variant(on_top);
  return on_top;
}

const Registry& Sweep::registry(const SweepCase& c) const {
  return registry_with(plugin_paths(sources_[c.workflow], values_of(c)));
}

ResolvedCase Sweep::resolve(const SweepCase& c) const {
  const StudyPoint& point = study_.points[c.point];
  const Registry& plugins = registry(c);
  ResolvedCase resolved;
  resolved.loaded = load_workflow(sources_[c.workflow], values_of(c), plugins);
  const Json& config = resolved.loaded.config;
  resolved.hash = input_hash(config, plugins);
  for (const PlacedValue& v : point) {
    const Json* value = value_at(config, v.path);
    resolved.inputs.push_back(value ? *value : Json(value_text(*v.value)));
    const auto spec = value && value->is_number() ? spec_at(config, workflow_schema(), plugins, v.path) : std::nullopt;
    const bool is_quantity = spec && (spec->type == ParamType::quantity || spec->type == ParamType::quantity_list);
    resolved.units.push_back(is_quantity ? spec->unit : "1");
  }
  return resolved;
}

namespace {

/// The problems of all cases, each once; what the study's own lines do not explain is told with its case.
class Problems {
 public:
  Problems(const Sweep& sweep) : sweep_(sweep) {}

  void add(const SweepCase& c, const ConfigError& e) {
    for (const Problem& p : e.problems()) add(c, p.str(), p.file == sweep_.study().file.name);
  }
  void add(const Problem& of_the_study) { add(sweep_.cases().front(), of_the_study.str(), true); }
  void add(const SweepCase& c, const std::string& text, bool is_placed = false) {
    const auto it = std::find_if(all_.begin(), all_.end(), [&](const auto& one) { return one.text == text; });
    if (it == all_.end()) all_.push_back({text, c.folder, 1, is_placed});
    else ++it->cases;
  }
  void refuse_any() const {
    std::string text;
    for (const auto& one : all_) {
      text.append(text.empty() ? "" : "\n").append(one.text);
      if (one.is_placed || one.cases == sweep_.cases().size()) continue;
      text += " (in case " + one.first;
      if (one.cases > 1) text += " and " + std::to_string(one.cases - 1) + (one.cases == 2 ? " other" : " others");
      text += ")";
    }
    if (!all_.empty()) throw UserError(text);
  }

 private:
  struct One {
    std::string text, first;
    std::size_t cases;
    bool is_placed;
  };
  const Sweep& sweep_;
  std::vector<One> all_;
};

}  // namespace

SweepPlan plan(const Sweep& sweep) {
  SweepPlan plan;
  Problems problems(sweep);
  std::map<std::pair<std::size_t, std::string>, std::size_t> seen;
  const auto& parameters = sweep.study().parameters;
  for (const SweepCase& c : sweep.cases()) {
    try {
      ResolvedCase resolved = sweep.resolve(c);
      for (const std::string& doubt : resolved.loaded.warnings)
        if (std::find(plan.warnings.begin(), plan.warnings.end(), doubt) == plan.warnings.end())
          plan.warnings.push_back(doubt);
      if (plan.input_units.empty()) plan.input_units = resolved.units;
      for (std::size_t k = 0; k < parameters.size(); ++k)
        if (plan.input_units[k] != resolved.units[k])
          problems.add(c, "`" + parameters[k].path + "` is in " + plan.input_units[k] + " in one case and in " +
                              resolved.units[k] + " in another: one column cannot hold both");
      const auto [same, is_new] = seen.emplace(std::pair(c.workflow, resolved.hash), c.number);
      if (!is_new)
        problems.add(c, "case " + std::to_string(c.number) + " is the same as case " + std::to_string(same->second));
      plan.cases.push_back({c, std::move(resolved.inputs), std::move(resolved.hash)});
    } catch (const ConfigError& e) { problems.add(c, e); } catch (const UserError& e) {
      problems.add(c, e.what());
    }
  }
  for (const Problem& p : sweep.study().of_columns) problems.add(p);
  problems.refuse_any();
  return plan;
}

std::vector<std::string> input_headers(const Sweep& sweep, const SweepPlan& plan) {
  std::vector<std::string> names{"case", "folder"};
  if (sweep.has_workflows()) names.push_back("workflow");
  for (std::size_t k = 0; k < plan.input_units.size(); ++k)
    names.push_back(header_name({sweep.study().parameters[k].path, plan.input_units[k], ""}));
  return names;
}

std::vector<std::string> input_cells(const Sweep& sweep, const PlannedCase& planned) {
  std::vector<std::string> cells{std::to_string(planned.the.number), planned.the.folder};
  if (sweep.has_workflows()) cells.push_back(sweep.study().workflow_names[planned.the.workflow]);
  for (const Json& v : planned.inputs) cells.push_back(v.is_string() ? v.get<std::string>() : json_text(v));
  return cells;
}

std::string cases_csv(const Sweep& sweep, const SweepPlan& plan) {
  std::vector<std::string> header = input_headers(sweep, plan);
  header.push_back("inputs_sha256");
  std::string text = csv_line(header);
  for (const PlannedCase& c : plan.cases) {
    std::vector<std::string> cells = input_cells(sweep, c);
    cells.push_back(c.hash);
    text += csv_line(cells);
  }
  return text;
}

}  // namespace breccia
