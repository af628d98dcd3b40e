// SPDX-License-Identifier: BSD-3-Clause
#include "report/crate.hpp"

#include <algorithm>

#include "report/page_style.hpp"
#include "report/run_parts.hpp"

namespace breccia::report {

namespace fs = std::filesystem;

namespace {

/// A path as a relative URI (RFC 3986): what has a meaning there, or is no ASCII, as %XX.
std::string uri_of(const std::string& path) {
  static constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/=,+@";
  std::string out;
  for (const char c : path) {
    if (plain.find(c) != plain.npos) {
      out += c;
      continue;
    }
    constexpr const char* digits = "0123456789ABCDEF";
    const unsigned char code = static_cast<unsigned char>(c);
    out.append("%").append(1, digits[code >> 4]).append(1, digits[code & 15]);
  }
  return out;
}

Json reference(const std::string& id) { return {{"@id", id}}; }

std::string media_type_of(const fs::path& file) {
  static const std::pair<const char*, const char*> known[] = {
      {".json", "application/json"}, {".csv", "text/csv"},        {".yaml", "application/yaml"},
      {".log", "text/plain"},        {".png", "image/png"},       {".svg", "image/svg+xml"},
      {".pdf", "application/pdf"},   {".vtp", "application/xml"}, {".pvtp", "application/xml"},
      {".pvd", "application/xml"},   {".md", "text/markdown"},    {".html", "text/html"},
      {".h5", "application/x-hdf5"}, {".mp4", "video/mp4"},       {".webm", "video/webm"},
      {".gif", "image/gif"},         {".xyz", "text/plain"}};
  for (const auto& [ending, type] : known)
    if (has_ending(file, ending)) return type;
  return "application/octet-stream";
}

std::string said_of_file(const std::string& file) {
  static const std::pair<const char*, const char*> known[] = {
      {"summary.json", "Numbers that the run measured, in SI, with their units"},
      {"curves.csv", "Curves, a row for each sample"},
      {"curves.json", "Names, units and meanings of the columns of curves.csv"},
      {"resolved.yaml", "The whole input of the run with all defaults; running it again gives the same results"},
      {"run.log", "What the run said"},
      {"cases.csv", "The cases of the study and their parameters"},
      {"results.csv", "Parameters, status and results of each case"},
      {"calibration.json", "What the calibration found: parameters with intervals, targets, sensitivities, in SI"},
      {"points.csv", "The points of the calibration in their order, with means and deviations of each target"},
      {"runs.csv", "Every run of the calibration: parameters, status and results"},
      {"pareto.csv", "Points at which no target comes nearer without another going farther, by the model"},
      {"report.html", "Report for a human reader, with all charts and pictures in it"},
      {"methods.md", "Paragraph for the methods section of a paper"}};
  for (const auto& [name, text] : known)
    if (file == name) return text;
  return {};
}

/// An SPDX name or an address as an identifier; a licence in words stays one.
Json licence_entity(const std::string& licence) {
  const bool is_address = licence.starts_with("https://") || licence.starts_with("http://");
  const bool is_name =
      licence.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.-+") == licence.npos;
  return {{"@id", is_address ? licence
                  : is_name  ? "https://spdx.org/licenses/" + licence
                             : "#licence"},
          {"@type", "CreativeWork"},
          {"name", licence}};
}

/// "2026-11-29 03:50:34" as ISO 8601.
std::string iso_time(std::string text) {
  std::replace(text.begin(), text.end(), ' ', 'T');
  return text;
}

class Crate {
 public:
  void add(Json entity) { graph_.push_back(std::move(entity)); }

  void add_file(const fs::path& folder, const std::string& file, bool is_workflow) {
    Json entity = {{"@id", uri_of(file)}, {"@type", "File"}, {"name", file}, {"encodingFormat", media_type_of(file)}};
    if (const std::string text = said_of_file(file); !text.empty()) entity["description"] = text;
    std::error_code unknown;  // of this very file, which is being written
    if (const auto size = fs::file_size(folder / file, unknown);
        !unknown && file != "report.html" && file != "methods.md")
      entity["contentSize"] = std::to_string(size);
    if (is_workflow) {
      entity["@type"] = {"File", "SoftwareSourceCode", "ComputationalWorkflow"};
      entity["programmingLanguage"] = reference("#breccia-workflow");
    }
    add(std::move(entity));
  }

