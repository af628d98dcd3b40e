// SPDX-License-Identifier: BSD-3-Clause
// `mpirun -n N breccia run` where something is wrong, or goes wrong, on all ranks or on one: it ends in order, says so
// once, and goes on from what was kept.
#include <gtest/gtest.h>

#include <csignal>

#include "cli/fault_support.hpp"
#include "ranks/launched.hpp"

namespace breccia::testing {
namespace {

/// What fails on one rank ends all of them in order: one message, whole files, the exit code of one rank.
TEST_F(Ranks, WhatFailsOnOneEndsAll) {
  write_many_spheres();
  const std::string fixtures = BRECCIA_BINARY_DIR "/tests/plugins/fixtures/faulty_";
  const std::string head = "plugins: [" + fixtures + "contact_law.so, " + fixtures + "postprocessor.so, " + fixtures +
                           "protocol.so]\n" + spheres +
                           "protocol: {type: faulty}\nengine: {energy_error_limit: 1e9, energy_error_warning: 1e9}\n"
                           "sampling: {every_steps: 5}\ncheckpoints: {keep: 0}\n";
  const std::string law = "contact_law: {type: faulty, at: ", post = std::string(brittle) +
                                                                     "postprocessors: [{type: stress}, {type: faulty, "
                                                                     "parts: true, at: ";
  const std::pair<std::string, std::string> faults[] = {
      {law + "energy, rank: ", "contact_law `faulty` failed while giving energies: vector::at"},
      {law + "evaluate, rank: ", "contact_law `faulty` failed while giving forces: vector::at"},
      {law + "energy, throws: user, rank: ", "contact_law `faulty`: the dial is stuck"},
      {law + "nowhere, throws: nan, rank: ", "its force is not a finite number"},
      {post + "sample, rank: ", "postprocessor `faulty` failed while measuring: vector::at"},
      {post + "start_of_loading, throws: number, rank: ",
       "postprocessor `faulty` failed while beginning to measure: it threw something"},
      {post + "finish, rank: ", "postprocessor `faulty` failed while summing up: vector::at"},
      {post + "begin, rank: ", "postprocessor `faulty` failed while adding its curves: vector::at"}};
  for (const auto& [fault, text] : faults) {
    const auto failed = [&](const std::string& prefix, int rank) {
      write("w.yaml", head + fault + std::to_string(rank) + (fault.starts_with(law) ? "}\n" : "}]\n"));
      const Result r = call("run w.yaml --output out --overwrite --threads 1", prefix);
      std::size_t times = 0;
      for (std::size_t at = r.text.find(text); at != r.text.npos; at = r.text.find(text, at + 1)) ++times;
      EXPECT_FALSE(has(r.text, "MPI_ABORT") || has(r.text, "terminate called")) << r.text;
      std::set<std::string> files;
      if (fs::exists(folder_ / "out"))
        for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
          if (const std::string name = entry.path().filename().string();
              name[0] != '.' && name != "tables" &&
              !name.starts_with("dials."))  // of a first rank that had summed up before
            files.insert(name);
      fs::remove_all(folder_ / "out");
      return std::tuple(r.code, times, files);
    };
    const auto one = failed("", 0);
    EXPECT_EQ(std::get<0>(one), 2) << fault;
    EXPECT_GE(std::get<1>(one), 1u) << fault;
    for (const int rank : {0, 1}) EXPECT_EQ(failed(on(2), rank), one) << fault << rank;
  }
}

TEST_F(Ranks, ADamagedCheckpointIsRefusedByAllInOneMessage) {
  write_many_spheres();
  write("w.yaml", kept);
  ASSERT_EQ(call("run w.yaml --output many --threads 1", on(2)).code, 0);
  const auto written = checkpoints_of(folder_ / "many");
  ASSERT_GE(written.size(), 2u);
  const auto damage = [](const fs::path& file) {
    std::string bytes = content(file);
    bytes[bytes.size() - 100] = char(bytes[bytes.size() - 100] ^ 1);  // where the last rank looks
    std::ofstream(file, std::ios::binary) << bytes;
  };
  damage(written.back());
  fs::copy(folder_ / "many", folder_ / "again", fs::copy_options::recursive);
  const Result before = call("run --resume again --threads 1", on(2));
  EXPECT_EQ(before.code, 0) << before.text;
  EXPECT_TRUE(has(before.text, "is damaged")) << before.text;
  EXPECT_TRUE(has(before.text, "goes on from")) << before.text;
  for (const fs::path& file : written)
    if (file != written.back()) damage(file);
  const Result none = call("run --resume many --threads 1", on(3));
  EXPECT_EQ(none.code, 2) << none.text;
  const std::string said = "no usable checkpoint";
  const std::size_t at = none.text.find(said);
  ASSERT_NE(at, std::string::npos) << none.text;
  EXPECT_EQ(none.text.find(said, at + 1), std::string::npos) << none.text;
  EXPECT_FALSE(has(none.text, "MPI_ABORT")) << none.text;
}

class RanksOnASmallDisk : public FaultyPrograms {};

TEST_F(RanksOnASmallDisk, AFullOneCostsTheCheckpointOnly) {
  if (!is_on_a_small_disk(600 << 10)) GTEST_SKIP() << "no file system can be mounted here";
  write("small.csv", many_spheres());
  write("w.yaml", kept);
  const Result full = call("run w.yaml --output full --threads 1", on(2));
  EXPECT_EQ(full.code, 0) << full.text;
  const std::string said = "no checkpoint at step 60: cannot write";
  const std::size_t at = full.text.find(said);
  ASSERT_NE(at, std::string::npos) << full.text;
  EXPECT_EQ(full.text.find("no checkpoint at", at + 1), std::string::npos) << full.text;
  EXPECT_EQ(torsos(folder_ / "full"), "");
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "full"))
    EXPECT_FALSE(has(entry.path().filename().string(), ".h5")) << entry.path();
}

