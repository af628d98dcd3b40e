// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong around a run, at each of its stages: it ends with a text that says what happened, what is kept and
// how to go on; nothing stands half-written under a final name; earlier results stay; and when the cause is gone the
// run goes on to the bits of one that nothing happened to.
#include "fault_support.hpp"

namespace breccia::testing {
namespace {

/// What happens, as a command that a plugin runs in the midst of the run.
struct Cause {
  const char *name, *command;
  const char* says = nullptr;  ///< the reason, in what the user reads
};
constexpr Cause causes[] = {
    {"full_disk", "cat /dev/zero >filler 2>/dev/null; true", "No space left on device"},
    {"read_only_folder", "find out -type d -exec chmod a-w {} +", "Permission denied"},
    {"folder_removed", "rm -r out", "was removed, renamed or replaced"},
    {"memory_exhausted", "prlimit --pid $PPID --data=1", nullptr},
};

/// When it happens: what the run still has to write then.
struct Stage {
  const char *name, *at, *more;
};
constexpr Stage stages[] = {
    {"curves", "sample", "checkpoints: {keep: 0}\n"},
    {"vtk", "sample", "checkpoints: {keep: 0}\noutputs: [{type: vtk, interval: 1 us}]\n"},
    {"checkpoint", "sample", "checkpoints: {every_steps: 10}\n"},
    {"summary", "finish", "checkpoints: {every_steps: 10}\n"},
    {"pictures", "render", "checkpoints: {every_steps: 10}\n"},
};

class Stages : public FaultyPrograms, public ::testing::WithParamInterface<std::tuple<Stage, Cause>> {
 protected:
  static std::string workflow(const Stage& stage, const Cause& cause) {
    const std::string command = std::string(", command: 'test -e mended || { ") + cause.command + "; }'}";
    const bool drawing = std::string(stage.at) == "render";
    std::string text = plugins() + specimen + stage.more + "postprocessors: [{type: stress}, {type: energy}";
    if (drawing) return text + "]\nrenderers: [{type: faulty, at: render" + command + ", {type: pictures}]\n";
    return text + ", {type: faulty, at: " + stage.at + command + "]\n";
  }
};

TEST_P(Stages, EndInOrder) {
  const auto& [stage, cause] = GetParam();
  const std::string name = cause.name, when = stage.name;
  const bool removed = name == "folder_removed", memory = name == "memory_exhausted";
  if (name == "full_disk" && !is_on_a_small_disk(8u << 20))
    GTEST_SKIP() << "NOTHING WAS TESTED: a full disk needs a tmpfs (root, or user namespaces)";
  if (name == "read_only_folder" && !modes_are_minded())
    GTEST_SKIP() << "NOTHING WAS TESTED: whoever runs this test can write to any folder, and there is no setpriv";
  write_spheres();
  write("w.yaml", workflow(stage, cause));
  write("mended", "");
  const std::string run = "run w.yaml --threads 2 --output out --overwrite";
  ASSERT_EQ(call(run).code, 0);
  const auto earlier = all_files(folder_ / "out");
  fs::remove(folder_ / "mended");

  const Result r = call(run, name == "read_only_folder" && geteuid() == 0 ? unprivileged : "");
  call_shell("rm -f filler; find . -type d -exec chmod u+w {} +");
  SCOPED_TRACE(r.text);
  const bool pictures_only = when == "pictures" && !removed;
  // Memory that is there already is enough for much of it.
  if (memory) EXPECT_TRUE(r.code == 0 || r.code == 2) << r.code;
  else EXPECT_EQ(r.code, pictures_only ? 0 : 2);
  for (const char* raw : {"terminate", "internal error", "what()", "libgomp"}) EXPECT_FALSE(has(r.text, raw)) << raw;
  if (cause.says) { EXPECT_TRUE(has(r.text, cause.says)); }
  EXPECT_EQ(torsos(folder_ / "out"), "");
  if (removed) {
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    return;
  }
  if (r.code == 0) {
    EXPECT_TRUE(has(r.text, "results in out"));
    EXPECT_EQ(content(folder_ / "out/curves.csv"), earlier.at("curves.csv"));
    if (pictures_only && !memory) { EXPECT_TRUE(has(r.text, "no pictures by renderer `pictures`")); }
    return;
  }
  for (const auto& [file, text] : earlier) EXPECT_TRUE(content(folder_ / "out" / file) == text) << file;
  const bool goes_on = has(r.text, "once the cause is mended, `breccia run --resume out` goes on from step ");
  EXPECT_EQ(goes_on, when == "checkpoint" || when == "summary");
  EXPECT_TRUE(goes_on || has(r.text, "there is no checkpoint to go on from"));
  if (!goes_on) return;
  EXPECT_EQ(r.text.find("no checkpoint at step"), r.text.rfind("no checkpoint at step")) << "is said once";
  write("mended", "");
  const Result resumed = call("run --resume out --threads 1");
  EXPECT_EQ(resumed.code, 0) << resumed.text;
  EXPECT_EQ(content(folder_ / "out/curves.csv"), earlier.at("curves.csv"));
  EXPECT_EQ(torsos(folder_ / "out"), "");
}

INSTANTIATE_TEST_SUITE_P(All, Stages, ::testing::Combine(::testing::ValuesIn(stages), ::testing::ValuesIn(causes)),
                         [](const auto& its) {
                           return std::string(std::get<0>(its.param).name) + "_" + std::get<1>(its.param).name;
                         });

class Disks : public FaultyPrograms {};

TEST_F(Disks, DISABLED_OfAnySizeEndInOrder) {
  if (!is_on_a_small_disk(16u << 20)) GTEST_SKIP() << "NOTHING WAS TESTED: no tmpfs (root, or user namespaces)";
  write_spheres();
  write("w.yaml", std::string(specimen) +
                      "checkpoints: {every_steps: 20}\noutputs: [{type: vtk, interval: 5 us}]\n"
                      "postprocessors: [{type: stress}]\nrenderers: [{type: pictures, pictures: [stress_strain]}]\n");
  ASSERT_EQ(call("run w.yaml --threads 1 --output whole").code, 0);
  const std::string curves = content(folder_ / "whole/curves.csv");
  fs::remove_all(folder_ / "whole");
  bool finished = false;
  // It is full wherever the space runs out: sizes grow until all has its place.
  for (std::size_t left = 4096, k = 0; !finished; left = left * 4 / 3 + 4096, ++k) {
    ASSERT_LT(k, 40u);
    const std::string fill = "cat /dev/zero >filler 2>/dev/null; truncate -s -" + std::to_string(left) + " filler";
    call_shell(fill);
    const Result r = call("run w.yaml --threads 1 --output out");
    fs::remove(folder_ / "filler");
    SCOPED_TRACE(std::to_string(left) + " bytes left\n" + r.text);
    EXPECT_EQ(torsos(folder_ / "out"), "");
    if (r.code == 0) {
      EXPECT_EQ(content(folder_ / "out/curves.csv"), curves);
      finished = !has(r.text, "No space left");
    } else {
      EXPECT_EQ(r.code, 2);
      EXPECT_TRUE(has(r.text, "No space left on device"));
    }
    if (has(r.text, "breccia run --resume out")) {
      const Result resumed = call("run --resume out --threads 1");
      EXPECT_EQ(resumed.code, 0) << resumed.text;
      EXPECT_EQ(content(folder_ / "out/curves.csv"), curves);
    }
    fs::remove_all(folder_ / "out");
  }
}

}  // namespace
}  // namespace breccia::testing
