// SPDX-License-Identifier: BSD-3-Clause
/// What the schema cannot say of a calibration.
#include <algorithm>
#include <cmath>

#include "breccia/result_name.hpp"
#include "calibrate/calibration_search.hpp"
#include "calibrate/course.hpp"
#include "config/number.hpp"
#include "config/reader.hpp"
#include "config/result_name.hpp"
#include "config/suggest.hpp"
#include "config/units.hpp"
#include "workflow/read_workflow.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

std::string trimmed_text(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == text.npos ? "" : text.substr(first, last - first + 1);
}

class Checker {
 public:
  Checker(LoadedCalibration& loaded, std::vector<Finding>& findings)
      : loaded_(loaded), config_(loaded.config), tree_(*loaded.file.tree), findings_(findings) {}

  void name() {
    const std::string why = why_not_a_file_name(config_.name);
    const YamlEntry* given = tree_.find("name");
    if (!why.empty())
      findings_.push_back({given ? given->value->place : tree_.place, "name",
                           "`" + config_.name + "` cannot be the name of the result folder, it " + why});
  }

  void workflows() {
    for (const auto& [name, workflow] : config_.workflows) {
      const YamlNode& node = item("workflows", name);
      const YamlNode& file = *node.find("file")->value;
      const YamlEntry* variant = node.find("variant");
      loaded_.workflows.push_back({name, (loaded_.path.parent_path() / file.text).lexically_normal().string(),
                                   file.place, values(node), workflow.variant.value_or(""),
                                   variant ? variant->value->place : node.place});
    }
  }

  void targets() {
    std::vector<bool> measured(loaded_.workflows.size());
    for (const auto& [name, target] : config_.targets) {
      const YamlNode& node = item("targets", name);
      const std::string path = "targets." + name;
      const auto workflow = workflow_of(target, node, path);
      const YamlNode& key = *node.find("key")->value;
      const auto measure = measure_of(target, node, path);
      if (!workflow || !measure) continue;
      measured[*workflow] = true;
      for (const auto& other : loaded_.targets)
        if (other.workflow == *workflow && other.key == target.key)
          report(key, path + ".key", "`" + target.key + "` is the target `" + other.name + "` already");
      loaded_.targets.push_back({name, target.key, *workflow, *measure, key.place});
    }
    if (!findings_.empty()) return;
    for (std::size_t k = 0; k < measured.size(); ++k)
      if (!measured[k])
        findings_.push_back({loaded_.workflows[k].place, "workflows." + loaded_.workflows[k].name,
                             "no target asks for its results: leave it out, or give a target `workflow: " +
                                 loaded_.workflows[k].name + "`"});
  }

  void parameters() {
    for (const auto& [name, parameter] : config_.parameters) {
      const YamlNode& node = item("parameters", name);
      const std::string path = "parameters." + name;
      LoadedCalibration::Parameter p;
      p.name = name;
      const YamlEntry* one = node.find("path");
      p.paths = one ? std::vector<std::string>{*parameter.path} : *parameter.paths;
      p.place = (one ? one : node.find("paths"))->value->place;
      p.from = node.find("from")->value->place;
      if (p.paths.empty()) report(node, path + ".paths", "names no place");
      p.of_workflow = workflows_of(parameter, node, path);
      for (const std::string& to : p.paths) take(to, p, path);
      const auto scale = scale_of(parameter, node, path);
      if (!scale) continue;
      p.scale = *scale;
      if (const YamlEntry* start = node.find("start")) p.start = start_of(*start->value, *scale, parameter, path);
      p.scales_with = targets_for(p, parameter, node, path);
      loaded_.parameters.push_back(std::move(p));
    }
  }

  void run_time() {
    if (config_.budget.run_time)
      loaded_.run_time = {*config_.budget.run_time, tree_.find("budget")->value->find("run_time")->value->text};
  }

