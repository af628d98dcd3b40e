// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/trials.hpp"

#include <algorithm>

#include "calibrate/calibration_search.hpp"
#include "config/at_path.hpp"
#include "config/reader.hpp"
#include "config/suggest.hpp"
#include "config/units.hpp"
#include "config/writer.hpp"
#include "run/load_workflow.hpp"
#include "study/input_hash.hpp"
#include "workflow/plugin_section.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

YamlPtr scalar(const std::string& text, Place place) {
  auto node = std::make_shared<YamlNode>();
  node->kind = YamlNode::Kind::scalar;
  node->text = text;
  node->place = place;
  return node;
}

}  // namespace

CalibrationTrials::CalibrationTrials(const fs::path& file) : calibration_(load_calibration(file, own_)) {
  read_workflows();
  try_the_range();
}

std::unique_ptr<Search> CalibrationTrials::search() const { return own_.create<Search>(search_of(calibration_, own_)); }

const Registry& CalibrationTrials::registry_with(const std::vector<fs::path>& plugins) const {
  auto& registry = registries_[plugins];
  if (!registry) {
    auto fresh = std::make_unique<Registry>();
    for (const fs::path& path : plugins) fresh->add(path);
    registry = std::move(fresh);
  }
  return *registry;
}

void CalibrationTrials::read_workflows() {
  std::vector<Finding> findings;
  for (const auto& w : calibration_.workflows) {
    BaseChain source;
    try {
      source = follow_bases(read_text(w.file), w.file);
      if (is_study(source) || is_calibration(source)) throw UserError(w.file + " is no workflow");
      if (const auto known = variants_of(source);
          !w.variant.empty() && std::find(known.begin(), known.end(), w.variant) == known.end())
        findings.push_back({w.variant_place, "workflows." + w.name + ".variant",
                            "the workflow has no variant `" + w.variant + "`" + suggestion(w.variant, known)});
    } catch (const UserError& e) { findings.push_back({w.place, "workflows." + w.name + ".file", e.what()}); }
    sources_.push_back(std::move(source));
  }
  if (!findings.empty()) refuse(std::move(findings), {calibration_.file});
}

ValuesOnTop CalibrationTrials::values_of(const Trial& t) const {
  const auto& w = calibration_.workflows[t.workflow];
  ValuesOnTop on_top{calibration_.file, w.set, w.variant, {}};
  if (t.stage != Trial::no_stage) {
    const auto& stage = calibration_.stages[t.stage];
    if (!stage.variant.empty()) on_top.variant = stage.variant;
    on_top.values.insert(on_top.values.end(), stage.set.begin(), stage.set.end());
  }
  for (std::size_t k = 0; k < calibration_.parameters.size(); ++k) {
    const auto& p = calibration_.parameters[k];
    if (!p.of_workflow[t.workflow]) continue;
    for (const std::string& path : p.paths) on_top.values.push_back({path, p.place, scalar(t.values[k], p.from)});
  }
  if (t.stage == Trial::no_stage) return on_top;
  const Place place = calibration_.file.tree->place;
  on_top.values.push_back({"seed", place, scalar(std::to_string(t.seed), place)});
  return on_top;
}

const Registry& CalibrationTrials::registry(const Trial& t) const {
  return registry_with(plugin_paths(sources_[t.workflow], values_of(t)));
}

ResolvedTrial CalibrationTrials::resolve(const Trial& t) const {
  const Registry& plugins = registry(t);
  ResolvedTrial resolved{load_workflow(sources_[t.workflow], values_of(t), plugins), "", ""};
  resolved.hash = input_hash(resolved.loaded.config, plugins);
  resolved.folder = calibration_.workflows[t.workflow].name + "_" + resolved.hash.substr(0, 12);
  return resolved;
}

/// The first guess and both ends of the range, of every workflow in every stage: a path that leads nowhere, a unit that
/// does not fit, a range that leaves what the parameter may be.
void CalibrationTrials::try_the_range() {
  std::vector<std::string> problems;
  const auto add = [](std::vector<std::string>& all, const std::string& text) {
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
  };
  units_.assign(calibration_.parameters.size(), "");
  for (std::size_t stage = 0; stage < calibration_.stages.size(); ++stage)
    for (std::size_t w = 0; w < sources_.size(); ++w)
      for (const double share : {0.5, 0.0, 1.0}) {
        Trial t{stage, w, calibration_.config.seed, {}};
        for (const auto& p : calibration_.parameters)
          t.values.push_back(p.scale.text(share == 0.5 ? p.start.value_or(share) : share));
        try {
          const ResolvedTrial resolved = resolve(t);
          if (share != 0.5) continue;
          for (const std::string& doubt : resolved.loaded.warnings) add(warnings_, doubt);
          for (std::size_t k = 0; k < units_.size(); ++k)
            if (calibration_.parameters[k].of_workflow[w] && units_[k].empty())
              if (const auto spec = spec_at(resolved.loaded.config, workflow_schema(), registry(t),
                                            calibration_.parameters[k].paths.front()))
                units_[k] = spec->unit;
        } catch (const ConfigError& e) {
          for (const Problem& p : e.problems()) add(problems, p.str());
        } catch (const UserError& e) { add(problems, e.what()); }
        if (!problems.empty() && share == 0.5) break;  // the ends would say the same
      }
  if (problems.empty()) return;
  std::string text;
  for (const std::string& p : problems) text += (text.empty() ? "" : "\n") + p;
  throw UserError(text);
}

Json CalibrationTrials::described(const Trial& t) const {
  Json j = {{"stage", t.stage}, {"workflow", calibration_.workflows[t.workflow].name}, {"seed", t.seed}};
  for (std::size_t k = 0; k < t.values.size(); ++k) j["parameters"][calibration_.parameters[k].name] = t.values[k];
  return j;
}

Trial CalibrationTrials::from(const Json& j) const {
  try {
    Trial t;
    t.stage = j.at("stage").get<std::size_t>();
    t.seed = j.at("seed").get<long>();
    const std::string name = j.at("workflow").get<std::string>();
    const auto at = std::find_if(calibration_.workflows.begin(), calibration_.workflows.end(),
                                 [&](const auto& w) { return w.name == name; });
    if (at == calibration_.workflows.end() || t.stage >= calibration_.stages.size())
      throw UserError("the calibration has no such run");
    t.workflow = std::size_t(at - calibration_.workflows.begin());
    for (const auto& p : calibration_.parameters) t.values.push_back(j.at("parameters").at(p.name).get<std::string>());
    return t;
  } catch (const Json::exception&) { throw UserError("the calibration has no such run"); }
}

std::string CalibrationTrials::ready_workflow(std::size_t workflow, const TrialPoint& values,
                                              const fs::path& at) const {
  const auto& w = calibration_.workflows[workflow];
  const Trial t{Trial::no_stage, workflow, 0, values};
  const Registry& plugins = registry(t);
  const Json best = load_workflow(sources_[workflow], values_of(t), plugins).config;
  ValuesOnTop nothing{calibration_.file, {}, {}, {}};
  Json plain;
  try {
    plain = load_workflow(sources_[workflow], nothing, plugins).config;
  } catch (const UserError&) { plain = Json::object(); }  // it needs what the calibration gives: all is written
  Json changed = Json::object();
  for (const auto& [key, value] : best.items())
    if (!plain.contains(key) || plain[key] != value) changed[key] = value;
  const fs::path base = fs::absolute(w.file).lexically_normal().lexically_relative(fs::absolute(at).lexically_normal());
  return "base: " + json_text(Json(base.string())) + "\n" + write_yaml(changed, workflow_schema(), plugins);
}

}  // namespace breccia
