// SPDX-License-Identifier: BSD-3-Clause
#include "report/html.hpp"
#include "report/quantity.hpp"
#include "report/report_pages.hpp"
#include "report/run_parts.hpp"
#include "results/summary_keys.hpp"

namespace breccia::report {
namespace {

/// What was tested, in one line: the kind of the test and the specimen.
std::string lead(const RunFiles& run) {
  const Json test = run.given("protocol.type");
  std::string text = test.is_string() ? capital(readable(test.get<std::string>())) + " test of " : "A specimen of ";
  text += number_text(run.number("particles")) + (run.given("dimension") == 2 ? " discs" : " spheres") + " and " +
          number_text(run.number("bonds")) + " bonds";
  std::string laws;
  for (const Json& law : run.laws())
    if (law.contains("type") && law["type"].is_string())
      laws += (laws.empty() ? "" : " + ") + readable(law["type"].get<std::string>());
  return text + (laws.empty() ? "." : "; contact law " + laws + ".");
}

std::string notes(const RunFiles& run) {
  std::string out;
  if (run.interrupted)
    out +=
        "<div class=\"note\"><p><strong>The run was stopped before its end.</strong> Its last values are not "
        "final.</p></div>\n";
  for (const std::string& text : run.missing) out += "<div class=\"note\">" + paragraph(text) + "</div>\n";
  return out;
}

std::string figures_note(const std::vector<Figure>& figures) {
  return figures.empty() ? paragraph("The run has no charts or pictures, and none could be drawn here.")
                         : std::string();
}

std::string files_list(const RunFiles& run) {
  Table table("Files that the run left");
  table.column("File").column("Bytes", Table::Is::number);
  std::error_code unknown;
  for (const std::string& file : run.files) {
    const auto bytes = std::filesystem::file_size(run.folder / file, unknown);
    if (!unknown) table.row({"<code>" + escaped(file) + "</code>", std::to_string(bytes)});
  }
  return foldable("Files of the results", table.html());
}

}  // namespace

std::string heading(std::string_view kind, std::string_view title, const std::vector<std::string>& authors,
                    const std::string& about) {
  std::string by;
  for (const std::string& a : authors) by += (by.empty() ? "" : ", ") + a;
  return "<p class=\"kind\">" + escaped(kind) + "</p>\n<h1>" + escaped(title) + "</h1>\n" +
         (by.empty() ? "" : "<p class=\"about\">" + escaped(by) + "</p>\n") +
         (about.empty() ? "" : "<p class=\"about\">" + escaped(about) + "</p>\n");
}

std::string footer(const ReportFacts& facts) {
  return "<footer>" +
         paragraph("Made by Breccia " BRECCIA_VERSION " on " + facts.date + " from the files of the results alone" +
                   (facts.licence.empty() ? "." : "; licence: " + facts.licence + ".")) +
         "</footer>\n";
}

std::string run_page(const RunFiles& run, const std::vector<Figure>& figures, const std::string& methods,
                     const Registry& registry, const ReportFacts& facts) {
  const Json description = run.given("description");
  std::string when = run.ended.empty() ? "" : (run.interrupted ? "Stopped " : "Finished ") + run.ended;
  if (const std::string version = program_version(run); !version.empty())
    when += (when.empty() ? "" : " · ") + ("Breccia " + version);
  std::string body = "<header>\n" + heading("Report of a run", run.name(), facts.authors, when);
  if (description.is_string() && !description.get<std::string>().empty())
    body += "<p class=\"lead\">" + escaped(description.get<std::string>()) + "</p>\n";
  body += paragraph(lead(run)) + notes(run) + tiles(run) + "</header>\n<main>\n";
  body += section("results", "Results", results_table(run) + charts_html(figures));
  body += section("pictures", "Pictures", pictures_html(figures) + figures_note(figures));
  body += section("specimen", "Specimen", specimen_table(run));
  body += section("damage", "Cracks and damage", damage_part(run));
  body += section("energy", "Energy balance", energy_part(run));
  body += section("warnings", "Warnings", warnings_part(run));
  body += section("model", "Model and test", model_part(run, registry));
  body += section("methods", "Methods, for a paper", methods);
  body += section("computation", "Computation", computation_part(run));
  body += section("cite", "How to cite", citation_part(run, registry));
  body +=
      section("more", "All there is",
              other_numbers(run) +
                  foldable("Resolved input: the whole workflow with all defaults (resolved.yaml)",
                           run.input_text.empty() ? "" : "<pre><code>" + escaped(run.input_text) + "</code></pre>\n") +
                  files_list(run));
  return page(run.name() + ": report of a run", body + "</main>\n" + footer(facts));
}

}  // namespace breccia::report
