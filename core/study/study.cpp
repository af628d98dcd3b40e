// SPDX-License-Identifier: BSD-3-Clause
#include "study/study.hpp"

#include <algorithm>

#include "config/reader.hpp"
#include "config/result_name.hpp"
#include "config/suggest.hpp"

namespace breccia {

namespace fs = std::filesystem;

void StudyWorkflow::describe(Schema<StudyWorkflow>& s) {
  s.param("name", &StudyWorkflow::name)
      .example("tension")
      .doc("in the column `workflow` and before its values: `tension.peak_stress_Pa`");
  s.param("file", &StudyWorkflow::file).example("direct_tension.yaml").doc("the workflow, relative to the study");
}

void StudyRatio::describe(Schema<StudyRatio>& s) {
  s.param("name", &StudyRatio::name).example("ucs_over_ts").doc("of the column");
  s.param("numerator", &StudyRatio::numerator)
      .example("compression.peak_stress_Pa")
      .doc("a value of the summary, with several workflows after the name of one; or a parameter that varies (in SI)");
  s.param("denominator", &StudyRatio::denominator).example("tension.peak_stress_Pa").doc("the same");
}

std::string StudyChartConfig::file_name() const {
  return name.value_or(y + "_over_" + x + (series ? "_by_" + *series : ""));
}

void StudyChartConfig::describe(Schema<StudyChartConfig>& s) {
  s.param("x", &StudyChartConfig::x)
      .example("contact_law.friction")
      .doc(
          "a parameter that varies, a value of the summary (with several workflows after the name of one) or a derived "
          "column");
  s.param("y", &StudyChartConfig::y).example("peak_stress_Pa").doc("the same");
  s.param("series", &StudyChartConfig::series)
      .example("contact_law.stiffness_ratio")
      .doc("a parameter that varies: one line for each of its values");
  s.param("name", &StudyChartConfig::name).doc("file name without its ending; `Y_over_X_by_SERIES` if absent");
  s.param("x_label", &StudyChartConfig::x_label).example("ks/kn").doc("title of the horizontal axis, without the unit");
  s.param("y_label", &StudyChartConfig::y_label).doc("title of the vertical axis, without the unit");
}

void Study::describe(Schema<Study>& s) {
  const Json none = Json::array();
  s.summary("A parameter study: workflows and the values of their parameters");
  s.param("name", &Study::name).fallback("").doc("of the result folder; default: the name of the file");
  s.param("description", &Study::description).fallback("").doc("what it shows");
  s.param("workflow", &Study::workflow)
      .example("compression.yaml")
      .doc("the workflow whose parameters vary, relative to the study");
  s.param("workflows", &Study::workflows).items(1, 100).doc("several of them, each run at every point");
  s.exactly_one_of({"workflow", "workflows"});
  s.param("fixed", &Study::fixed)
      .fallback(Json::object())
      .doc(
          "values for all cases, path to value: `damping.translational: 0.1`, `outputs: []`; paths as for `--set`, in "
          "every "
          "workflow");
  s.param("grid", &Study::grid)
      .fallback(Json::object())
      .doc("all combinations of these, path to values: `contact_law.friction: [0.2, 0.4]`");
  s.param("list", &Study::list)
      .fallback(Json::object())
      .doc("path to values, all of one length: the first of each together, the second of each, and so on");
  s.param("latin_hypercube", &Study::latin_hypercube)
      .doc(
          "points spread over ranges, each parameter's evenly. Of `grid`, `list` and this, several may be given: all "
          "their "
          "combinations are run")
      .source("McKay, Beckman, Conover (1979), Technometrics 21, 239-245");
  s.param("collect", &Study::collect)
      .fallback(none)
      .doc(
          "values of summary.json for results.csv, by their dotted paths; default: all numbers of its top level that "
          "tell of the "
          "specimen");
  s.param("derived", &Study::derived).fallback(none).doc("quotients as further columns of results.csv");
  s.param("charts", &Study::charts).fallback(none).doc("charts of results.csv");
  s.param("renderer", &Study::renderer).kind("renderer").doc("of the charts; default: `pictures`, if installed");
}

const ParamSpec& study_schema() {
  static const Schema<Study> schema = [] {
    Schema<Study> s;
    Study::describe(s);
    return s;
  }();
  return schema.documentation().root;
}

namespace {

std::string shown_file(const fs::path& study, const YamlNode& node) {
  return (study.parent_path() / node.text).lexically_normal().string();
}

/// What the schema cannot say of a study.
class Checker {
 public:
  Checker(LoadedStudy& loaded, const fs::path& file, std::vector<Finding>& findings)
      : loaded_(loaded), tree_(*loaded.file.tree), file_(file), findings_(findings) {}

