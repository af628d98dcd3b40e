// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command_line.hpp"

#include "cli/command_model.hpp"
#include "cli/verbs.hpp"

namespace breccia {

int cli::with_command_line(const std::function<int(CLI::App&, const int&)>& use) {
  CLI::App app{"Breccia: bonded-particle mechanics of rock and concrete"};
  app.set_version_flag("--version", "breccia " BRECCIA_VERSION);
  app.require_subcommand(1);
  int code = cli::ok;

  cli::RunArguments run;
  CLI::App* verb = app.add_subcommand("run", "Run a workflow");
  auto* run_file = verb->add_option("FILE", run.file, "the workflow (YAML)");
  auto* resume = verb->add_option("--resume", run.resume,
                                  "a folder of results: goes on from its newest checkpoint, with the workflow that "
                                  "stands there, to the same results as if the run had not been stopped")
                     ->type_name("FOLDER")
                     ->excludes(run_file);
  verb->add_option("--from", run.from,
                   "a checkpoint of another run, or the folder of its results: begins where that run stood, as `from` "
                   "of a workflow does")
      ->type_name("CHECKPOINT")
      ->excludes(resume);
  verb->add_flag("--accept-changed-plugins", run.accept_changed_plugins,
                 "go on although a plugin or a file that was read is another one than at the beginning");
  verb->add_option("--output", run.output, "folder of the results; default: results/<workflow name>")
      ->type_name("FOLDER")
      ->excludes(resume);
  verb->add_flag("--overwrite", run.overwrite, "replace the results of an earlier run in that folder");
  verb->add_option("--threads", run.threads, "threads; default: all cores. The results do not depend on it")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--variant", run.variant,
                   "one of the workflow's `variants`: what it says is laid over the workflow");
  verb->add_option("--set", run.overrides, "replace a value: path=value, e.g. contact_law.friction=0.3")
      ->expected(1)
      ->take_all();
  for (const char* own : {"--overwrite", "--variant", "--set"}) verb->get_option(own)->excludes(resume);
  verb->callback([&, run_file, resume] {
    if (run_file->empty() && resume->empty()) throw CLI::RequiredError("FILE or --resume");
    code = cli::run(run);
  });

  std::vector<std::filesystem::path> files;
  std::vector<std::string> overrides;
  std::string variant;
  verb = app.add_subcommand("validate", "Check workflows without running them");
  verb->add_option("FILE", files, "workflows")->required();
  verb->add_option("--set", overrides, "replace a value, as for run")->expected(1)->take_all();
  verb->add_option("--variant", variant,
                   "only this of the workflows' `variants`; default: the workflow and each of them");
  verb->callback([&] { code = cli::validate(files, overrides, variant); });

  std::string kind;
  verb = app.add_subcommand("list", "List the plugins");
  verb->add_option("KIND", kind, "only this kind");
  verb->callback([&] { code = cli::list(kind); });

  std::string plugin, format = "text";
  verb = app.add_subcommand("describe", "Describe a plugin and its parameters");
  verb->add_option("TOPIC", plugin,
                   "KIND/NAME, or NAME alone; a KIND for its plugins; workflow, sweep or calibration for the keys of "
                   "these files")
      ->required();
  verb->add_option("--format", format, "text, markdown or json")->check(CLI::IsMember({"text", "markdown", "json"}));
  verb->callback([&] { code = cli::describe(plugin, format); });

  cli::CheckArguments check;
  verb = app.add_subcommand("check", "Try a plugin on small cases: whether it is what its kind promises");
  verb->add_option("PLUGIN", check.plugin, "KIND/NAME, or NAME alone")->required();
  verb->add_option("--plugin", check.plugins, "a plugin from outside Breccia's own folder, by its file or folder")
      ->type_name("LIBRARY")
      ->expected(1)
      ->take_all();
  verb->add_option("--set", check.overrides, "a parameter of the plugin; default: its default or example: friction=0.3")
      ->expected(1)
      ->take_all();
  verb->callback([&] { code = cli::check(check); });

  cli::RenderArguments render;
  verb = app.add_subcommand("render", "Make pictures from the files of a run");
  verb->add_option("SOURCE", render.source, "result folder, .pvd, .vtp or .pvtp file")->required();
  verb->add_option("--output", render.output, "folder of the pictures; default: beside the source")
      ->type_name("FOLDER");
  verb->add_flag("--overwrite", render.overwrite, "replace pictures of the same names");
  verb->add_option("--renderer", render.renderer, "renderer plugin")->type_name("RENDERER");
  verb->add_option("--set", render.overrides, "replace a setting of the renderer: path=value")->expected(1)->take_all();
  verb->callback([&] { code = cli::render(render); });