  void stages() {
    if (!config_.budget.stages) {
      loaded_.stages.push_back({"", "", 1, {}});
      return;
    }
    const YamlNode& list = *tree_.find("budget")->value->find("stages")->value;
    double sum = 0;
    for (std::size_t k = 0; k < list.items.size(); ++k) {
      const CalibrationStage& stage = (*config_.budget.stages)[k];
      const std::string path = item_path("budget.stages", k);
      sum += stage.share;
      if (stage.variant)
        for (const auto& w : loaded_.workflows)
          if (!w.variant.empty())
            report(*list.items[k], path + ".variant",
                   "the workflow `" + w.name + "` is its variant `" + w.variant +
                       "` already, and a run has one: say what differs under `set`");
      loaded_.stages.push_back({stage.name, stage.variant.value_or(""), stage.share, values(*list.items[k])});
    }
    if (std::abs(sum - 1) > 1e-6)
      report(list, "budget.stages",
             "the shares are " + format_number(std::round(sum * 1e4) / 100) + " % together, not 100 %");
  }

 private:
  const YamlNode& item(const char* map, const std::string& name) const {
    return *tree_.find(map)->value->find(name)->value;
  }
  void report(const YamlNode& at, const std::string& path, std::string text) {
    findings_.push_back({at.place, path, std::move(text)});
  }
  static std::vector<PlacedValue> values(const YamlNode& node) {
    std::vector<PlacedValue> all;
    if (const YamlEntry* set = node.find("set"))
      for (const YamlEntry& entry : set->value->entries) all.push_back({entry.key, entry.place, entry.value});
    return all;
  }
  std::vector<std::string> workflow_names() const {
    std::vector<std::string> names;
    for (const auto& w : loaded_.workflows) names.push_back(w.name);
    return names;
  }

  std::optional<std::size_t> workflow_of(const CalibrationTarget& target, const YamlNode& node,
                                         const std::string& path) {
    const std::vector<std::string> names = workflow_names();
    if (!target.workflow) {
      if (names.size() == 1) return 0;
      report(node, path, "needs `workflow`: which of " + list_of(names) + " measures it");
      return {};
    }
    const auto at = std::find(names.begin(), names.end(), *target.workflow);
    if (at != names.end()) return std::size_t(at - names.begin());
    report(*node.find("workflow")->value, path + ".workflow",
           "there is no workflow `" + *target.workflow + "`" + suggestion(*target.workflow, names));
    return {};
  }

  std::optional<TargetMeasure> measure_of(const CalibrationTarget& target, const YamlNode& node,
                                          const std::string& path) {
    const YamlNode& value = *node.find("value")->value;
    TargetMeasure m;
    try {
      m.unit = si_unit_of(target.value);
      const Quantity q = read_quantity(target.value, m.unit);
      m.value = q.si;
      m.written = m.unit == "1" ? "" : q.unit;
      m.factor = m.unit == "1" ? 1 : q.factor;
      if (m.unit != "1" && q.offset != 0)
        throw UserError("`" + q.unit + "` does not begin at zero: write it in " + m.unit);
    } catch (const UserError& e) {
      report(value, path + ".value", e.what());
      return {};
    }
    // Of what else a key is only its summary can tell.
    if ((m.unit == "Pa") != target.key.ends_with(ResultName("", "Pa").key()))
      report(value, path + ".value",
             "`" + target.value + "` is " + dimension_name(m.unit) + ", and `" + target.key + "` is " +
                 (m.unit == "Pa" ? "none" : "in Pa"));
    const bool may_be_log = m.value > 0;
    m.log = target.scale ? *target.scale == TargetScale::log : may_be_log && m.unit != "1";
    if (m.log && !may_be_log)
      report(value, path + ".value", "must be above 0 on a log scale, not `" + target.value + "`");
    const auto scatter = scatter_of(target, node, path, m);
    if (!scatter) return {};
    m.scatter = *scatter;
    return m;
  }

  std::optional<double> scatter_of(const CalibrationTarget& target, const YamlNode& node, const std::string& path,
                                   const TargetMeasure& m) {
    const YamlNode& at = target.scatter ? *node.find("scatter")->value : node;
    double scatter = 0.05 * std::abs(m.value) / std::sqrt(target.weight.value_or(1));
    if (target.scatter) {
      const std::string text = trimmed_text(*target.scatter);
      try {
        scatter = text.ends_with("%") ? parse_quantity(text, "1") * std::abs(m.value) : parse_quantity(text, m.unit);
      } catch (const UserError& e) {
        report(at, path + ".scatter", e.what());
        return {};
      }
    }
    if (scatter > 0) return scatter;
    report(at, path + (target.scatter ? ".scatter" : ""),
           m.value == 0 ? "a target of 0 needs a `scatter`, with its unit" : "the scatter must be above 0");
    return {};
  }