  /// The program and its plugins; the identifier of the program.
  std::string add_software(const RunFiles& run) {
    const std::string version = program_version(run);
    Json program = {
        {"@id", "#breccia"}, {"@type", "SoftwareApplication"}, {"name", citation_title}, {"softwareVersion", version}};
    if (const Json commit = run.result("environment.commit"); commit.is_string())
      program["version"] = version + " (commit " + commit.get<std::string>() + ")";
    Json needs = Json::array();
    std::vector<Json> plugins;
    if (const Json all = run.given("provenance.plugins"); all.is_object())
      for (const auto& [name, made_with] : all.items()) {
        if (!made_with.is_string()) continue;
        const std::string text = made_with.get<std::string>(), id = "#plugin-" + uri_of(name);
        const std::size_t space = text.find(' ');
        Json plugin = {
            {"@id", id}, {"@type", "SoftwareApplication"}, {"name", name}, {"softwareVersion", text.substr(0, space)}};
        if (space != text.npos) plugin["identifier"] = "sha256:" + text.substr(space + 1);
        plugins.push_back(std::move(plugin));
        needs.push_back(reference(id));
      }
    if (!needs.empty()) program["softwareRequirements"] = needs;
    add(std::move(program));
    for (Json& plugin : plugins) add(std::move(plugin));
    return "#breccia";
  }

  Json metadata() const { return {{"@context", "https://w3id.org/ro/crate/1.1/context"}, {"@graph", graph_}}; }

 private:
  Json graph_ = Json::array();
};

}  // namespace

Json crate_metadata(const CrateContent& content, const ReportFacts& facts) {
  Crate crate;
  crate.add({{"@id", crate_file},
             {"@type", "CreativeWork"},
             {"conformsTo", reference("https://w3id.org/ro/crate/1.1")},
             {"about", reference("./")}});
  Json root = {{"@id", "./"},
               {"@type", "Dataset"},
               {"name", content.name},
               {"description", content.description},
               {"datePublished", facts.date}};
  const bool has_input = std::find(content.files.begin(), content.files.end(), "resolved.yaml") != content.files.end();
  Json parts = Json::array();
  for (const std::string& file : content.files) parts.push_back(reference(uri_of(file)));
  for (const std::string& folder : content.folders) parts.push_back(reference(uri_of(folder) + "/"));
  root["hasPart"] = parts;
  if (has_input) root["mainEntity"] = reference("resolved.yaml");
  if (!facts.licence.empty()) root["license"] = reference(licence_entity(facts.licence)["@id"].get<std::string>());
  Json authors = Json::array();
  for (std::size_t k = 0; k < facts.authors.size(); ++k)
    authors.push_back(reference("#author-" + std::to_string(k + 1)));
  if (!authors.empty()) root["author"] = authors;
  if (content.run) root["mentions"] = reference("#run");
  crate.add(std::move(root));
  for (const std::string& file : content.files) crate.add_file(content.folder, file, file == "resolved.yaml");
  for (const std::string& folder : content.folders)
    crate.add({{"@id", uri_of(folder) + "/"}, {"@type", "Dataset"}, {"name", folder}, {"description", content.part}});
  for (std::size_t k = 0; k < facts.authors.size(); ++k)
    crate.add({{"@id", "#author-" + std::to_string(k + 1)}, {"@type", "Person"}, {"name", facts.authors[k]}});
  if (!facts.licence.empty()) crate.add(licence_entity(facts.licence));
  if (has_input)
    crate.add({{"@id", "#breccia-workflow"}, {"@type", "ComputerLanguage"}, {"name", "Breccia workflow (YAML)"}});
  if (!content.run) return crate.metadata();
  const std::string program = crate.add_software(*content.run);
  Json action = {
      {"@id", "#run"}, {"@type", "CreateAction"}, {"name", "Simulation"}, {"instrument", reference(program)}};
  if (has_input) action["object"] = reference("resolved.yaml");
  Json made = Json::array();
  for (const std::string& file : content.files)
    if (file != "resolved.yaml" && file != "report.html" && file != "methods.md")
      made.push_back(reference(uri_of(file)));
  if (!made.empty()) action["result"] = made;
  if (content.folders.empty() && !content.run->begun.empty()) {
    action["startTime"] = iso_time(content.run->begun);
    action["endTime"] = iso_time(content.run->ended);
  }
  crate.add(std::move(action));
  return crate.metadata();
}

}  // namespace breccia::report