  void workflows() {
    if (const YamlEntry* one = tree_.find("workflow")) {
      loaded_.workflow_names = {""};
      add_workflow(*one->value);
      return;
    }
    const YamlNode& all = *tree_.find("workflows")->value;
    for (std::size_t k = 0; k < all.items.size(); ++k) {
      const YamlNode& name = *all.items[k]->find("name")->value;
      const std::string path = item_path("workflows", k) + ".name";
      const auto is_other = [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-'; };
      if (name.text.empty() || std::any_of(name.text.begin(), name.text.end(), is_other))
        report(name, path, "`" + name.text + "` is no name; letters, digits, `_` and `-` make one");
      else check_new(loaded_.workflow_names, name, path);
      loaded_.workflow_names.push_back(name.text);
      add_workflow(*all.items[k]->find("file")->value);
    }
  }

  /// That of the study itself: of its folder below results/.
  void name() {
    const std::string why = why_not_a_file_name(loaded_.study.name);
    if (why.empty()) return;
    const YamlEntry* given = tree_.find("name");
    findings_.push_back({given ? given->value->place : tree_.place, "name",
                         "`" + loaded_.study.name + "` cannot be the name of the result folder, it " + why});
  }

  void fixed() {
    const YamlEntry* section = tree_.find("fixed");
    if (!section) return;
    for (const YamlEntry& entry : section->value->entries) {
      if (entry.value->kind == YamlNode::Kind::null)
        findings_.push_back({entry.place, "fixed." + entry.key, "has no value"});
      for (const StudyParameter& p : loaded_.parameters)
        if (p.path == entry.key)
          findings_.push_back({entry.place, "fixed." + entry.key, "also varies; it is either fixed or not"});
      loaded_.fixed.push_back({entry.key, entry.place, entry.value});
    }
  }

  void columns() {
    std::vector<std::string> names;
    each("derived", [&](const YamlNode& item, const std::string& path) {
      const YamlNode& name = *item.find("name")->value;
      if (name.text.empty()) report(name, path + ".name", "is empty");
      else check_new(names, name, path + ".name");
      for (const StudyParameter& p : loaded_.parameters)
        if (p.path == name.text) report(name, path + ".name", "`" + name.text + "` is a parameter already");
      names.push_back(name.text);
      check_term(*item.find("numerator")->value, path + ".numerator", false);
      check_term(*item.find("denominator")->value, path + ".denominator", false);
    });
    std::vector<std::string> files;
    std::size_t k = 0;
    each("charts", [&](const YamlNode& item, const std::string& path) {
      check_term(*item.find("x")->value, path + ".x", true);
      check_term(*item.find("y")->value, path + ".y", true);
      if (const YamlEntry* series = item.find("series")) check_parameter(*series->value, path + ".series");
      const std::string name = loaded_.study.charts[k++].file_name();
      if (!why_not_a_file_name(name).empty())
        report(item, path, "`" + name + "` cannot be a file name; give the chart another `name`");
      if (std::find(files.begin(), files.end(), name) != files.end())
        report(item, path, "a second chart named `" + name + "`; give one of them another `name`");
      files.push_back(name);
    });
    std::vector<std::string> collected;
    if (const YamlEntry* collect = tree_.find("collect"))
      for (std::size_t i = 0; i < collect->value->items.size(); ++i) {
        check_new(collected, *collect->value->items[i], item_path("collect", i));
        collected.push_back(collect->value->items[i]->text);
      }
  }

 private:
  void report(const YamlNode& at, const std::string& path, std::string text) {
    findings_.push_back({at.place, path, std::move(text)});
  }

  void add_workflow(const YamlNode& node) {
    loaded_.workflow_files.push_back(shown_file(file_, node));
    loaded_.workflow_places.push_back(node.place);
  }

  void check_new(const std::vector<std::string>& before, const YamlNode& name, const std::string& path) {
    if (std::find(before.begin(), before.end(), name.text) != before.end())
      report(name, path, "a second `" + name.text + "`");
  }

  template <class Each>
  void each(const char* list, Each&& item) {
    if (const YamlEntry* entry = tree_.find(list))
      for (std::size_t k = 0; k < entry->value->items.size(); ++k) item(*entry->value->items[k], item_path(list, k));
  }

  std::vector<std::string> parameter_names() const {
    std::vector<std::string> names;
    for (const StudyParameter& p : loaded_.parameters) names.push_back(p.path);
    return names;
  }

  void check_parameter(const YamlNode& node, const std::string& path) {
    const std::vector<std::string> names = parameter_names();
    if (std::find(names.begin(), names.end(), node.text) == names.end())
      report(node, path, "`" + node.text + "` is not a parameter that varies" + suggestion(node.text, names));
  }

  /// With one workflow only its summaries will tell which values there are.
  void check_term(const YamlNode& node, const std::string& path, bool with_derived) {
    std::vector<std::string> names = parameter_names();
    if (with_derived)
      for (const StudyRatio& d : loaded_.study.derived) names.push_back(d.name);
    if (std::find(names.begin(), names.end(), node.text) != names.end() ||
        loaded_.workflow_names == std::vector<std::string>{""})
      return;
    for (const std::string& w : loaded_.workflow_names)
      if (node.text.starts_with(w + ".") && node.text.size() > w.size() + 1) return;
    const std::size_t dot = node.text.find('.');
    for (const std::string& w : loaded_.workflow_names) {
      names.push_back(w + "." + node.text);
      if (dot != node.text.npos) names.push_back(w + node.text.substr(dot));  // the workflow's name may be the mistake
    }
    const std::string near = closest(node.text, names);
    report(node, path,
           "`" + node.text + "` is neither a parameter that varies" + (with_derived ? ", nor a derived column," : "") +
               " nor a value of one of the workflows; did you mean `" + (near.empty() ? names.back() : near) + "`?");
  }

  LoadedStudy& loaded_;
  const YamlNode& tree_;
  const fs::path& file_;
  std::vector<Finding>& findings_;
};

}  // namespace

StudyTerm LoadedStudy::term(const std::string& name) const {
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (parameters[k].path == name) return {StudyTerm::Is::parameter, k, ""};
  for (std::size_t k = 0; k < study.derived.size(); ++k)
    if (study.derived[k].name == name) return {StudyTerm::Is::derived, k, ""};
  for (std::size_t k = 0; k < workflow_names.size(); ++k)
    if (!workflow_names[k].empty() && name.starts_with(workflow_names[k] + "."))
      return {StudyTerm::Is::value, k, name.substr(workflow_names[k].size() + 1)};
  return {StudyTerm::Is::value, 0, name};
}

LoadedStudy load_study(const fs::path& file, const Registry& registry) {
  const BaseChain chain = single_file(read_text(file), file.string(), "study");
  const Json config = read_config(chain, study_schema(), registry);
  Schema<Study> schema;
  Study::describe(schema);
  LoadedStudy loaded;
  loaded.study = schema.load(config);
  loaded.file = chain.files[0];
  if (loaded.study.name.empty()) loaded.study.name = file.stem().string();
  std::vector<Finding> findings;
  StudyDesign design = make_design(*loaded.file.tree, loaded.study.latin_hypercube, findings);
  loaded.parameters = std::move(design.parameters);
  loaded.points = std::move(design.points);
  Checker checker(loaded, file, findings);
  checker.name();
  checker.workflows();
  checker.fixed();
  if (!findings.empty()) refuse(std::move(findings), chain.files);
  checker.columns();
  loaded.of_columns = problems_of(std::move(findings), chain.files);
  return loaded;
}

}  // namespace breccia