TEST_F(Ranks, AMistakeIsSaidOnce) {
  write_many_spheres();
  write("w.yaml", column + "sampling: {evry_steps: 7}\n");
  const Result r = call("run w.yaml --output one", on(3));
  EXPECT_EQ(r.code, 2);
  const std::size_t at = r.text.find("evry_steps");
  EXPECT_NE(at, std::string::npos) << r.text;
  EXPECT_EQ(r.text.find("evry_steps", r.text.find('\n', at)), std::string::npos) << r.text;
}

TEST_F(Ranks, MoreOfThemThanBlocksAreRefused) {
  write_small();
  const Result r = call("run small.yaml --output one", on(2));
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "128 particles make 1 block of 256")) << r.text;
}

/// What only the first rank meets ends all of them, with its message.
TEST_F(Ranks, AFolderInTheWayEndsAll) {
  write_many_spheres();
  write("w.yaml", column);
  fs::create_directory(folder_ / "one");
  write("one/mine.txt", "x");
  const Result r = call("run w.yaml --output one", on(2));
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "one")) << r.text;
}

/// A machine that fails takes its rank with it: the job ends, and goes on elsewhere from the last checkpoint.
TEST_F(Ranks, OneThatIsKilledEndsTheJobAndAnotherNumberGoesOn) {
  write_many_spheres();
  write("w.yaml",
        replaced(column, "1 m/s", "0.1 m/s") + "checkpoints: {every_steps: 150}\nsampling: {every_steps: 50}\n");
  const Result one = call("run w.yaml --output one --threads 1");
  ASSERT_EQ(one.code, 0) << one.text;
  // Each rank is behind a shell that knows its number: the second kills itself once there is a checkpoint.
  write("killed.sh",
        "#!/bin/sh\n\"$@\" &\nchild=$!\nif [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then\n"
        "  until ls many/checkpoints many/unfinished/checkpoints 2>/dev/null | grep -q 'h5$'; do sleep 0.02; done\n"
        "  kill -9 $child\nfi\nwait $child\n");
  fs::permissions(folder_ / "killed.sh", fs::perms::owner_all);
  const Result killed = call("run w.yaml --output many --threads 1", on(3) + " ./killed.sh");
  EXPECT_NE(killed.code, 0) << "it came to its end before it was killed";
  EXPECT_TRUE(has(killed.text, "exited") || has(killed.text, "abort")) << killed.text;
  for (const std::string at : {"many/checkpoints", "many/unfinished/checkpoints"})
    if (fs::exists(folder_ / at)) write(at + "/step_000000000007.h5.arriving", "what a killed process leaves");
  const Result further = call("run --resume many --threads 1", on(2));
  ASSERT_EQ(further.code, 0) << further.text;
  expect_same_results(folder_ / "one", folder_ / "many");
  EXPECT_FALSE(fs::exists(folder_ / "many/checkpoints/step_000000000007.h5.arriving"));
}

}  // namespace
}  // namespace breccia::testing