  std::vector<bool> workflows_of(const CalibrationParameter& parameter, const YamlNode& node, const std::string& path) {
    std::vector<bool> of(loaded_.workflows.size(), !parameter.workflows);
    if (!parameter.workflows) return of;
    const std::vector<std::string> names = workflow_names();
    const YamlNode& list = *node.find("workflows")->value;
    if (list.items.empty()) report(list, path + ".workflows", "names no workflow");
    for (std::size_t k = 0; k < list.items.size(); ++k) {
      const std::string& name = (*parameter.workflows)[k];
      const auto at = std::find(names.begin(), names.end(), name);
      if (at != names.end()) of[std::size_t(at - names.begin())] = true;
      else
        report(*list.items[k], item_path(path + ".workflows", k),
               "there is no workflow `" + name + "`" + suggestion(name, names));
    }
    return of;
  }

  /// No place of a workflow gets its value from two sides.
  void take(const std::string& to, const LoadedCalibration::Parameter& p, const std::string& path) {
    const auto refuse = [&](const std::string& by) {
      findings_.push_back({p.place, path, "`" + to + "` gets its value from " + by + " as well"});
    };
    if (to == "seed") findings_.push_back({p.place, path, "the seed is not sought: it tells the packings apart"});
    for (std::size_t w = 0; w < loaded_.workflows.size(); ++w) {
      if (!p.of_workflow[w]) continue;
      for (const auto& other : loaded_.parameters)
        if (other.of_workflow[w] && std::find(other.paths.begin(), other.paths.end(), to) != other.paths.end())
          return refuse("the parameter `" + other.name + "`");
      for (const PlacedValue& v : loaded_.workflows[w].set)
        if (v.path == to) return refuse("`workflows." + loaded_.workflows[w].name + ".set`");
    }
    if (std::count(p.paths.begin(), p.paths.end(), to) > 1) refuse("this parameter");
  }

  struct End {
    double value;
    std::string unit;
  };
  std::optional<End> end(const YamlNode& node, const std::string& path) {
    const auto number = scan_decimal(node.text);
    const auto value = number ? to_double(*number) : std::nullopt;
    if (value) return End{*value, node.text.substr(number->length)};
    report(node, path, "`" + node.text + "` does not begin with a number");
    return {};
  }

  std::optional<ParameterScale> scale_of(const CalibrationParameter& parameter, const YamlNode& node,
                                         const std::string& path) {
    const YamlNode &from_node = *node.find("from")->value, &to_node = *node.find("to")->value;
    const auto from = end(from_node, path + ".from"), to = end(to_node, path + ".to");
    if (!from || !to) return {};
    const ParameterScale scale{from->value, to->value, from->unit, parameter.scale == LatinScale::log};
    if (from->unit != to->unit)
      report(to_node, path + ".to",
             "must be in the unit of `from`, `" + parameter.from + "`, not `" + parameter.to + "`");
    else if (scale.log && !(from->value > 0))
      report(from_node, path + ".from", "must be above 0 on a log scale, not `" + parameter.from + "`");
    else if (!(from->value < to->value))
      report(to_node, path + ".to", "must be above `from`, `" + parameter.from + "`, not `" + parameter.to + "`");
    else return scale;
    return {};
  }

  std::optional<double> start_of(const YamlNode& node, const ParameterScale& scale,
                                 const CalibrationParameter& parameter, const std::string& path) {
    const auto start = end(node, path + ".start");
    if (!start) return {};
    if (start->unit != scale.unit)
      report(node, path + ".start", "must be in the unit of `from`, `" + parameter.from + "`, not `" + node.text + "`");
    else if (start->value < scale.from || start->value > scale.to)
      report(node, path + ".start",
             "must be in the range from `" + parameter.from + "` to `" + parameter.to + "`, not `" + node.text + "`");
    else return scale.share(node.text);
    return {};
  }

