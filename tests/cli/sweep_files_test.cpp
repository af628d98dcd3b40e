// SPDX-License-Identifier: BSD-3-Clause
// Studies lose nothing: their folder and those of their cases are kept by the same rules as that of a run.
#include <csignal>

#include "sweep_support.hpp"

namespace breccia::testing {
namespace {

class SweepFiles : public SweepProgram {
 protected:
  void study(const std::string& more = "") const { write("study.yaml", "workflow: small.yaml\n" + more); }
  static int end_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

TEST_F(SweepFiles, NotesOfTheUsersAreKept) {
  study("grid: {seed: [1, 2]}\n");
  ASSERT_EQ(call("sweep study.yaml").code, 0);
  for (const char* note : {"results/study/notes.txt", "results/study/cases/seed=1/notes.txt",
                           "results/study/cases/seed=1/mine/output.log"}) {
    fs::create_directories((folder_ / note).parent_path());
    write(note, "dear");
  }
  study("grid: {seed: [1, 2]}\nfixed: {contact_law.stiffness_ratio: 2}\n");
  const Result r = call("sweep study.yaml --overwrite");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_EQ(content(folder_ / "results/study/notes.txt"), "dear");
  EXPECT_EQ(content(case_of("study", "seed=1") / "notes.txt"), "dear");
  EXPECT_EQ(content(case_of("study", "seed=1") / "mine/output.log"), "dear");
  EXPECT_EQ(results("study")[0].at("status"), "finished");
}

TEST_F(SweepFiles, AFolderThatOnlyLooksLikeACaseIsNotTouched) {
  study("grid: {seed: [1]}\n");
  for (const char* name : {"run.log", "case.json", "output.log", "resolved.yaml"}) {
    fs::remove_all(folder_ / "results");
    fs::create_directories(case_of("study", "seed=1"));
    write(std::string("results/study/cases/seed=1/") + name, "dear");
    write("results/study/cases/seed=1/thesis.txt", "dear");
    const Result r = call("sweep study.yaml");
    EXPECT_EQ(r.code, 1) << r.text;
    EXPECT_NE(r.text.find("not known to be results of Breccia"), std::string::npos) << r.text;
    EXPECT_EQ(results("study")[0].at("status"), "failed");
    EXPECT_EQ(content(case_of("study", "seed=1") / name), "dear") << name;
    EXPECT_EQ(content(case_of("study", "seed=1") / "thesis.txt"), "dear");
    EXPECT_EQ(std::distance(fs::directory_iterator(case_of("study", "seed=1")), {}), 2) << name;
  }
  fs::remove_all(folder_ / "results");
  fs::create_directories(folder_ / "results/study/cases");
  write("results/study/results.csv", "dear");
  EXPECT_EQ(call("sweep study.yaml").code, 2);
  EXPECT_EQ(content(folder_ / "results/study/results.csv"), "dear");
}

TEST_F(SweepFiles, FinishedResultsSurviveUntilNewOnesHaveFinished) {
  study("grid: {seed: [1]}\n");
  ASSERT_EQ(call("sweep study.yaml").code, 0);
  const fs::path folder = case_of("study", "seed=1");
  const std::string before = content(folder / "curves.csv"), table = content(folder_ / "results/study/results.csv");
  ASSERT_FALSE(before.empty());
  const std::string slow = "grid: {seed: [1]}\nfixed: {engine.time_step_safety: 0.00001}\n";
  // Stopped, killed, crashed: the whole ones stay.
  for (const int signal : {SIGINT, SIGKILL}) {
    study(slow);
    const pid_t child = start({"sweep", "study.yaml", "--overwrite"});
    ASSERT_TRUE(within_a_minute([&] { return fs::exists(folder / "unfinished/curves.csv.partial"); }));
    kill(child, signal);
    end_of(child);
    ASSERT_TRUE(within_a_minute([&] { return case_processes().empty(); }));
    EXPECT_EQ(content(folder / "curves.csv"), before);
    EXPECT_EQ(content(folder_ / "results/study/results.csv"), table);
    const Result r = call("sweep study.yaml");
    EXPECT_EQ(r.code, 2) << "finished results are replaced only with --overwrite\n" << r.text;
  }
  // A case that fails.
  study("grid: {seed: [1]}\nfixed: {packing.file: bad.csv}\n");
  EXPECT_EQ(call("sweep study.yaml --overwrite").code, 1);
  EXPECT_EQ(results("study")[0].at("status"), "failed");
  EXPECT_NE(results("study")[0].at("error").find("bad.csv"), std::string::npos);
  EXPECT_EQ(content(folder / "curves.csv"), before);
  // The first inputs again: there is nothing to run.
  study("grid: {seed: [1]}\n");
  const Result back = call("sweep study.yaml");
  EXPECT_EQ(back.code, 0) << back.text;
  EXPECT_NE(back.text.find("1 cases, 0 to run"), std::string::npos) << back.text;
  study("grid: {seed: [1]}\nfixed: {contact_law.stiffness_ratio: 2}\n");
  EXPECT_EQ(call("sweep study.yaml --overwrite").code, 0);
  EXPECT_NE(content(folder / "curves.csv"), before);
  EXPECT_FALSE(fs::exists(folder / "unfinished"));
}

TEST_F(SweepFiles, ASecondOneIsRefusedAtOnceWithTheOthersProcess) {
  study("grid: {engine.time_step_safety: [0.00001]}\n");
  const pid_t first = start({"sweep", "study.yaml"});
  const fs::path folder = case_of("study", "time_step_safety=0.00001");
  ASSERT_TRUE(within_a_minute([&] { return fs::exists(folder / "curves.csv.partial"); }));
  for (const char* more : {"", " --overwrite", " --collect"}) {
    const Result r = call(std::string("sweep study.yaml") + more);
    EXPECT_EQ(r.code, 2) << more;
    EXPECT_NE(r.text.find("in use by another run (process " + std::to_string(first) + " on "), std::string::npos)
        << r.text;
  }
  const Result one = call("sweep study.yaml --case 1");
  EXPECT_EQ(one.code, 2);
  EXPECT_NE(one.text.find("in use by another run (process "), std::string::npos) << one.text;
  kill(first, SIGINT);
  EXPECT_EQ(end_of(first), 130);
}

TEST_F(SweepFiles, LinksStayLinks) {
  study("grid: {seed: [1]}\n");
  fs::create_directories(folder_ / "disk/study");
  fs::create_directories(folder_ / "disk/case");
  fs::create_directories(folder_ / "results");
  fs::create_directories(folder_ / "disk/study/cases");
  fs::create_directory_symlink(folder_ / "disk/study", folder_ / "results/study");
  fs::create_directory_symlink(folder_ / "disk/case", folder_ / "disk/study/cases/seed=1");
  const Result r = call("sweep study.yaml");
  EXPECT_EQ(r.code, 0) << r.text;
  study("grid: {seed: [1]}\nfixed: {contact_law.stiffness_ratio: 2}\n");
  EXPECT_EQ(call("sweep study.yaml --overwrite").code, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "results/study"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "disk/study/cases/seed=1"));
  EXPECT_TRUE(fs::exists(folder_ / "disk/study/results.csv"));
  EXPECT_TRUE(fs::exists(folder_ / "disk/case/summary.json"));
}

TEST_F(SweepFiles, AStudyAndARunDoNotReplaceEachOther) {
  study("grid: {seed: [1]}\n");
  ASSERT_EQ(call("sweep study.yaml --output one").code, 0);
  const std::string table = content(folder_ / "one/results.csv");
  const Result r = call("run small.yaml --output one --overwrite");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("holds the results of a study"), std::string::npos) << r.text;
  EXPECT_EQ(content(folder_ / "one/results.csv"), table);
  ASSERT_EQ(call("run small.yaml --output two").code, 0);
  EXPECT_EQ(call("sweep study.yaml --output two --overwrite").code, 2);
  EXPECT_EQ(call("compare one two --output two/one --renderer '' --overwrite").code, 0);
  EXPECT_EQ(call("compare two --output one --overwrite").code, 2);
  EXPECT_EQ(content(folder_ / "one/results.csv"), table);
}

}  // namespace
}  // namespace breccia::testing
