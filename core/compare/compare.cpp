// SPDX-License-Identifier: BSD-3-Clause
#include "compare/compare.hpp"

#include <algorithm>
#include <fstream>

#include "breccia/atomic_file.hpp"
#include "breccia/text_file.hpp"
#include "plugin/drawing.hpp"
#include "plugin/guarded.hpp"
#include "results/results_folder.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

/// Without a trailing slash, so that it has a name.
fs::path plain(const fs::path& folder) {
  const fs::path p = fs::weakly_canonical(fs::absolute(folder));
  return p.has_filename() ? p : p.parent_path();
}

Json read_summary(const fs::path& folder) {
  const std::string name = folder.string();
  if (fs::is_regular_file(folder) && (has_ending(folder, ".yaml") || has_ending(folder, ".yml")))
    throw UserError(name +
                    " is an input file; the result folder that its run or study left is needed, such as results/" +
                    folder.stem().string());
  if (!fs::exists(folder)) throw UserError("cannot read " + name + ": no such folder");
  if (!fs::is_directory(folder)) throw UserError(name + " is a file; the result folder of a run is needed");
  const fs::path file = folder / "summary.json";
  if (!fs::exists(file)) {
    if (fs::exists(folder / "curves.csv.partial") || fs::exists(folder / "run.log"))
      throw UserError("the run in " + name + " has not finished: there is no summary.json yet");
    throw UserError(name + " is not the result folder of a run: it has no summary.json");
  }
  if (!fs::exists(folder / "curves.csv")) throw UserError(name + " is not a whole result folder: it has no curves.csv");
  const Json summary = Json::parse(read_bytes(file), nullptr, false);
  if (!summary.is_object()) throw UserError(file.string() + " is damaged: it is not a JSON object");
  return summary;
}

template <class Name>
void rename_repeated(std::vector<std::string>& labels, Name&& name) {
  const std::vector<std::string> before = labels;
  for (std::size_t k = 0; k < labels.size(); ++k)
    if (std::count(before.begin(), before.end(), before[k]) > 1) labels[k] = name(k);
}

std::vector<std::string> folder_labels(const std::vector<fs::path>& folders) {
  std::vector<std::string> labels;
  for (const fs::path& f : folders) labels.push_back(plain(f).filename().string());
  rename_repeated(labels,
                  [&](std::size_t k) { return plain(folders[k]).parent_path().filename().string() + "/" + labels[k]; });
  return labels;
}

/// "a", "a" become "a (1)", "a (2)"; a number that would make another label is passed over.
void number_repeated(std::vector<std::string>& labels) {
  const std::vector<std::string> given = labels;
  rename_repeated(labels, [&](std::size_t k) {
    for (std::size_t n = 1;; ++n) {
      const std::string name = given[k] + " (" + std::to_string(n) + ")";
      if (std::find(labels.begin(), labels.end(), name) == labels.end()) return name;
    }
  });
}

/// A folder of files that grow elsewhere and are told of by their places.
fs::path place_of(const fs::path& file, const ResultsFolder& home, const fs::path& shown) {
  return shown / file.lexically_relative(home.work());
}

void check_folder(const std::vector<ComparedRun>& runs, const fs::path& folder) {
  for (const ComparedRun& run : runs)
    if (plain(run.folder) == plain(folder))
      throw UserError("the comparison cannot go to " + folder.string() +
                      ", which is one of the runs: choose another folder "
                      "with --output");
  if (fs::exists(folder / "summary.json") || fs::exists(folder / "resolved.yaml"))
    throw UserError("the folder " + folder.string() +
                    " holds the results of a run, which a comparison does not replace: choose another with --output");
}

std::vector<fs::path> draw(const std::vector<ComparedRun>& runs, const ComparisonOptions& options,
                           const fs::path& folder, const Registry& registry, Host& host) {
  if (!options.renderer) return {};
  ComparisonRequest request{{}, folder};
  for (const ComparedRun& run : runs) request.runs.push_back({run.folder, run.label});
  return drawn("charts", options.renderer->type, Refusal::ends, host, [&] {
    const auto renderer = registry.create<Renderer>(*options.renderer);
    return calling({Renderer::kind, options.renderer->type}, "drawing",
                   [&] { return renderer->compare(request, host); });
  });
}

}  // namespace

