// SPDX-License-Identifier: BSD-3-Clause
// What a plugin throws while it is at work: the user reads which one it was, and keeps what was measured before. And
// the names by which plugins of one type are told apart.
#include "program.hpp"

namespace breccia::testing {
namespace {

class Faults : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::string csv = "x,y,z,radius\n";
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
          csv += std::to_string(2 * i) + "," + std::to_string(2 * j) + "," + std::to_string(2 * k) + ",1\n";
    write("small.csv", csv);
    std::string plugins;
    for (const char* kind : {"packing", "contact_law", "protocol", "postprocessor", "output", "renderer"})
      plugins += (plugins.empty() ? "" : ", ") + std::string(BRECCIA_BINARY_DIR "/tests/plugins/fixtures/faulty_") +
                 kind + ".so";
    write("small.yaml", "plugins: [" + plugins + R"(]
packing: {type: from_file, file: small.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
protocol: {type: faulty}
engine: {energy_error_limit: 1e9, energy_error_warning: 1e9}
sampling: {every_steps: 5}
)");
  }
  /// A folder of the search path, where plugins go by the names of their files.
  std::string named_folder() const {
    fs::create_directories(folder_ / "plugins");
    fs::copy_file(BRECCIA_BINARY_DIR "/tests/plugins/fixtures/faulty_renderer.so",
                  folder_ / "plugins/breccia_renderer.faulty.so");
    return (folder_ / "plugins").string();
  }
  Result run(const std::string& sets) const { return call("run small.yaml --output out --overwrite " + sets); }
  Json summary() const { return Json::parse(content(folder_ / "out/summary.json")); }
  static bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

