// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong beside a run's own files: the cache of packings, other runs, plugins' files, memory, the motion
// itself.
#include <csignal>

#include "fault_support.hpp"
#include "sweep_support.hpp"

namespace breccia::testing {
namespace {

class Around : public FaultyPrograms {
 protected:
  static std::string doing(const std::string& command, const char* at = "sample") {
    return "postprocessors: [{type: stress}, {type: faulty, at: " + std::string(at) + ", command: '" + command +
           "'}]\n";
  }
  void expect(const Result& r, int code, const std::string& part) const {
    EXPECT_EQ(r.code, code) << r.text;
    EXPECT_TRUE(has(r.text, part)) << part << "\n" << r.text;
    EXPECT_EQ(torsos(folder_ / "out"), "");
  }
  fs::path cached() const {
    for (const auto& e : fs::directory_iterator(folder_ / "cache/packings")) return e.path();
    return {};
  }
};

TEST_F(Around, ACacheThatIsFullOrClosedCostsTheCacheOnly) {
  if (!is_on_a_small_disk(4u << 20)) GTEST_SKIP() << "NOTHING WAS TESTED: no tmpfs (root, or user namespaces)";
  write_spheres();
  write("w.yaml", specimen);
  call_shell("mkdir cache && cat /dev/zero >filler 2>/dev/null; truncate -s -200000 filler");
  // The cache alone is on the full disk.
  const std::string elsewhere = (fs::temp_directory_path() / ("breccia-out-" + std::to_string(getpid()))).string();
  const Result r = call("run w.yaml --threads 1 --output " + elsewhere, "cat /dev/zero >more 2>/dev/null;");
  fs::remove_all(elsewhere);
  expect(r, 0, "warning: the packing was not kept for the next run: cannot ");
  EXPECT_TRUE(has(r.text, "No space left on device")) << r.text;
  call_shell("rm -f filler more");
  if (!modes_are_minded()) GTEST_SKIP() << "NOTHING WAS TESTED of a closed cache: no setpriv";
  call_shell("rm -rf cache; mkdir -p cache/packings; chmod a-w cache/packings");
  expect(call("run w.yaml --threads 1 --output out", geteuid() == 0 ? unprivileged : ""), 0, "Permission denied");
}

TEST_F(Around, ADamagedCacheIsMadeAnewAndARemovedOneIsWrittenAgain) {
  write("w.yaml", specimen);
  const std::string run = "run w.yaml --threads 1 --overwrite --output out";
  ASSERT_EQ(call(run).code, 0);
  const std::string curves = content(folder_ / "out/curves.csv"), packing = content(cached());
  std::string flipped = packing;
  flipped[packing.size() / 2] = char(flipped[packing.size() / 2] ^ 4);
  for (const std::string& bytes : {flipped, packing.substr(0, packing.size() / 2), std::string()}) {
    std::ofstream(cached(), std::ios::binary) << bytes;
    expect(call(run), 0, "is damaged and is made anew");
    EXPECT_EQ(content(cached()), packing);
    EXPECT_EQ(content(folder_ / "out/curves.csv"), curves);
  }
  write("gone.yaml", plugins() + specimen + "postprocessors: [{type: stress}]\n");
  const Result r = call(
      "run gone.yaml --threads 1 --output out --overwrite "
      "--set 'packing={type: faulty, at: generate, command: rm -r cache}'");
  expect(r, 0, "finished");
  EXPECT_TRUE(fs::exists(cached())) << r.text;
}

TEST_F(Around, TwoRunsIntoOneFolder) {
  write("w.yaml",
        plugins() + specimen + doing("\"" + program + "\" run w.yaml --output out --overwrite >second 2>&1; true"));
  const Result r = call("run w.yaml --threads 1 --output out");
  expect(r, 0, "finished");
  const std::string second = content(folder_ / "second");
  EXPECT_TRUE(has(second, "is in use by another run (process ")) << second;
  EXPECT_TRUE(has(second, "nothing was changed. Wait for it, or choose another with --output")) << second;
}

TEST_F(Around, WhatTakesAFoldersPlaceIsNotTouched) {
  // The folder is removed and another run has begun there: its files have the names that the first one writes.
  write("w.yaml", plugins() + specimen + "outputs: [{type: vtk, interval: 1 us}]\ncheckpoints: {every_steps: 10}\n" +
                      doing("rm -r out; cp -r others out"));
  for (const char* file : {"unfinished/curves.csv.partial", "unfinished/breccia.json", ".breccia.lock"}) {
    fs::create_directories((folder_ / "others" / file).parent_path());
    write("others/" + std::string(file), "of another");
  }
  const Result r = call("run w.yaml --threads 1 --output out");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "was removed, renamed or replaced while results grew in it: the run ends here")) << r.text;
  for (const char* file : {"unfinished/curves.csv.partial", "unfinished/breccia.json", ".breccia.lock"})
    EXPECT_EQ(content(folder_ / "out" / file), "of another") << file;
  EXPECT_FALSE(fs::exists(folder_ / "out/curves.csv"));
}

