// SPDX-License-Identifier: BSD-3-Clause
// A run that goes on from a checkpoint ends in the bits of one that was never stopped: for every plugin that is
// shipped, with other threads than before.
#include <csignal>

#include "every_plugin.hpp"
#include "sweep_support.hpp"

namespace breccia::testing {
namespace {

class Resume : public SmallSpecimen, public ::testing::WithParamInterface<Case> {
 protected:
  void expect_same(const std::string& run, const std::string& other) const {
    expect_same_results(folder_ / run, folder_ / other);
  }
  std::vector<fs::path> checkpoints(const std::string& run) const { return checkpoints_of(folder_ / run); }
};

TEST_P(Resume, EndsInTheSameBits) {
  write_spheres();
  write("w.yaml", GetParam().text);
  const Result whole = call("run w.yaml --output whole --threads 1");
  ASSERT_EQ(whole.code, 0) << whole.text;
  const auto all = checkpoints("whole");
  ASSERT_GE(all.size(), 3u) << whole.text;
  // From near the beginning, from the middle, from the last step.
  for (const std::size_t from : {std::size_t(0), all.size() / 2, all.size() - 1}) {
    const std::string run = "from_" + std::to_string(from);
    fs::copy(folder_ / "whole", folder_ / run, fs::copy_options::recursive);
    for (std::size_t k = from + 1; k < all.size(); ++k) fs::remove(folder_ / run / "checkpoints" / all[k].filename());
    // Whatever was written after the checkpoint is not what it was: it must be written anew.
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "whole"))
      if (std::set<std::string>{".vtp", ".xyz", ".gz"}.contains(entry.path().extension()) &&
          fs::last_write_time(entry) > fs::last_write_time(all[from]))
        std::ofstream(folder_ / run / entry.path().lexically_relative(folder_ / "whole")) << "of later";
    const Result r = call("run --resume " + run + " --threads " + std::to_string(1 + from % 3));
    ASSERT_EQ(r.code, 0) << r.text;
    ASSERT_TRUE(has(r.text, "goes on from")) << r.text;
    expect_same("whole", run);
    EXPECT_EQ(checkpoints(run).size(), all.size()) << run;
  }
  // Checkpoints have no part in the test.
  const Result without = call("run w.yaml --output without --threads 2 --set checkpoints.keep=0");
  ASSERT_EQ(without.code, 0) << without.text;
  fs::remove(folder_ / "without/resolved.yaml");
  fs::remove(folder_ / "whole/resolved.yaml");
  expect_same("whole", "without");
}

INSTANTIATE_TEST_SUITE_P(Shipped, Resume, ::testing::ValuesIn(cases()), [](const auto& its) { return its.param.name; });

TEST(ResumeCases, HaveEveryPluginThatRuns) {
  std::string text;
  for (const Case& c : cases()) text += c.text;
  for (const auto& entry : fs::directory_iterator(BRECCIA_BINARY_DIR "/lib/breccia")) {
    const std::string file = entry.path().filename().string();
    for (const char* kind : {"contact_law", "protocol", "postprocessor", "output"}) {
      const std::string head = std::string("breccia_") + kind + ".";
      if (!file.starts_with(head)) continue;
      const std::string name = file.substr(head.size(), file.size() - head.size() - 3);
      EXPECT_TRUE(has(text, "{type: " + name)) << kind << " `" << name << "` is in no case of this test";
    }
  }
}

class SweepResume : public SweepProgram {};
class StoppedBySignal : public SweepProgram {};

TEST_F(StoppedBySignal, LeavesACheckpointAndGoesOn) {
  const std::string column = BRECCIA_SOURCE_DIR "/tests/torture/column.yaml";
  const std::vector<std::string> slowly = {"--set", "protocol.platen_velocity=0.3m/s", "--set",
                                           "checkpoints.every_steps=1000000"};
  const auto with = [&](const std::string& output) {
    std::vector<std::string> all = {"run", column, "--threads", "1", "--output", output};
    all.insert(all.end(), slowly.begin(), slowly.end());
    return all;
  };
  std::string words;
  for (const std::string& word : with("whole")) words += word + " ";
  const Result whole = call(words);
  ASSERT_EQ(whole.code, 0) << whole.text;
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    const std::string run = "stopped_" + std::to_string(signal);
    const pid_t child = start(with(run));
    const fs::path growing = folder_ / run / "unfinished";
    EXPECT_TRUE(within_a_minute([&] { return fs::exists(growing / "particles_000002.vtp"); }));
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    ASSERT_EQ(WEXITSTATUS(status), 130) << "stopped before its end";
    EXPECT_TRUE(Json::parse(content(folder_ / run / "summary.json"))["interrupted"].get<bool>());
    const Result r = call("run --resume " + run + " --threads 2");
    ASSERT_EQ(r.code, 0) << r.text;
    EXPECT_TRUE(has(r.text, "goes on from")) << r.text;
    const auto a = results_of(folder_ / "whole"), b = results_of(folder_ / run);
    for (const auto& [name, text] : a) EXPECT_TRUE(b.contains(name) && b.at(name) == text) << run << ": " << name;
    EXPECT_EQ(a.size(), b.size());
  }
}