  void expect_named(const std::string& sets, const std::string& text) {
    const Result r = run(sets);
    EXPECT_EQ(r.code, 2) << sets << "\n" << r.text;
    EXPECT_TRUE(has(r.text, text)) << sets << "\n" << r.text;
    EXPECT_FALSE(has(r.text, "terminate")) << r.text;
  }
  /// The curves so far, and a summary that says why there are no more.
  void expect_whole_files(const std::string& why) {
    ASSERT_TRUE(fs::exists(folder_ / "out/summary.json"));
    EXPECT_FALSE(fs::exists(folder_ / "out/curves.csv.partial"));
    const Json warnings = summary()["warnings"];
    EXPECT_TRUE(has(warnings.dump(), Json(why).dump().substr(1, 20))) << warnings.dump();
    fs::remove_all(folder_ / "out");
  }
};

TEST_F(Faults, BeforeTheFirstStep) {
  const std::string law = "--set 'contact_law={type: faulty, at: ";
  expect_named("--set 'packing={type: faulty, at: inputs}'",
               "packing `faulty` failed while naming its files: vector::at");
  expect_named("--set 'packing={type: faulty, at: generate}'",
               "packing `faulty` failed while making the packing: vector::at");
  expect_named(law + "prepare}'", "contact_law `faulty` failed while deriving its constants: vector::at");
  expect_named("--set 'protocol={type: faulty, at: setup}'",
               "protocol `faulty` failed while setting up the test: vector::at");
  expect_named("--set 'postprocessors=[{type: faulty, at: begin}]'",
               "postprocessor `faulty` failed while adding its curves: vector::at");
  expect_named("--set 'postprocessors=[{type: faulty, at: needed_curves}]'",
               "postprocessor `faulty` failed while naming the curves it needs: vector::at");
  expect_named("--set 'outputs=[{type: faulty, at: begin}]'",
               "output `faulty` failed while beginning its files: vector::at");
  // From the threads of the engine, out of which no exception goes by itself.
  expect_named(law + "initialise}'", "contact_law `faulty` failed while beginning the history of pairs: vector::at");
  expect_named(law + "stiffness}'", "contact_law `faulty` failed while giving stiffnesses: vector::at");
}

TEST_F(Faults, WhateverIsThrown) {
  const auto set = [](const std::string& what) {
    return "--set 'postprocessors=[{type: faulty, at: begin, throws: " + what + "}]'";
  };
  const std::string who = "postprocessor `faulty`", failed = who + " failed while adding its curves: ";
  expect_named(set("user"), who + ": the dial is stuck");
  expect_named(set("named"), "\n--set:1:17: the dial of `faulty` is stuck");
  expect_named(set("unavailable"), who + ": no dial on this machine");
  expect_named(set("number"), failed + "it threw something that is not an exception");
  expect_named(set("memory"), failed + "there is not enough memory");
  expect_named(set("file"), failed + "cannot use dial.txt: Permission denied");
}

TEST_F(Faults, APluginThatNeverComesBackIsNamedWhenTheRunIsToStop) {
  for (const auto& [at, doing] : {std::pair{"constructor", "being set up"}, {"prepare", "deriving its constants"}}) {
    SCOPED_TRACE(at);
    // Asked to stop after one second, and again after five.
    const Result r = call(
        "run small.yaml --output out --set 'contact_law={type: faulty, at: " + std::string(at) + ", throws: never}'",
        "timeout --foreground -k 30 -s INT 5 timeout --foreground -s INT 1");
    EXPECT_NE(r.code, 0);
    const std::string still = "contact_law `faulty` is still " + std::string(doing);
    EXPECT_TRUE(has(r.text, "breccia: asked to stop, but " + still + "; asked once more, the program ends at once"))
        << r.text;
    EXPECT_TRUE(has(r.text, "breccia: ended at once: " + still)) << r.text;
  }
}

TEST_F(Faults, UnderWayTheCurvesSoFarAreKept) {
  const auto expect_kept = [&](const std::string& sets, const std::string& text) {
    SCOPED_TRACE(sets);
    expect_named("--set 'postprocessors=[{type: stress}]' --set 'outputs=[{type: faulty}]' " + sets, text);
    expect_whole_files(text);
  };
  const std::string protocol = "--set 'protocol={type: faulty, at: ",
                    post = "--set 'postprocessors=[{type: faulty, at: ", output = "--set 'outputs=[{type: faulty, at: ";
  expect_kept(protocol + "step}'", "protocol `faulty` failed while moving what loads the specimen: vector::at");
  expect_kept(protocol + "decide, throws: user}'", "protocol `faulty`: the dial is stuck");
  expect_kept(protocol + "load}'", "protocol `faulty` failed while deciding how the test goes on: vector::at");
  expect_kept(protocol + "sample}'", "protocol `faulty` failed while measuring: vector::at");
  expect_kept(protocol + "share_done}'", "protocol `faulty` failed while telling how far it is: vector::at");
  expect_kept(protocol + "finish}'", "protocol `faulty` failed while summing up: vector::at");
  expect_kept(post + "start_of_loading}]'", "postprocessor `faulty` failed while beginning to measure: vector::at");
  expect_kept(post + "sample, throws: number}]'", "postprocessor `faulty` failed while measuring: it threw something");
  expect_kept(post + "fields}]'", "postprocessor `faulty` failed while giving fields: vector::at");
  expect_kept(post + "finish}]'", "postprocessor `faulty` failed while summing up: vector::at");
  expect_kept(output + "frame}]'", "output `faulty` failed while writing a frame: vector::at");
  expect_kept(output + "interval}]'", "output `faulty` failed while writing a frame: vector::at");
  expect_kept(output + "finish}]'", "output `faulty` failed while ending its files: vector::at");
  const std::string law = "--threads 2 --set 'contact_law={type: faulty, at: ";
  expect_kept(law + "evaluate}'", "contact_law `faulty` failed while giving forces: vector::at");
  expect_kept(law + "energy}'", "contact_law `faulty` failed while giving energies: vector::at");
  expect_kept(law + "derived}'", "contact_law `faulty` failed while deriving its constants: vector::at");
}

TEST_F(Faults, OthersSumUpWhatTheyHave) {
  const Result r = run("--set 'postprocessors=[{type: faulty, at: sample}, {type: faulty, name: sound}]'");
  EXPECT_EQ(r.code, 2) << r.text;
  const Json s = summary();
  EXPECT_TRUE(s.contains("steps_of_test"));
  EXPECT_EQ(s["sound_faulty"]["rows"], 3);  // steps 0, 5 and 10
  EXPECT_FALSE(s.contains("faulty"));
  EXPECT_FALSE(s.contains("last_dial_m"));
}

TEST_F(Faults, ARendererLosesOnlyItsPictures) {
  Result r = run("--set 'renderers=[{type: faulty, at: render}, {type: faulty, name: sound}]'");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "renderer `faulty` failed while drawing: vector::at")) << r.text;
  EXPECT_TRUE(fs::exists(folder_ / "out/sound_faulty/picture.txt"));
}

