// SPDX-License-Identifier: BSD-3-Clause
#include "report/report.hpp"

#include <algorithm>
#include <ctime>
#include <set>

#include "breccia/atomic_file.hpp"
#include "report/crate.hpp"
#include "report/methods.hpp"
#include "report/run_parts.hpp"
#include "results/results_folder.hpp"

namespace breccia::report {

namespace fs = std::filesystem;

namespace {

constexpr const char* page_file = "report.html";
constexpr const char* methods_file = "methods.md";

struct Texts {
  std::string page, methods;
  CrateContent crate;
  std::optional<RunFiles> run;  ///< that `crate` speaks of
};

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[16];
  return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%d", &local));
}

std::string description_of(const RunFiles& run) {
  const Json given = run.given("description");
  const std::string text = given.is_string() ? given.get<std::string>() : "";
  return text.empty() ? "Results of the Breccia workflow " + run.name() : text;
}

Texts texts_of_run(const ReportRequest& request, const Registry& registry, const ReportFacts& facts, Host& host) {
  Texts texts;
  const RunFiles& run = texts.run.emplace(read_run_files(request.folder));
  const std::vector<std::string> paragraphs = methods_text(run);
  texts.page =
      run_page(run, figures_of_run(run, request.renderer, registry, host), methods_html(paragraphs), registry, facts);
  texts.methods = methods_markdown(run.name(), paragraphs, model_sources(run, registry));
  texts.crate = {run.name(), description_of(run), run.folder, run.files, {}, nullptr};
  return texts;
}

/// Of all models, each once.
std::vector<std::pair<std::string, std::string>> sources_of(const std::vector<RunFiles>& runs,
                                                            const Registry& registry) {
  std::vector<std::pair<std::string, std::string>> sources;
  for (const RunFiles& run : runs)
    for (auto& source : model_sources(run, registry))
      if (std::find(sources.begin(), sources.end(), source) == sources.end()) sources.push_back(std::move(source));
  return sources;
}

Texts texts_of_study(const ReportRequest& request, const Registry& registry, const ReportFacts& facts, Host& host) {
  const StudyFiles study = read_study_files(request.folder);
  Texts texts;
  const std::vector<std::string> paragraphs = methods_text(study);
  const auto sources = sources_of(study.examples, registry);
  texts.page = study_page(study, figures_of(study.folder, study.files, registry, "figure-", host),
                          methods_html(paragraphs), registry, facts);
  texts.methods = methods_markdown(study.name, paragraphs, sources);
  std::vector<std::string> folders;
  std::error_code unknown;
  for (const StudyCase& c : study.cases)
    if (fs::is_directory(study.folder / "cases" / c.folder, unknown)) folders.push_back("cases/" + c.folder);
  texts.crate = {
      study.name,
      "Results of the Breccia parameter study " + study.name + ", " + std::to_string(study.cases.size()) + " cases",
      study.folder,
      study.files,
      folders,
      nullptr};
  if (!study.examples.empty()) texts.run = study.examples[0];
  return texts;
}

Texts texts_of_calibration(const ReportRequest& request, const Registry& registry, const ReportFacts& facts,
                           Host& host) {
  const CalibrationFiles c = read_calibration_files(request.folder);
  Texts texts;
  const std::vector<std::string> paragraphs = methods_text(c);
  std::vector<std::pair<std::string, std::string>> sources = sources_of(c.examples, registry);
  for (auto& source : search_source(c.search(), registry)) sources.push_back(std::move(source));
  texts.page = calibration_page(c, figures_of(c.folder, c.files, registry, "figure-", host), methods_html(paragraphs),
                                registry, facts);
  texts.methods = methods_markdown(c.name, paragraphs, sources);
  std::vector<std::string> folders;
  std::error_code unknown;
  for (std::size_t r = 0; r < c.runs.rows.size(); ++r)
    if (const std::string run = c.runs.cell(r, "folder"); fs::is_directory(c.folder / "cases" / run, unknown))
      folders.push_back("cases/" + run);
  texts.crate = {c.name,
                 "Results of the Breccia calibration " + c.name + ", " + std::to_string(c.count("runs")) + " runs",
                 c.folder,
                 c.files,
                 folders,
                 nullptr,
                 "Results of one run of the calibration"};
  if (!c.examples.empty()) texts.run = c.examples[0];
  return texts;
}

bool is_calibration_folder(const fs::path& folder) {
  return kind_of_results(folder) == "calibration" || fs::exists(folder / "calibration.json");
}

bool is_study_folder(const fs::path& folder) {
  return !fs::exists(folder / "summary.json") &&
         (kind_of_results(folder) == "study" || fs::is_directory(folder / "cases"));
}

void refuse_what_is_no_result(const fs::path& folder) {
  const std::string name = folder.string();
  if (!fs::exists(folder)) throw UserError("cannot read " + name + ": no such folder");
  if (!fs::is_directory(folder))
    throw UserError(name + " is a file; the folder that a run or a study left is needed, such as results/" +
                    folder.stem().string());
  if (kind_of_results(folder) == "comparison")
    throw UserError(
        name + " holds a comparison, which is a report already (comparison.md); give the folder of a run or a study");
  if (!is_calibration_folder(folder) && !is_study_folder(folder) && !fs::exists(folder / "summary.json"))
    (void)read_run_files(folder);  // says why
}

/// The page's name with another ending: several reports may stand in one folder.
fs::path methods_beside(const fs::path& page) {
  fs::path name = page.stem();
  name += ".methods.md";
  return page.parent_path() / name;
}

/// Nobody else changes the results while they are read.
void close_to_others(std::optional<FolderLock>& lock, const fs::path& folder, Host& host) {
  try {
    lock.emplace(folder, host);
  } catch (const FolderInUse&) { throw; } catch (const UserError& e) {
    throw UserError(std::string(e.what()) + "; --output FILE writes the report elsewhere");
  }
}

void refuse_to_overwrite(const std::vector<fs::path>& files) {
  for (const fs::path& file : files)
    if (fs::exists(fs::symlink_status(file)))
      throw UserError(file.string() +
                      " is there already; nothing was changed. Choose another with --output, or allow it to be "
                      "replaced with --overwrite");
}

}  // namespace