// Not yet right since branches and lazy hashes came: see the closing note of issue 13.
TEST_F(Around, DISABLED_APluginsFileThatGoesUnderWayIsNotMissedUntilItIsToGoOn) {
  // A copy, which may be harmed.
  const std::string law = BRECCIA_BINARY_DIR "/tests/plugins/fixtures/faulty_renderer.so";
  fs::copy_file(law, folder_ / "own.so");
  const std::string head =
      "plugins: ['" BRECCIA_BINARY_DIR "/tests/plugins/fixtures/faulty_postprocessor.so', own.so]\n";
  for (const auto& [command, says] :
       {std::pair{"rm own.so", "own.so"}, {"cp own.so new.so && echo >>new.so && mv new.so own.so", "own.so"}}) {
    SCOPED_TRACE(command);
    if (!fs::exists(folder_ / "own.so")) fs::copy_file(law, folder_ / "own.so");
    write("w.yaml", head + specimen + "checkpoints: {every_steps: 10}\nrenderers: [{type: faulty}]\n" +
                        doing(std::string("test -e once || { ") + command + " && touch once; }"));
    fs::remove(folder_ / "once");
    const Result r = call("run w.yaml --threads 1 --output out --overwrite");
    expect(r, 0, "finished");
    const Result resumed = call("run --resume out --threads 1");
    EXPECT_EQ(resumed.code, 2) << resumed.text;
    EXPECT_TRUE(has(resumed.text, says)) << resumed.text;
    EXPECT_FALSE(has(resumed.text, "terminate")) << resumed.text;
  }
}

TEST_F(Around, DISABLED_MemoryOfAnySizeEndsInOrder) {
  // Twenty thousand bonds: large enough that each part of the preparation has its turn.
  std::string big = content(BRECCIA_SOURCE_DIR "/tests/torture/column.yaml");
  const std::string size = "[10 mm, 10 mm, 20 mm]";
  big.replace(big.find(size), size.size(), "[18 mm, 18 mm, 36 mm]");
  write("big.yaml", big);
  const std::string run = "run big.yaml --output out --overwrite --set protocol.max_strain=0.1% --threads ";
  int codes[3] = {0, 0, 0};
  for (const int megabytes : {2, 5, 8, 12, 16, 20, 24, 28, 32, 40, 50}) {
    const Result r = call(run + (megabytes % 3 ? "1" : "2"), "prlimit --data=" + std::to_string(megabytes) + "000000");
    SCOPED_TRACE(std::to_string(megabytes) + " MB\n" + r.text);
    ASSERT_TRUE(r.code >= 0 && r.code <= 2) << r.code;
    ++codes[r.code];
    for (const char* raw : {"terminate", "internal error", "what()", "libgomp", "bad_alloc"})
      EXPECT_FALSE(has(r.text, raw)) << raw;
    EXPECT_TRUE(r.code == 0 || has(r.text, "memory")) << "says why";
    EXPECT_EQ(torsos(folder_ / "out"), "");
    if (r.code == 1) { EXPECT_TRUE(has(r.text, "that it may have (ulimit -d)")); }
  }
  EXPECT_GT(codes[1], 2) << "nothing was tested of it";
}

TEST_F(Around, DISABLED_AMotionThatRunsAwayKeepsWhatWasMeasuredBefore) {
  write("w.yaml", plugins() + specimen + "postprocessors: [{type: stress}]\nchecks: {implausible_values: false}\n");
  const Result r = call(
      "run w.yaml --threads 1 --output out --set sampling.every_steps=1 "
      "--set 'contact_law={type: faulty, at: evaluate, throws: nan}'");
  expect(r, 2, "ended before its time");
  EXPECT_TRUE(has(r.text, "why: ")) << r.text;
  EXPECT_TRUE(has(r.text, "what was measured until then is in out/curves.csv")) << r.text;
}

TEST_F(Around, EnergyThatGrowsEndsTheRunWhichCanGoOn) {
  write("w.yaml", std::string(specimen) +
                      "postprocessors: [{type: stress}]\ncheckpoints: {every_steps: 10}\n"
                      "engine: {energy_error_limit: 1e-12, energy_error_warning: 1e-13}\n");
  const Result r = call("run w.yaml --threads 1 --output out");
  expect(r, 2, "energy does not close");
  EXPECT_TRUE(has(r.text, "engine.energy_error_limit: 1e9 lets it go on")) << r.text;
  EXPECT_TRUE(has(r.text, "what was measured until then is in out/curves.csv")) << r.text;
}

TEST_F(Around, ParticlesThatFlyOffAreContainedAndSaid) {
  // Two that overlap by a half and belong to nobody, shot off by their own force.
  std::ofstream(folder_ / "small.csv", std::ios::app) << "100,3,3,1\n101,3,3,1\n";
  write("w.yaml", std::string(specimen) + "postprocessors: [{type: stress}]\n");
  const Result r = call(
      "run w.yaml --threads 1 --output out --set 'bonding={tolerance: 0.15}' --set 'damping={translational: 0, "
      "rotational: 0}' --set checks.flown_off=1",
      "timeout 60 prlimit --as=2000000000");
  expect(r, 0, "particles have flown off: particle ");
  EXPECT_TRUE(has(Json::parse(content(folder_ / "out/summary.json"))["warnings"].dump(), "have flown off"));
}

}  // namespace
}  // namespace breccia::testing