TEST_F(Faults, PicturesOfRenderBelongToTheResults) {
  ASSERT_EQ(run("").code, 0);
  EXPECT_FALSE(has(content(folder_ / "out/breccia.json"), "picture.txt"));
  const std::string path = "BRECCIA_PLUGIN_PATH='" + named_folder() + "'";
  const Result failed = call("render out --renderer faulty --set at=render", path);
  EXPECT_EQ(failed.code, 2) << failed.text;
  EXPECT_TRUE(has(failed.text, "renderer `faulty` failed while drawing: vector::at")) << failed.text;
  const Result r = call("render out --renderer faulty", path);
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(content(folder_ / "out/breccia.json"), "\"picture.txt\"")) << content(folder_ / "out/breccia.json");
  write("out/mine.txt", "dear");
  ASSERT_EQ(run("").code, 0);  // so that they go with them
  EXPECT_FALSE(fs::exists(folder_ / "out/picture.txt"));
  EXPECT_EQ(content(folder_ / "out/mine.txt"), "dear");
}

TEST_F(Faults, ComparingNamesTheRenderer) {
  ASSERT_EQ(run("").code, 0);
  const std::string path = "BRECCIA_PLUGIN_PATH='" + named_folder() + "'";
  const Result r = call("compare out -o both --renderer faulty --set at=compare", path);
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "renderer `faulty` failed while drawing: vector::at")) << r.text;
  EXPECT_EQ(call("compare out -o both --renderer faulty", path).code, 0);
}

TEST_F(Faults, DriveAndItsLaw) {
  write("path.csv", "normal_m\n0\n1e-6\n");
  for (const auto& [at, doing] : {std::pair{"prepare", "deriving its constants"},
                                  {"evaluate", "giving forces"},
                                  {"energy", "giving energies"},
                                  {"derived", "deriving its constants"}}) {
    const Result r = call(
        "drive small.yaml --path path.csv -o driven --overwrite --steps 2000 --set 'contact_law={type: faulty, at: " +
        std::string(at) + "}'");
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_TRUE(has(r.text, "contact_law `faulty` failed while " + std::string(doing) + ": vector::at")) << r.text;
  }
}

TEST_F(Faults, ACaseOfAStudyNamesThePluginInTheTable) {
  write("study.yaml", "workflow: small.yaml\nlist: {protocol.at: [nowhere, step]}\n");
  EXPECT_EQ(call("sweep study.yaml -o study").code, 1);
  EXPECT_TRUE(has(content(folder_ / "study/results.csv"), "protocol `faulty` failed while moving what loads"));
}

