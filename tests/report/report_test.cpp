// SPDX-License-Identifier: BSD-3-Clause
// breccia report on runs that the program has just made, and on what is none.
#include <gtest/gtest.h>

#include <set>

#include "cli/small_specimen.hpp"

namespace breccia::testing {
namespace {

class Report : public SmallSpecimen {
 protected:
  /// `small.yaml` run into `run`, without pictures.
  void make_run(const std::string& more = "", const std::string& folder = "run") const {
    write_small();
    const Result r = call("run small.yaml --output " + folder + " --set 'protocol.max_strain=0.1 %' " + more);
    ASSERT_EQ(r.code, 0) << r.text;
  }
  std::string page(const std::string& file = "run/report.html") const { return content(folder_ / file); }
  void expect_refused(const std::string& arguments, const std::string& why) const {
    const Result r = call("report " + arguments);
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_NE(r.text.find(why), std::string::npos) << r.text;
    EXPECT_EQ(std::count(r.text.begin(), r.text.end(), '\n'), 1) << "one line: " << r.text;
  }
};

/// `text` without what stands between < and >, entities as they read.
std::string plain(const std::string& html) {
  std::string out;
  bool tag = false;
  for (const char c : html) {
    if (c == '<') tag = true;
    if (!tag) out += c;
    if (c == '>') {
      tag = false;
      out += ' ';
    }
  }
  return out;
}

TEST_F(Report, TellsWhatTheFilesSay) {
  make_run("--set 'reference={source: \"A paper\", peak_stress_Pa: 2e7}'");
  const Result r = call("report run --author 'A. Name' --licence CC-BY-4.0");
  ASSERT_EQ(r.code, 0) << r.text;
  const std::string html = page(), text = plain(html);
  const Json s = summary("run");
  char number[32];
  std::snprintf(number, sizeof number, "%.4g\u00A0GPa", s["youngs_modulus_Pa"].get<double>() / 1e9);
  EXPECT_NE(text.find(number), std::string::npos) << number;
  for (const std::string& part :
       {std::string("A. Name"), std::string("Reference values: A paper"), std::string("20\u00A0MPa"),
        s["environment"]["host"].get<std::string>(), s["environment"]["compiler"].get<std::string>(),
        std::string("Uniaxial compression test of 128 spheres"), std::string("tensile strength of the bond material"),
        std::string("licence: CC-BY-4.0")})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  // The whole input, and the hash of each plugin that made the results.
  const std::string resolved = content(folder_ / "run/resolved.yaml");
  EXPECT_NE(html.find("bond_modulus: 1e10 Pa"), std::string::npos);
  const std::size_t at = resolved.find("contact_law/elastic_brittle: \"");
  const std::string hash = resolved.substr(resolved.find(' ', resolved.find('"', at)) + 1, 64);
  ASSERT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos) << hash;
  EXPECT_NE(html.find(hash), std::string::npos);
  // Nothing comes from elsewhere, nothing runs.
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
  EXPECT_EQ(html.find("<link"), std::string::npos);
  EXPECT_NE(html.find("<html lang=\"en\">"), std::string::npos);
}

TEST_F(Report, MethodsHaveTheNumbersOfTheRun) {
  make_run();
  ASSERT_EQ(call("report run").code, 0);
  const std::string text = content(folder_ / "run/methods.md");
  const Json s = summary("run");
  for (const std::string& part : {std::string("consisted of 128 spheres"), std::string("“elastic brittle” with"),
                                  std::string("bond modulus 10 GPa"), std::string("tensile strength 40 MPa"),
                                  std::string("platen velocity 0.2 m/s"), std::string("2650 kg/m³"),
                                  std::to_string(s["bonds"].get<int>()) + " bonds were made",
                                  std::string("made with Breccia " + s["environment"]["breccia"].get<std::string>())})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

/// RO-Crate 1.1, "RO-Crate Metadata File" and "Root Data Entity": what must be there.
TEST_F(Report, TheCrateHasItsRequiredEntities) {
  make_run();
  ASSERT_EQ(call("report run --author 'A. Name' --author B --licence CC-BY-4.0").code, 0);
  const Json crate = Json::parse(content(folder_ / "run/ro-crate-metadata.json"));
  EXPECT_EQ(crate["@context"], "https://w3id.org/ro/crate/1.1/context");
  std::map<std::string, Json> entities;
  for (const Json& e : crate["@graph"]) {
    ASSERT_TRUE(e.contains("@id") && e.contains("@type")) << e;
    EXPECT_TRUE(entities.emplace(e["@id"].get<std::string>(), e).second) << "twice: " << e["@id"];
  }
  const Json about = entities.at("ro-crate-metadata.json");
  EXPECT_EQ(about["@type"], "CreativeWork");
  EXPECT_EQ(about["about"]["@id"], "./");
  EXPECT_EQ(about["conformsTo"]["@id"], "https://w3id.org/ro/crate/1.1");
  const Json root = entities.at("./");
  EXPECT_EQ(root["@type"], "Dataset");
  for (const char* key : {"name", "description", "datePublished", "license", "hasPart", "author"})
    EXPECT_TRUE(root.contains(key)) << key;
  EXPECT_EQ(root["datePublished"].get<std::string>().size(), std::string("2026-11-29").size());
  EXPECT_EQ(root["license"]["@id"], "https://spdx.org/licenses/CC-BY-4.0");
  std::set<std::string> parts;
  for (const Json& part : root["hasPart"]) parts.insert(part["@id"].get<std::string>());
  for (const char* file : {"summary.json", "curves.csv", "resolved.yaml", "report.html", "methods.md"})
    EXPECT_TRUE(parts.contains(file)) << file;
  for (const std::string& part : parts) EXPECT_TRUE(fs::exists(folder_ / "run" / part)) << part;
  EXPECT_NE(entities.at("resolved.yaml")["@type"].dump().find("ComputationalWorkflow"), std::string::npos);
  EXPECT_EQ(entities.at("#breccia")["@type"], "SoftwareApplication");
  // All that is referred to is described.
  const std::function<void(const Json&)> follow = [&](const Json& value) {
    if (value.is_object() && value.size() == 1 && value.contains("@id")) {
      const std::string id = value["@id"].get<std::string>();
      EXPECT_TRUE(entities.contains(id) || id.starts_with("https://w3id.org/")) << id;
    } else if (value.is_structured()) {
      for (const Json& member : value) follow(member);
    }
  };
  for (const auto& [id, entity] : entities) follow(entity);
}

TEST_F(Report, NamesOfUsersAreTexts) {
  make_run(
      "--set 'name=<b>x & \"y\"' --set 'description=</h1><script>alert(1)</script>' --set 'reference={source: "
      "\"<i>z</i>\"}'");
  ASSERT_EQ(call("report run --author '<u>N</u>' --licence '<s>'").code, 0);
  const std::string html = page();
  for (const char* tag : {"<script", "<b>x", "<i>z", "<u>N", "<s>"})
    EXPECT_EQ(html.find(tag), std::string::npos) << tag;
  EXPECT_NE(html.find("&lt;b&gt;x &amp; &quot;y&quot;"), std::string::npos);
  EXPECT_TRUE(Json::accept(content(folder_ / "run/ro-crate-metadata.json")));
}

TEST_F(Report, PicturesOfTheRunAreInIt) {
  make_run();
  ASSERT_EQ(call("render run --set size=200 --set 'pictures=[{show: stress_strain}]'").code, 0) << "has curves";
  ASSERT_EQ(call("report run").code, 0);
  const std::string html = page();
  EXPECT_NE(html.find("<svg"), std::string::npos);
  EXPECT_EQ(html.find("data:image/png"), std::string::npos) << "the chart stands for its PNG";
  // A file of the list that is gone, or is none.
  fs::remove(folder_ / "run/stress_strain.svg");
  std::ofstream(folder_ / "run/stress_strain.png") << "";
  fs::remove(folder_ / "run/curves.csv");
  const Result r = call("report run --overwrite");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_NE(r.text.find("stress_strain.png is not the picture that its name says"), std::string::npos) << r.text;
  EXPECT_EQ(page().find("data:image/png"), std::string::npos);
  EXPECT_NE(page().find("The curves (curves.csv) are not in the folder"), std::string::npos);
}

TEST_F(Report, AStoppedRunSaysSo) {
  make_run();
  Json s = summary("run");
  ASSERT_EQ(call("report run").code, 0);
  EXPECT_EQ(page().find("was stopped before its end"), std::string::npos);
  s["interrupted"] = true;
  std::ofstream(folder_ / "run/summary.json") << s;
  ASSERT_EQ(call("report run --overwrite").code, 0);
  EXPECT_NE(page().find("was stopped before its end"), std::string::npos);
  EXPECT_NE(content(folder_ / "run/methods.md").find("was stopped before its end"), std::string::npos);
}

/// Results of an earlier version: no environment, no units of newer keys.
TEST_F(Report, OldResults) {
  make_run();
  Json s = summary("run");
  for (const char* key : {"environment", "packing", "energy", "warnings", "units", "format", "values"}) s.erase(key);
  std::ofstream(folder_ / "run/summary.json") << s;
  fs::remove(folder_ / "run/run.log");
  fs::remove(folder_ / "run/resolved.yaml");
  const Result r = call("report run");
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_NE(page().find("an earlier version of Breccia did not record them"), std::string::npos);
  EXPECT_NE(page().find("The input (resolved.yaml) is not in the folder"), std::string::npos);
}

TEST_F(Report, ElsewhereTheResultsAreLeftAlone) {
  make_run();
  const auto files = [&] {
    std::set<std::string> all;
    for (const auto& e : fs::recursive_directory_iterator(folder_ / "run")) all.insert(e.path().string());
    return all;
  };
  const auto before = files();
  fs::permissions(folder_ / "run", fs::perms::owner_read | fs::perms::owner_exec);
  const Result r = call("report run -o mine.html");
  fs::permissions(folder_ / "run", fs::perms::owner_all);
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_EQ(files(), before);
  EXPECT_NE(page("mine.html").find("</html>"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "mine.methods.md"));
  EXPECT_FALSE(fs::exists(folder_ / "ro-crate-metadata.json"));
  expect_refused("run -o .", ". is a folder; a file is needed");
  expect_refused("run -o nowhere/x.html", "cannot write nowhere/x.html: there is no such folder");
}

TEST_F(Report, NothingIsReplacedUnlessAsked) {
  make_run();
  ASSERT_EQ(call("report run").code, 0);
  const std::string before = page();
  expect_refused("run", "report.html is there already; nothing was changed");
  ASSERT_EQ(call("report run --overwrite --author X").code, 0);
  EXPECT_NE(page(), before);
  // One of the user's stays, and the results list what belongs to them.
  make_run("", "other");
  write("other/methods.md", "dear");
  EXPECT_EQ(call("report other --overwrite").code, 2);
  EXPECT_EQ(content(folder_ / "other/methods.md"), "dear");
  EXPECT_FALSE(fs::exists(folder_ / "other/report.html"));
  EXPECT_NE(content(folder_ / "run/breccia.json").find("report.html"), std::string::npos);
  ASSERT_EQ(call("run small.yaml --output run --overwrite --set 'protocol.max_strain=0.1 %'").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "run/report.html")) << "it told of other results";
}

TEST_F(Report, WhatIsNoRunIsNamed) {
  expect_refused("nowhere", "cannot read nowhere: no such folder");
  expect_refused(write("w.yaml", "name: w\n").filename().string(), "w.yaml is a file; the folder that a run");
  fs::create_directories(folder_ / "empty");
  expect_refused("empty", "empty is not the result folder of a run or a study");
  fs::create_directories(folder_ / "drive");
  write("drive/summary.json", R"({"law": "linear"})");
  expect_refused("drive", "is not the summary of a workflow's run");
  write("drive/summary.json", R"({"workflow": )");
  expect_refused("drive", "drive/summary.json is damaged");
  EXPECT_FALSE(fs::exists(folder_ / "drive/report.html"));
  // As a killed run leaves it.
  fs::create_directories(folder_ / "killed/unfinished");
  write("killed/unfinished/breccia.json",
        R"({"format": "breccia results 1", "kind": "run", "finished": false, "files": []})");
  expect_refused("killed", "the run in killed has not come to an end");
  for (const char* folder : {"empty", "killed"}) EXPECT_FALSE(fs::exists(folder_ / folder / ".breccia.lock")) << folder;
}

}  // namespace
}  // namespace breccia::testing