  /// In a specimen that is elastic until bonds break, slow and without weight, lengths and ratios left as they are,
  /// stresses are in proportion to what all moduli of bonds and contacts are, and to all their strengths.
  std::vector<std::size_t> targets_for(const LoadedCalibration::Parameter& p, const CalibrationParameter& parameter,
                                       const YamlNode& node, const std::string& path) {
    std::vector<std::size_t> with;
    if (!parameter.scales_with) {
      if (p.scale.from <= 0) return with;
      const auto says = [](const std::string& text, std::initializer_list<const char*> words) {
        return std::any_of(words.begin(), words.end(), [&](const char* w) { return text.find(w) != text.npos; });
      };
      const std::string last = split_path(p.paths.front()).back().name;
      const bool stiff = says(last, {"modulus", "stiffness"}) && !says(last, {"ratio"});
      const bool strong = !stiff && says(last, {"strength", "cohesion"}) && !says(last, {"ratio"});
      for (std::size_t t = 0; t < loaded_.targets.size(); ++t) {
        const std::string& key = loaded_.targets[t].key;
        if (loaded_.targets[t].measure.unit != "Pa" || loaded_.targets[t].measure.value <= 0) continue;
        if ((stiff && says(key, {"modulus"})) || (strong && says(key, {"stress", "strength"}))) with.push_back(t);
      }
      return with;
    }
    if (*parameter.scales_with == "nothing") return with;
    std::vector<std::string> names{"nothing"};
    for (std::size_t t = 0; t < loaded_.targets.size(); ++t) {
      names.push_back(loaded_.targets[t].name);
      if (names.back() == *parameter.scales_with) with.push_back(t);
    }
    const YamlNode& at = *node.find("scales_with")->value;
    if (with.empty())
      report(at, path + ".scales_with",
             "there is no target `" + *parameter.scales_with + "`" + suggestion(*parameter.scales_with, names));
    else if (!(p.scale.from > 0) || !(loaded_.targets[with[0]].measure.value > 0))
      report(at, path + ".scales_with", "only what is above 0 can be in proportion");
    return with;
  }

  LoadedCalibration& loaded_;
  const Calibration& config_;
  const YamlNode& tree_;
  std::vector<Finding>& findings_;
};

void refuse_others(const BaseChain& chain, const std::string& file) {
  const YamlPtr tree = chain.files.empty() ? nullptr : chain.files[0].tree;
  if (!tree || is_calibration(chain)) return;
  const auto refuse = [&](const char* what, const char* verb) {
    throw UserError(file + ": this is a " + what + ", not a calibration: `breccia " + verb + " " + file + "` runs it");
  };
  if (tree->find("packing") || tree->find("protocol") || tree->find("base")) refuse("workflow", "run");
  if (tree->find("workflow") || tree->find("grid") || tree->find("list") || tree->find("latin_hypercube"))
    refuse("study", "sweep");
}

}  // namespace

LoadedCalibration load_calibration(const fs::path& file, Registry& registry) {
  const BaseChain chain = single_file(read_text(file), file.string(), "calibration");
  refuse_others(chain, file.string());
  if (chain.whole)
    for (const Json& plugin : read_section(chain, calibration_schema(), "plugins"))
      registry.add(plugin.at("path").get<std::string>());
  if (chain.whole) refuse_missing_usual_search(chain.files[0], registry);
  const Json config = read_config(chain, calibration_schema(), registry);
  Schema<Calibration> schema;
  Calibration::describe(schema);
  LoadedCalibration loaded;
  loaded.config = schema.load(config);
  loaded.file = chain.files[0];
  loaded.path = file;
  if (loaded.config.name.empty()) loaded.config.name = file.stem().string();
  if (loaded.config.search) loaded.search = loaded.config.search->type;
  else if (has_usual_search(registry)) loaded.search = usual_search;
  std::vector<Finding> findings;
  Checker checker(loaded, findings);
  checker.name();
  checker.workflows();
  checker.targets();
  checker.parameters();
  checker.stages();
  checker.run_time();
  if (findings.empty()) {
    try {
      plan_course(loaded);
    } catch (const UserError& e) {
      findings.push_back({loaded.file.tree->find("budget")->value->place, "budget", e.what()});
    }
  }
  if (!findings.empty()) refuse(std::move(findings), chain.files);
  return loaded;
}

}  // namespace breccia