  cli::CompareArguments compare;
  verb = app.add_subcommand("compare", "Put finished runs beside each other: tables and charts");
  verb->footer(
      "Makes comparison.csv (every number of every run), comparison.md (a table to read, with each run's\n"
      "reference values and the distance in per cent) and charts of the runs' curves over each other.\n"
      "Example: breccia compare results/model_1 results/model_2 --labels \"model 1=results/model_1\" -o "
      "results/models");
  verb->add_option("DIR", compare.folders, "result folders of finished runs; that of a study stands for its cases")
      ->required();
  verb->add_option("-o,--output", compare.output, "folder of the comparison")
      ->type_name("FOLDER")
      ->capture_default_str();
  verb->add_option("--labels", compare.labels,
                   "names of runs: LABEL=DIR,LABEL=DIR or once for each; default: the folders' names")
      ->expected(1)
      ->take_all()
      ->delimiter(',');
  verb->add_flag("--overwrite", compare.overwrite,
                 "the folder may hold files: those of the same names are replaced, no other is touched");
  verb->add_option("--renderer", compare.renderer, "renderer plugin of the charts; default: pictures, if installed")
      ->type_name("RENDERER");
  verb->add_option("--set", compare.overrides, "replace a setting of the renderer: path=value")
      ->expected(1)
      ->take_all();
  verb->callback([&] { code = cli::compare(compare); });

  cli::ReportArguments report;
  verb = app.add_subcommand(
      "report", "Write a report of a run, a study or a calibration: one HTML file, and a paragraph for a paper");
  verb->footer(
      "Makes report.html (results, charts, pictures, model, energy balance, warnings, input, versions; one file that\n"
      "needs no other), methods.md (for the methods section of a paper) and ro-crate-metadata.json (for repositories)\n"
      "in the folder of the results. With -o: FILE.html and FILE.methods.md, and nothing in that folder.\n"
      "Example: breccia report results/my --author \"A. Name\" --licence CC-BY-4.0");
  verb->add_option("DIR", report.folder, "result folder of a run, a study or a calibration")->required();
  verb->add_option("-o,--output", report.output, "the report; default: report.html among the results")
      ->type_name("HTML");
  verb->add_flag("--overwrite", report.overwrite, "replace an earlier report");
  verb->add_option("--author", report.authors, "author of the results; once for each")
      ->type_name("AUTHOR")
      ->expected(1)
      ->take_all();
  verb->add_option("--licence", report.licence, "licence of the results: an SPDX name such as CC-BY-4.0, or an address")
      ->type_name("LICENCE");
  verb->callback([&] { code = cli::report(report); });

  cli::DriveArguments drive;
  verb = app.add_subcommand("drive", "Lead one contact of two particles along a path: what a contact law does");
  verb->footer(
      "The path is a CSV file: a header of normal_m, shear_m, rotation_rad, twist_rad and time_s (any of them),\n"
      "then one row for each way point, counted from the start at zero. Makes curves.csv (forces, history and\n"
      "energies of every increment), summary.json and charts of force over displacement.\n"
      "Example: breccia drive elastic_brittle --path path.csv --set contact_law.bond_modulus=\"10 GPa\" ...");
  verb->add_option("TARGET", drive.target,
                   "a workflow (its contact_law, material and dimension are used), or the name of a contact law")
      ->required();
  verb->add_option("--path", drive.path, "the path (CSV)")->type_name("CSV")->required();
  verb->add_option("-o,--output", drive.output, "folder of the results; default: results/drive_<law>")
      ->type_name("FOLDER");
  verb->add_flag("--overwrite", drive.overwrite, "replace the results of an earlier run in that folder");
  verb->add_option(
          "--set", drive.overrides,
          "replace a value: path=value, as for run; of a law by name also material.density, dimension, thickness")
      ->expected(1)
      ->take_all();
  verb->add_option("--radius", drive.radius, "of both particles, or of each: 1mm,2mm; default: 1 mm")
      ->expected(1)
      ->take_all()
      ->delimiter(',');
  verb->add_option("--gap", drive.gap,
                   "between the surfaces at the start, with unit; below zero: overlap; default: they touch");
  verb->add_flag("--unbonded", drive.unbonded, "the two are not glued together");
  verb->add_option("--steps", drive.steps, "equal increments between two way points; with time_s: on the shortest way")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  verb->add_option("--porosity", drive.porosity, "what a law is told of the specimen around the pair; default: 25 %");
  verb->add_option("--coordination-number", drive.coordination_number, "the same: mean number of bonds per particle")
      ->capture_default_str();
  verb->callback([&] { code = cli::drive(drive); });