std::vector<fs::path> write_report(const ReportRequest& request, const Registry& registry, Host& host) {
  refuse_what_is_no_result(request.folder);
  complete_results(request.folder, host);
  const bool elsewhere = !request.output.empty();
  std::vector<fs::path> files{elsewhere ? request.output : request.folder / page_file,
                              elsewhere ? methods_beside(request.output) : request.folder / methods_file};
  if (!elsewhere) files.push_back(request.folder / crate_file);
  const fs::path home = fs::absolute(files[0]).parent_path();
  if (fs::is_directory(files[0]))
    throw UserError(files[0].string() + " is a folder; a file is needed, such as " + (files[0] / page_file).string());
  if (!fs::is_directory(home)) throw UserError("cannot write " + files[0].string() + ": there is no such folder");
  if (!request.overwrite) refuse_to_overwrite(files);
  std::error_code unknown;
  const bool among_results = fs::equivalent(home, request.folder, unknown);
  std::optional<FolderLock> lock;
  if (among_results) {
    close_to_others(lock, home, host);
    check_additions(home, files);
  }

  const ReportFacts facts{request.authors, request.licence, today()};
  Texts texts = is_calibration_folder(request.folder) ? texts_of_calibration(request, registry, facts, host)
                : is_study_folder(request.folder)     ? texts_of_study(request, registry, facts, host)
                                                      : texts_of_run(request, registry, facts, host);
  if (host.cancelled()) throw Cancelled();
  write_file(files[0], texts.page);
  write_file(files[1], texts.methods);
  if (!elsewhere) {
    std::set<std::string> all(texts.crate.files.begin(), texts.crate.files.end());
    all.insert({page_file, methods_file});
    all.erase(crate_file);  // an earlier one
    texts.crate.files.assign(all.begin(), all.end());
    if (texts.run) texts.crate.run = &*texts.run;
    write_file(files[2], json_text(crate_metadata(texts.crate, facts), 1) + "\n");
  }
  if (among_results) add_to_results(home, files);
  return files;
}

}  // namespace breccia::report