TEST_F(SweepResume, ACaseGoesOnFromItsCheckpoint) {
  write("study.yaml",
        "workflows: [{name: soft, file: small.yaml}]\nfixed: {checkpoints.every_steps: 20}\n"
        "grid: {contact_law.stiffness_ratio: [2, 4]}\ncollect: [youngs_modulus_Pa]\n");
  ASSERT_EQ(call("sweep study.yaml --jobs 2").code, 0);
  const fs::path folder = case_of("study", results("study").at(1).at("folder"));
  const std::string curves = content(folder / "curves.csv"), table = content(folder_ / "results/study/results.csv");
  // As if it had been stopped.
  Json about = Json::parse(content(folder / "case.json"));
  about["status"] = "interrupted";
  std::ofstream(folder / "case.json") << about.dump();
  const Result r = call("sweep study.yaml --jobs 2");
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "2 cases, 1 to run")) << r.text;
  EXPECT_TRUE(has(content(folder / "run.log"), "goes on from")) << content(folder / "run.log");
  EXPECT_EQ(content(folder / "curves.csv"), curves);
  EXPECT_EQ(content(folder_ / "results/study/results.csv"), table);
}

class Stopped : public SmallSpecimen {
 protected:
  void SetUp() override {
    SmallSpecimen::SetUp();
    write_small();
    ASSERT_EQ(call("run small.yaml --output whole " + often).code, 0);
  }
  std::string newest() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "whole/checkpoints"))
      names.insert(entry.path().filename().string());
    return "whole/checkpoints/" + *names.rbegin();
  }
  const std::string often = "--threads 1 --set checkpoints.every_steps=50 ";
};

TEST_F(Stopped, KeepsTheNewestOnly) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_ / "whole/checkpoints")) ++count;
  EXPECT_EQ(count, 2u);
}

TEST_F(Stopped, OfADamagedOneTheOneBeforeIsUsed) {
  std::string bytes = content(folder_ / newest());
  bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(folder_ / newest(), std::ios::binary) << bytes;
  const Result r = call("run --resume whole");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "is damaged")) << r.text;
  EXPECT_TRUE(has(r.text, "goes on from")) << r.text;
}

TEST_F(Stopped, APluginThatDoesNotSayIsNamed) {
  const std::string more = "plugins: ['" BRECCIA_BINARY_DIR "/tests/plugins/fixtures/faulty_postprocessor.so']\n";
  write("faulty.yaml", more + small);
  const Result r = call("run faulty.yaml --output faulty --set 'postprocessors=[{type: faulty}]' " + often);
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "postprocessor `faulty` does not say what changes in it while it runs")) << r.text;
  EXPECT_FALSE(fs::exists(folder_ / "faulty/checkpoints"));
}

TEST_F(Stopped, AFullDiskCostsTheCheckpointOnly) {
  // A limit of the size stands for the full disk: the curves fit, a checkpoint does not.
  const Result r = call("run small.yaml --output full " + often, "ulimit -f 200; trap '' XFSZ;");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "no checkpoint at step 50: cannot write")) << r.text;
  EXPECT_EQ(content(folder_ / "full/curves.csv"), content(folder_ / "whole/curves.csv"));
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "full"))
    EXPECT_FALSE(has(entry.path().filename().string(), ".h5")) << entry.path();
}

TEST_F(Stopped, WhatDoesNotBelongIsRefused) {
  Result r = call("run --resume nowhere");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "no checkpoint in")) << r.text;
  r = call("run --resume whole --set seed=3");
  EXPECT_NE(r.code, 0) << r.text;
  EXPECT_NE(call("run small.yaml --resume whole").code, 0);
  EXPECT_NE(call("run").code, 0);
  // Another workflow beside it.
  const std::string resolved = content(folder_ / "whole/resolved.yaml");
  std::ofstream(folder_ / "whole/resolved.yaml") << resolved << "\n# a remark\n";
  r = call("run --resume whole");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "is not the workflow")) << r.text;
  // Neither one is whole.
  for (const auto& entry : fs::directory_iterator(folder_ / "whole/checkpoints")) fs::resize_file(entry.path(), 700);
  r = call("run --resume whole");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "no usable checkpoint")) << r.text;
}

}  // namespace
}  // namespace breccia::testing