TEST_F(Faults, TwoOfATypeByTheirNames) {
  const Result r =
      run("--set 'postprocessors=[{type: faulty}, {type: faulty, name: upper}, {type: faulty, name: lower}]' "
          "--set 'outputs=[{type: faulty, name: fine}, {type: faulty}]' "
          "--set 'renderers=[{type: faulty, name: a}, {type: faulty, name: b}]'");
  ASSERT_EQ(r.code, 0) << r.text;
  const std::string curves = content(folder_ / "out/curves.csv");
  EXPECT_EQ(curves.substr(0, curves.find('\n')), "time_s,dial_m,upper_dial_m,lower_dial_m");
  const Json s = summary();
  for (const char* key :
       {"last_dial_m", "upper_last_dial_m", "lower_last_dial_m", "faulty", "upper_faulty", "lower_faulty"})
    EXPECT_TRUE(s.contains(key)) << key;
  for (const char* file : {"tables/dials.csv", "tables/upper_dials.csv", "frame.txt", "fine_faulty/frame.txt",
                           "a_faulty/picture.txt", "b_faulty/picture.txt"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
  const Json described = Json::parse(content(folder_ / "out/tables/upper_dials.json"));
  EXPECT_EQ(described[0]["header"], "value_m");
  EXPECT_EQ(described[0]["name"], "value");
  EXPECT_EQ(described[0]["unit"], "m");
  EXPECT_EQ(content(folder_ / "out/fine_faulty/frame.txt"), "reading\nupper_reading\nlower_reading\n");
  const std::string manifest = content(folder_ / "out/breccia.json");
  EXPECT_TRUE(has(manifest, "fine_faulty/frame.txt") && has(manifest, "a_faulty/picture.txt")) << manifest;

  // The same again from what was resolved; its pictures again by `render`, each in its place.
  ASSERT_EQ(call("run out/resolved.yaml --output again").code, 0);
  EXPECT_EQ(content(folder_ / "again/curves.csv"), curves);
  EXPECT_EQ(content(folder_ / "again/resolved.yaml"), content(folder_ / "out/resolved.yaml"));
  fs::remove_all(folder_ / "out/a_faulty");
  const Result drawn = call("render out --renderer faulty --overwrite");
  EXPECT_EQ(drawn.code, 0) << drawn.text;
  EXPECT_TRUE(fs::exists(folder_ / "out/a_faulty/picture.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "out/picture.txt"));
}

TEST_F(Faults, TwinsAndBadNamesAreRefused) {
  const auto refused = [&](const std::string& list, const std::string& items, const std::string& text) {
    const Result r = call("validate small.yaml --set '" + list + "=[" + items + "]'");
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_TRUE(has(r.text, text)) << r.text;
  };
  refused("postprocessors", "{type: faulty}, {type: faulty}",
          "postprocessors[1]: a second `faulty` (the first is postprocessors[0]): both would write the same curves and "
          "results; keep one of them, or give it a name: `{type: faulty, name: upper}`");
  refused("outputs", "{type: faulty, name: a}, {type: faulty, name: a}",
          "outputs[1]: a second `faulty` that goes by `a_faulty` (the first is outputs[0]): both would write the same "
          "files; give it another `name`");
  refused("renderers", "{type: faulty}, {type: faulty}", "both would write the same pictures");
  for (const char* bad : {"a/b", "\"a,b\"", "a b", "\"\"", ".a", "a.b", "\"a`b\""})
    refused("postprocessors", "{type: faulty, name: " + std::string(bad) + "}", "postprocessors[0].name: `");
  refused("postprocessors", "{type: faulty, nmae: a}", "did you mean `name`?");
  refused("postprocessors", "{type: faulty, name: [a]}", "postprocessors[0].name: ");
  // Only in lists are there others to be told from.
  const Result r = call("validate small.yaml --set protocol.name=a");
  EXPECT_EQ(r.code, 2) << r.text;
}

TEST_F(Faults, DescribeAndTheSchemaKnowTheName) {
  const Result post = call("describe postprocessor/stress"), protocol = call("describe protocol/uniaxial_compression");
  EXPECT_TRUE(has(post.text, "  name  (text; optional)")) << post.text;
  EXPECT_FALSE(has(protocol.text, "  name  (")) << protocol.text;
  const Json schema = Json::parse(call("schema workflow").text);
  std::size_t count = 0;
  for (const auto& [name, section] : schema["definitions"].items()) {
    if (!name.ends_with("_in_list") || !section.contains("additionalProperties")) continue;
    EXPECT_TRUE(section["properties"].contains("name")) << name;
    ++count;
  }
  EXPECT_GT(count, 10u);
  EXPECT_FALSE(schema["definitions"]["protocol_brazilian"]["properties"].contains("name"));
}

}  // namespace
}  // namespace breccia::testing
