// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "report/html.hpp"
#include "report/page_style.hpp"
#include "report/quantity.hpp"
#include "report/run_parts.hpp"

namespace breccia::report {
namespace {

/// "0.2.0 1d97...": version and hash of what is in `provenance.plugins`.
void add_plugins(const RunFiles& run, Table& table) {
  const Json plugins = run.given("provenance.plugins");
  if (!plugins.is_object()) return;
  for (const auto& [name, made_with] : plugins.items()) {
    if (!made_with.is_string()) continue;
    const std::string text = made_with.get<std::string>();
    const std::size_t space = text.find(' ');
    table.row({"<code>" + escaped(name) + "</code>", escaped(text.substr(0, space)),
               space == text.npos ? "" : "<code class=\"hash\">" + escaped(text.substr(space + 1)) + "</code>"});
  }
}

}  // namespace

std::string program_version(const RunFiles& run) {
  for (const Json& said : {run.result("environment.breccia"), run.given("provenance.breccia")})
    if (said.is_string()) return said.get<std::string>();
  return {};
}

std::string computation_part(const RunFiles& run) {
  Table table("How it was computed");
  table.column("What").column("Value");
  const auto add = [&](const char* title, const std::string& value) {
    if (!value.empty()) table.row({title, escaped(value)});
  };
  const auto text = [&](const std::string& path) {
    const Json v = run.result(path);
    return v.is_string() ? v.get<std::string>() : v.is_number() ? number_text(v.get<double>()) : std::string();
  };
  const auto seconds = [&](const std::string& path) {
    const double v = run.number(path);
    return std::isnan(v) ? std::string() : shown_quantity(v, "s").text();
  };
  add("Time step", seconds("time_step_s"));
  add("Critical time step", seconds("critical_time_step_s"));
  add("Time step from", text("time_step_from") == "spectral" ? "the fastest mode of the whole system"
                        : text("time_step_from") == "bound"  ? "the bound of single particles"
                                                             : "");
  add("Steps", text("steps"));
  add("Simulated time", seconds("simulated_time_s"));
  add("Wall time", seconds("wall_time_s"));
  add("Threads", text("threads"));
  add("Begun", run.begun);
  add("Ended", run.ended);
  add("Program", program_version(run).empty() ? "" : "Breccia " + program_version(run));
  add("Commit of the sources", text("environment.commit"));
  add("Compiler", text("environment.compiler"));
  add("Build", text("environment.build"));
  add("Host", text("environment.host"));
  add("System", text("environment.system"));
  add("Processor", text("environment.processor"));
  std::string out = table.html();
  if (run.result("environment").is_null())
    out +=
        "<p class=\"about\">Host, compiler and commit are not in the results: an earlier version of Breccia did not "
        "record them.</p>\n";
  Table plugins("Plugins that made the results, by the content of their libraries");
  plugins.column("Plugin").column("Version").column("SHA-256");
  add_plugins(run, plugins);
  out += plugins.html();
  const Json packing = run.given("provenance.packing_content");
  if (packing.is_string())
    out += "<p class=\"about\">SHA-256 of the packing: <code class=\"hash\">" + escaped(packing.get<std::string>()) +
           "</code></p>\n";
  return out;
}

std::vector<std::pair<std::string, std::string>> model_sources(const RunFiles& run, const Registry& registry) {
  std::vector<std::pair<std::string, std::string>> all;
  const auto add = [&](const char* kind, const char* called, const Json& section) {
    if (!section.is_object() || !section.contains("type") || !section["type"].is_string()) return;
    const std::string type = section["type"].get<std::string>();
    try {
      const std::string& source = registry.documentation(kind, type).source;
      if (!source.empty()) all.emplace_back(std::string(called) + " `" + type + "`", source);
    } catch (const UserError&) {}  // a plugin that is not here: it is named with the others
  };
  add("packing", "packing", run.given("packing"));
  for (const Json& law : run.laws()) add("contact_law", "contact law", law);
  add("protocol", "test", run.given("protocol"));
  return all;
}

std::vector<std::pair<std::string, std::string>> search_source(const std::string& search, const Registry& registry) {
  try {
    const std::string& source = registry.documentation("search", search).source;
    if (!source.empty()) return {{"search `" + search + "`", source}};
  } catch (const UserError&) {}  // it is not here, or the results do not name it
  return {};
}

std::string citation_text(const std::string& version) {
  return std::string(citation_authors) + ": " + citation_title + (version.empty() ? "" : ", version " + version) + ".";
}

std::string citation_part(const RunFiles& run, const Registry& registry,
                          const std::vector<std::pair<std::string, std::string>>& more) {
  const std::string commit =
      run.result("environment.commit").is_string() ? run.result("environment.commit").get<std::string>() : "";
  std::string out = paragraph("If you publish these results, please cite the program and the papers of the models:") +
                    "<blockquote>" +
                    paragraph(citation_text(program_version(run)) + (commit.empty() ? "" : " Commit " + commit + ".")) +
                    "</blockquote>\n";
  Table table("Sources of the models, as the plugins state them");
  table.column("Model").column("Source");
  auto sources = model_sources(run, registry);
  sources.insert(sources.end(), more.begin(), more.end());
  for (const auto& [name, source] : sources) {
    std::string plain = name;
    std::erase(plain, '`');
    table.row({escaped(capital(plain)), escaped(source)});
  }
  return out + table.html();
}

}  // namespace breccia::report
