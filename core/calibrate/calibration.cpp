// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/calibration.hpp"

namespace breccia {

void CalibrationWorkflow::describe(Schema<CalibrationWorkflow>& s) {
  s.param("file", &CalibrationWorkflow::file).example("ucs.yaml").doc("the workflow, relative to the calibration");
  s.param("variant", &CalibrationWorkflow::variant).example("small").doc("one of its `variants`");
  s.param("set", &CalibrationWorkflow::set)
      .fallback(Json::object())
      .doc("values of this workflow, path to value, paths as for `--set`: `outputs: []`");
}

void CalibrationTarget::describe(Schema<CalibrationTarget>& s) {
  s.param("workflow", &CalibrationTarget::workflow)
      .example("ucs")
      .doc("which of the workflows measures it; may be left out where there is one");
  s.param("key", &CalibrationTarget::key).example("peak_stress_Pa").doc("of its summary.json, as a dotted path");
  s.param("value", &CalibrationTarget::value).example("120 MPa").doc("what the laboratory measured, with its unit");
  s.param("scatter", &CalibrationTarget::scatter)
      .example("12 MPa")
      .doc("its standard deviation, with a unit or in per cent of the value");
  s.param("weight", &CalibrationTarget::weight)
      .above(0)
      .doc(
          "where no scatter is known: the target counts as if its scatter were 5 % divided by the square root of this; "
          "default 1");
  s.at_most_one_of({"scatter", "weight"});
  s.param("scale", &CalibrationTarget::scale)
      .choice("linear", TargetScale::linear, "differences")
      .choice("log", TargetScale::log, "ratios")
      .doc("what counts as equally far; default: `log` for quantities above 0 with a unit, else `linear`");
}

void CalibrationParameter::describe(Schema<CalibrationParameter>& s) {
  s.param("path", &CalibrationParameter::path)
      .example("contact_law.1.tensile_strength")
      .doc("where it stands in the workflows, as for `--set`");
  s.param("paths", &CalibrationParameter::paths)
      .example("[contact_law.0.contact_modulus, contact_law.1.bond_modulus]")
      .doc("several places that get the same value");
  s.exactly_one_of({"path", "paths"});
  s.param("from", &CalibrationParameter::from).example("10 GPa").doc("least value");
  s.param("to", &CalibrationParameter::to).example("100 GPa").doc("largest value, in the unit of `from`");
  s.param("scale", &CalibrationParameter::scale)
      .choice("linear", LatinScale::linear, "differences count")
      .choice("log", LatinScale::log, "ratios count: moduli, strengths")
      .fallback("linear")
      .doc("how the range is searched");
  s.param("start", &CalibrationParameter::start)
      .example("30 GPa")
      .doc("a first guess, in the unit of `from`; default: the middle of the range");
  s.param("workflows", &CalibrationParameter::workflows)
      .example("[ucs]")
      .doc("which of the workflows have it; default: all");
  s.param("scales_with", &CalibrationParameter::scales_with)
      .example("ucs")
      .doc(
          "the target in proportion to which it is guessed anew after the first run, or `nothing`. Default: a modulus "
          "or a stiffness with targets called a modulus, other pressures with targets called a stress or a strength");
}

void CalibrationStage::describe(Schema<CalibrationStage>& s) {
  s.param("name", &CalibrationStage::name).example("small").doc("for tables");
  s.param("share", &CalibrationStage::share).above(0).at_most(1).example("60 %").doc("of the points");
  s.param("variant", &CalibrationStage::variant).example("small").doc("one of the `variants` that all workflows have");
  s.param("set", &CalibrationStage::set)
      .fallback(Json::object())
      .doc("values of all workflows in this stage, path to value");
}

void CalibrationBudget::describe(Schema<CalibrationBudget>& s) {
  s.param("runs", &CalibrationBudget::runs).at_least(1).at_most(100000).example("60").doc("of all workflows together");
  s.param("packings", &CalibrationBudget::packings)
      .at_least(1)
      .at_most(100)
      .fallback(1)
      .doc("of each point and workflow: runs that differ in the seed alone");
  s.param("start_packings", &CalibrationBudget::start_packings)
      .at_least(2)
      .at_most(100)
      .fallback(3)
      .doc("of the first point: they tell how much results scatter");
  s.param("check_packings", &CalibrationBudget::check_packings)
      .at_least(1)
      .at_most(100)
      .fallback(3)
      .doc("of the best point at the end, none of which was used before");
  s.param("batch", &CalibrationBudget::batch)
      .at_least(1)
      .at_most(1000)
      .fallback(2)
      .doc("points that are proposed together: their runs can go on at once, but know nothing of each other");
  s.param("run_time", &CalibrationBudget::run_time)
      .unit("s")
      .above(0)
      .example("5 min")
      .doc(
          "wall-clock time of one run, packing included: one that takes longer is ended and counts as failed. It "
          "depends on the machine, and with it the path of the search; what was decided once stands. Default: no "
          "limit");
  s.param("stages", &CalibrationBudget::stages)
      .items(1, 10)
      .doc(
          "one after the other, on the way from cheap to true specimens: what a stage has taught goes on with its "
          "difference to the next");
}

void Calibration::describe(Schema<Calibration>& s) {
  s.summary("A calibration: parameters of workflows that are sought, and what the laboratory measured");
  s.param("name", &Calibration::name).fallback("").doc("of the result folder; default: the name of the file");
  s.param("description", &Calibration::description).fallback("").doc("which rock, from where");
  s.param("workflows", &Calibration::workflows).items(1, 50).doc("the tests, by names of your own");
  s.param("targets", &Calibration::targets).items(1, 50).doc("what was measured, by names of your own");
  s.param("parameters", &Calibration::parameters).items(1, 20).doc("what is sought, by names of your own");
  s.param("budget", &Calibration::budget).doc("how many runs it may cost");
  s.param("plugins", &Calibration::plugins)
      .fallback(Json::array())
      .doc("searches from outside Breccia's own folder: shared libraries or folders of them, relative to this file");
  s.param("search", &Calibration::search)
      .kind("search")
      .doc("what proposes the points; default: `kriging`, with its own defaults");
  s.param("seed", &Calibration::seed)
      .at_least(0)
      .at_most(1e9)
      .fallback(1)
      .doc("of the search, and of the first packing; each packing has one of its own");
  s.param("jobs", &Calibration::jobs)
      .at_least(1)
      .at_most(1024)
      .doc("runs at a time, where the command line does not say; the results do not depend on it");
  s.param("renderer", &Calibration::renderer).kind("renderer").doc("of the charts; default: `pictures`, if installed");
}

const ParamSpec& calibration_schema() {
  static const Schema<Calibration> schema = [] {
    Schema<Calibration> s;
    Calibration::describe(s);
    return s;
  }();
  return schema.documentation().root;
}

}  // namespace breccia