  cli::SweepArguments sweep;
  verb = app.add_subcommand("sweep", "Run a parameter study: a workflow at many values of its parameters");
  verb->footer(
      "Runs every case into a folder of its own below cases/, several at a time, and gathers results.csv and the\n"
      "charts that the study asks for. Cases that have finished are not run again. Elsewhere (a Slurm array, "
      "Snakemake):\n"
      "--cases lists them, --case runs one, --collect gathers. Keys of a study: breccia describe sweep.\n"
      "Exit code: 0 all cases have finished, 1 some have not, 2 the study is not in order, 130 stopped on request.");
  verb->add_option("STUDY", sweep.study, "the study (YAML)")->required();
  verb->add_option("-o,--output", sweep.output, "folder of the results; default: results/<study name>")
      ->type_name("FOLDER");
  auto* jobs = verb->add_option("-j,--jobs", sweep.jobs, "cases at a time; default: as many as keep all cores busy")
                   ->check(CLI::Range(1, 1024));
  auto* threads = verb->add_option("--threads", sweep.threads, "threads of each case. The results do not depend on it")
                      ->check(CLI::Range(1, 1024))
                      ->capture_default_str();
  auto* overwrite = verb->add_flag("--overwrite", sweep.overwrite,
                                   "run finished cases again whose study or workflow has changed since");
  auto* cases = verb->add_flag("--cases", sweep.cases, "list the cases (CSV) and run none");
  auto* one = verb->add_option("--case", sweep.one, "run only this case: its number, or its folder's name");
  auto* collect = verb->add_flag("--collect", sweep.collect, "run none: gather what has finished");
  auto* expect = verb->add_option("--expect", sweep.expect)->group("");
  auto* parent = verb->add_option("--parent", sweep.parent)->group("");
  cases->excludes(jobs)->excludes(threads)->excludes(overwrite)->excludes(one)->excludes(collect);
  collect->excludes(jobs)->excludes(threads)->excludes(overwrite)->excludes(one);
  one->excludes(jobs);
  expect->needs(one);
  parent->needs(one);
  verb->callback([&] { code = cli::sweep(sweep); });

  cli::CalibrateArguments calibrate;
  verb = app.add_subcommand("calibrate", "Find the parameters with which workflows give what was measured");
  verb->footer(
      "Proposes points by what earlier ones gave, runs each into a folder of its own below cases/, several at a time,\n"
      "and tells the best parameters with their intervals. A run that has finished is not run again. Elsewhere (a "
      "Slurm\n"
      "array): --cases lists the runs, those of the next batch among them, --case runs one, --collect tells what is "
      "known.\n"
      "Keys of the file: breccia describe calibration.\n"
      "Exit code: 0 it has come to its end, 1 it has not, 2 something is not in order, 130 stopped on request.");
  verb->add_option("CALIBRATION", calibrate.file, "the calibration (YAML)")->required();
  verb->add_option("-o,--output", calibrate.output, "folder of the results; default: results/<calibration name>")
      ->type_name("FOLDER");
  jobs = verb->add_option("-j,--jobs", calibrate.jobs,
                          "runs at a time; default: as the file says, else as many as keep all cores busy")
             ->check(CLI::Range(1, 1024));
  threads = verb->add_option("--threads", calibrate.threads, "threads of each run. The results do not depend on it")
                ->check(CLI::Range(1, 1024))
                ->capture_default_str();
  auto* retry = verb->add_flag("--retry-failed", calibrate.retry_failed, "run those again that have failed before");
  cases = verb->add_flag("--cases", calibrate.cases, "list the runs (CSV) and make none");
  one = verb->add_option("--case", calibrate.one, "make only this run: its number")->check(CLI::Range(1, 1000000));
  collect =
      verb->add_flag("--collect", calibrate.collect, "make no run: tell what is known from those that have finished");
  auto* trial = verb->add_option("--trial", calibrate.trial)->group("");
  expect = verb->add_option("--expect", calibrate.expect)->group("");
  parent = verb->add_option("--parent", calibrate.parent)->group("");
  cases->excludes(jobs)->excludes(threads)->excludes(retry)->excludes(one)->excludes(collect);
  collect->excludes(jobs)->excludes(threads)->excludes(retry)->excludes(one);
  one->excludes(jobs)->excludes(retry);
  expect->needs(trial);
  parent->needs(trial);
  verb->callback([&] { code = cli::calibrate(calibrate); });

  std::string schema_of = "workflow";
  verb = app.add_subcommand("schema", "Print the JSON Schema of workflows, of studies, or of calibrations");
  verb->add_option("OF", schema_of, "workflow, sweep or calibration")
      ->check(CLI::IsMember({"workflow", "sweep", "calibration"}))
      ->capture_default_str();
  verb->callback([&] { code = cli::schema(schema_of); });

  NewArguments fresh;
  verb =
      app.add_subcommand("new", "Begin a plugin of your own: a small project that builds, with tests and a workflow");
  verb->footer("Example: breccia new contact_law my_law");
  verb->add_option("KIND", fresh.kind, "packing, contact_law, protocol, postprocessor, output, renderer or search")
      ->required();
  verb->add_option("NAME", fresh.name, "what workflows call it: my_law")->required();
  verb->add_option("--dir", fresh.folder, "folder of the project, new or empty; default: NAME")->type_name("FOLDER");
  verb->callback([&] { code = new_plugin(fresh); });

  std::string form;
  verb = app.add_subcommand("command-line", "Print the manual page, or what a shell needs to complete command lines")
             ->group("");  // for those who build and package: not among the verbs that are shown
  verb->add_option("FORM", form, "man, bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}));
  verb->callback([&] { code = cli::command_texts(app, form); });

  return use(app, code);
}

}  // namespace breccia
