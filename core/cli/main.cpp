// SPDX-License-Identifier: BSD-3-Clause
#include <sys/auxv.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "breccia/utf8.hpp"
#include "cli/verbs.hpp"
#include "config/suggest.hpp"
#include "plugin/out_of_memory.hpp"

namespace {

using namespace breccia;

/// "; did you mean `x`?", or what there is.
std::string hint(const std::string& written, const std::vector<std::string>& known) {
  const std::string near = closest(written, known);
  return near.empty() ? "; there are " + list_of(known, 40) : "; did you mean `" + near + "`?";
}

/// Why the first word is no verb; empty when it is one, or an option.
std::string unknown_verb(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    verbs.push_back(verb->get_name());
  const std::string word = argv[1];
  if (std::find(verbs.begin(), verbs.end(), word) != verbs.end()) return {};
  return "breccia: unknown verb `" + word + "`" + hint(word, verbs) + " (`breccia --help`)";
}

/// Names the first option that the verb does not have; empty when there is none: the mistake is another one.
std::string unknown_option(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> known;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    if (verb->get_name() == argv[1])
      for (const CLI::Option* option : verb->get_options())
        if (!option->get_group().empty())
          for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int k = 2; k < argc; ++k) {
    const std::string word = std::string(argv[k]).substr(0, std::string(argv[k]).find('='));
    if (word == "--") return {};
    if (word == "--expect" || word == "--parent") continue;  // of studies, for their own processes
    if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end()) continue;
    return "breccia " + std::string(argv[1]) + ": unknown option `" + word + "`" + hint(word, known) + " (`breccia " +
           argv[1] + " --help`)";
  }
  return {};
}

int dispatch(int argc, char** argv) {
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
                     ->excludes(run_file);
  verb->add_option("--from", run.from,
                   "a checkpoint of another run, or the folder of its results: begins where that run stood, as `from` "
                   "of a workflow does")
      ->excludes(resume);
  verb->add_flag("--accept-changed-plugins", run.accept_changed_plugins,
                 "go on although a plugin or a file that was read is another one than at the beginning");
  verb->add_option("--output", run.output, "folder of the results; default: results/<workflow name>")->excludes(resume);
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
  verb->add_option("PLUGIN", plugin,
                   "KIND/NAME, or NAME alone; a KIND for its plugins; workflow or sweep for the keys of these files")
      ->required();
  verb->add_option("--format", format, "text, markdown or json")->check(CLI::IsMember({"text", "markdown", "json"}));
  verb->callback([&] { code = cli::describe(plugin, format); });

  cli::CheckArguments check;
  verb = app.add_subcommand("check", "Try a plugin on small cases: whether it is what its kind promises");
  verb->add_option("PLUGIN", check.plugin, "KIND/NAME, or NAME alone")->required();
  verb->add_option("--plugin", check.plugins, "a plugin from outside Breccia's own folder, by its file or folder")
      ->expected(1)
      ->take_all();
  verb->add_option("--set", check.overrides, "a parameter of the plugin; default: its default or example: friction=0.3")
      ->expected(1)
      ->take_all();
  verb->callback([&] { code = cli::check(check); });

  cli::RenderArguments render;
  verb = app.add_subcommand("render", "Make pictures from the files of a run");
  verb->add_option("SOURCE", render.source, "result folder, .pvd or .vtp file")->required();
  verb->add_option("--output", render.output, "folder of the pictures; default: beside the source");
  verb->add_flag("--overwrite", render.overwrite, "replace pictures of the same names");
  verb->add_option("--renderer", render.renderer, "renderer plugin");
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
  verb->add_option("-o,--output", compare.output, "folder of the comparison")->capture_default_str();
  verb->add_option("--labels", compare.labels,
                   "names of runs: LABEL=DIR,LABEL=DIR or once for each; default: the folders' names")
      ->expected(1)
      ->take_all()
      ->delimiter(',');
  verb->add_flag("--overwrite", compare.overwrite,
                 "the folder may hold files: those of the same names are replaced, no other is touched");
  verb->add_option("--renderer", compare.renderer, "renderer plugin of the charts; default: pictures, if installed");
  verb->add_option("--set", compare.overrides, "replace a setting of the renderer: path=value")
      ->expected(1)
      ->take_all();
  verb->callback([&] { code = cli::compare(compare); });

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
  verb->add_option("--path", drive.path, "the path (CSV)")->required();
  verb->add_option("-o,--output", drive.output, "folder of the results; default: results/drive_<law>");
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
  verb->add_option("-o,--output", sweep.output, "folder of the results; default: results/<study name>");
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

  std::string schema_of = "workflow";
  verb = app.add_subcommand("schema", "Print the JSON Schema of workflows, or of studies");
  verb->add_option("OF", schema_of, "workflow or sweep")
      ->check(CLI::IsMember({"workflow", "sweep"}))
      ->capture_default_str();
  verb->callback([&] { code = cli::schema(schema_of); });

  if (const std::string text = unknown_verb(app, argc, argv); !text.empty()) throw UserError(text);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0)
      if (const std::string text = unknown_option(app, argc, argv); !text.empty()) throw UserError(text);
    return app.exit(e) == 0 ? cli::ok : cli::bad_input;
  }
  return code;
}

}  // namespace

/// What libraries read from the environment when they are loaded, which is before `main`: the program starts itself
/// again with it. What is set already is left alone.
/// Threads that wait for each other sleep at once instead of spinning: beside other work a run is then never many times
/// slower, and on an idle machine it costs nothing that can be seen. Large arrays lie in huge pages where the system
/// gives them to who asks: particles are reached by index, and each small page costs a translation. Both are measured
/// in docs/performance.md.
void set_environment_of_libraries(char** argv) {
  if (getauxval(AT_SECURE)) return;  // the system takes such variables away: it would go round for ever
  bool again = false;
  const auto set = [&](const char* name, const char* value) {
    if (!std::getenv(name) && setenv(name, value, 0) == 0) again = true;
  };
  if (!std::getenv("GOMP_SPINCOUNT")) set("OMP_WAIT_POLICY", "passive");
  set("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1");
  if (again) execv("/proc/self/exe", argv);  // comes back only when it fails
}

int main(int argc, char** argv) {
  end_plainly_without_memory();
  set_environment_of_libraries(argv);
  try {
    const int code = dispatch(argc, argv);
    // A reader that has seen enough (`| head`) is no error; a full disk is.
    if ((std::fflush(stdout) == 0 && !std::ferror(stdout)) || errno == EPIPE) return code;
    std::fprintf(stderr, "cannot write the output: %s\n", std::strerror(errno));
    return cli::bad_input;
  } catch (const Cancelled&) {
    std::fprintf(stderr, "breccia: stopped on request\n");
    return cli::interrupted;
  } catch (const UserError& e) {
    std::fprintf(stderr, "%s\n", printable(e.what()).c_str());
    return cli::bad_input;
  } catch (const std::filesystem::filesystem_error& e) {  // of a name that the user gave: too long, not to be entered
    const std::string file = printable(e.path1().string()), why = e.code().message();
    std::fprintf(stderr, "cannot use %s: %s\n", file.c_str(), why.c_str());
    return cli::bad_input;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "breccia: %s\n", out_of_memory().c_str());
    return cli::failure;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "breccia: %s\n", printable(e.what()).c_str());
    return cli::failure;
  }
}