namespace {

/// The cases of a study in its own order, which results.csv has; a run stands for itself.
std::vector<fs::path> runs_in(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "summary.json", error) || !fs::is_directory(folder / "cases", error)) return {folder};
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(folder / "cases", error))
    if (fs::exists(entry.path() / "summary.json", error)) all.push_back(folder / "cases" / entry.path().filename());
  if (all.empty()) throw UserError("no case of the study in " + folder.string() + " has finished");
  std::ifstream in(folder / "results.csv", std::ios::binary);
  const std::string table = "," + std::string(std::istreambuf_iterator<char>(in), {});
  const auto rank = [&](const fs::path& f) { return table.find("," + f.filename().string() + ","); };
  std::sort(all.begin(), all.end(),
            [&](const fs::path& a, const fs::path& b) { return std::pair(rank(a), a) < std::pair(rank(b), b); });
  return all;
}

/// Gives the run that `text` ("LABEL=DIR") names its label. The order of the folders on a command line is often the
/// shell's, so that a label never goes by its position.
void attach(const std::string& text, const std::vector<fs::path>& folders, std::vector<std::string>& labels,
            std::vector<bool>& is_labelled) {
  for (std::size_t at = text.find('='); at != text.npos; at = text.find('=', at + 1)) {
    const std::string label = text.substr(0, at), written = text.substr(at + 1);
    const auto same = [&](const fs::path& f) { return f == written || plain(f) == plain(written); };
    bool any = false, taken = false;
    for (std::size_t k = 0; !written.empty() && k < folders.size(); ++k) {
      if (!same(folders[k])) continue;
      if (label.empty())
        throw UserError("the label of " + folders[k].string() + " is empty: --labels LABEL=" + folders[k].string());
      if (taken = is_labelled[k]; taken) continue;
      labels[k] = label;
      any = is_labelled[k] = true;
      break;  // a folder given twice takes its labels one after the other
    }
    if (any) return;
    if (taken) throw UserError("a second label for the run " + written + ": `" + label + "`");
  }
  throw UserError(
      "the label `" + text + "` names none of the runs: write --labels 'LABEL=DIR' for each, such as 'LABEL=" +
      folders.front().string() + "' (labels do not go by position: a shell sorts folders by its own rules)");
}

}  // namespace

std::vector<ComparedRun> read_runs(const std::vector<fs::path>& given, const std::vector<std::string>& labels) {
  std::vector<fs::path> folders;
  for (const fs::path& folder : given)
    for (const fs::path& run : runs_in(folder)) folders.push_back(run);
  std::vector<ComparedRun> runs;
  for (const fs::path& folder : folders) runs.push_back({folder, "", read_summary(folder)});
  std::vector<std::string> names = folder_labels(folders);
  std::vector<bool> is_labelled(folders.size());
  for (const std::string& label : labels) attach(label, folders, names, is_labelled);
  number_repeated(names);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    runs[k].label = names[k];
    const auto it = runs[k].summary.find("interrupted");
    runs[k].interrupted = it != runs[k].summary.end() && *it == true;
  }
  return runs;
}

std::vector<fs::path> compare_runs(const std::vector<ComparedRun>& runs, const ComparisonOptions& options,
                                   const Registry& registry, Host& host) {
  check_folder(runs, options.folder);
  ResultsFolder home(options.folder, FolderRules{options.overwrite, "comparison", {"comparison.csv", "comparison.md"}},
                     host);
  for (const ComparedRun& run : runs)
    if (run.interrupted)
      host.warn("the run `" + run.label + "` was stopped before its end: its last values are not final");
  const fs::path& work = home.work();
  std::vector<fs::path> made = draw(runs, options, work, registry, host);
  const auto envelope = strength_envelope(runs);
  const std::string text = comparison_markdown(runs, made) + (envelope ? strength_markdown(*envelope) : "");
  write_file(work / "comparison.csv", comparison_csv(runs));
  write_file(work / "comparison.md", text);
  made.insert(made.begin(), {work / "comparison.csv", work / "comparison.md"});
  if (envelope) {
    write_file(work / "strength_envelope.json", json_text(*envelope, 2) + "\n");
    made.insert(made.begin() + 2, work / "strength_envelope.json");
  }
  home.take_over(true);
  for (fs::path& file : made) file = place_of(file, home, options.folder);
  return made;
}

}  // namespace breccia
