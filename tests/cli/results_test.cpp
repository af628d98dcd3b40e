// SPDX-License-Identifier: BSD-3-Clause
// Results are never lost: what a run may replace, who may write now, what kills and signals leave.
#include <csignal>
#include <map>
#include <random>
#include <thread>

#include "small_specimen.hpp"

namespace breccia::testing {
namespace {

using Files = std::map<std::string, std::string>;

class Results : public SmallSpecimen {
 protected:
  void SetUp() override {
    Program::SetUp();
    write_spheres();
    write("bad.csv", "x,y,z,radius\n0,0,0,-1\n");
    write("small.yaml", small);
    write("path.csv", "normal_m\n-1e-6\n");
  }

  pid_t start(std::vector<std::string> arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    if (!std::freopen("/dev/null", "w", stderr) || chdir(folder_.c_str()) != 0) _exit(99);
    arguments.insert(arguments.begin(), program);
    std::vector<char*> texts;
    for (std::string& t : arguments) texts.push_back(t.data());
    texts.push_back(nullptr);
    execv(program.c_str(), texts.data());
    _exit(98);
  }
  /// One that goes on for minutes.
  pid_t start_slow(const std::string& output) const {
    return start({"run", "small.yaml", "--output", output, "--overwrite", "--threads", "1", "--set",
                  "protocol.platen_velocity=0.00005 m/s"});
  }
  static int end_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  bool appears(const std::string& file) const {
    for (int k = 0; k < 6000; ++k, std::this_thread::sleep_for(std::chrono::milliseconds(5)))
      if (fs::exists(folder_ / file)) return true;
    return false;
  }
  Files files(const std::string& of) const {
    Files all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / of))
      if (entry.is_regular_file() && !entry.is_symlink())
        all[entry.path().lexically_relative(folder_ / of).string()] = content(entry.path());
    return all;
  }
  Json summary(const std::string& run) const {
    return Json::parse(content(folder_ / run / "summary.json"), nullptr, false);
  }
  Result run(const std::string& more) const { return call("run small.yaml --threads 1 " + more); }
  void expect_whole(const std::string& of) const {
    for (const char* file : {"summary.json", "curves.csv", "resolved.yaml", "run.log", "breccia.json"})
      EXPECT_TRUE(fs::is_regular_file(folder_ / of / file)) << of << '/' << file;
    for (const auto& [name, text] : files(of)) {
      EXPECT_EQ(name.find(".partial"), name.npos) << name;
      EXPECT_EQ(name.find("unfinished"), name.npos) << name;
      EXPECT_NE(name, ".breccia.lock");
    }
    EXPECT_FALSE(fs::exists(fs::symlink_status(folder_ / of / "curves.csv.partial")));
  }

  static constexpr const char* drive =
      "drive elastic_brittle --set contact_law.bond_modulus=10GPa --set contact_law.stiffness_ratio=3.7 --set "
      "contact_law.tensile_strength=40MPa --set contact_law.shear_strength=40MPa --set contact_law.friction=0.5 ";
  static constexpr const char* small = R"(packing: {type: from_file, file: small.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
damping: {translational: 0.7, rotational: 0.7}
protocol: {type: uniaxial_compression, platen_velocity: 2 m/s, platen_stiffness: 15 MN/m, max_strain: 0.5 %}
sampling: {every_steps: 5}
)";
};

TEST_F(Results, OfTheCurrentFolderAndOfTheOneAboveAreReplaced) {
  ASSERT_EQ(run("--output results/my").code, 0);
  const std::string here = "cd results/my &&";
  const Result r = call("run resolved.yaml --output . --overwrite --set seed=7", here);
  EXPECT_EQ(r.code, 0) << r.text;
  expect_whole("results/my");
  EXPECT_EQ(summary("results/my")["seed"], 7);
  fs::create_directory(folder_ / "results/my/figures");
  const Result above = call("run ../resolved.yaml --output .. --overwrite --set seed=8", "cd results/my/figures &&");
  EXPECT_EQ(above.code, 0) << above.text;
  expect_whole("results/my");
  EXPECT_EQ(summary("results/my")["seed"], 8);
  EXPECT_TRUE(fs::is_directory(folder_ / "results/my/figures"));

  ASSERT_EQ(call(std::string(drive) + "--path path.csv -o d").code, 0);
  const std::string curves = content(folder_ / "d/curves.csv");
  EXPECT_EQ(call(std::string(drive) + "--path ../path.csv -o . --overwrite", "cd d &&").code, 0);
  EXPECT_EQ(content(folder_ / "d/curves.csv"), curves);
  EXPECT_TRUE(fs::exists(folder_ / "d/summary.json"));
}

TEST_F(Results, NothingOfTheUsersIsTouched) {
  ASSERT_EQ(run("--output res").code, 0);
  fs::create_directory(folder_ / "res.previous");
  write("res.previous/curves.csv", "kept by hand");
  write("res.failed", "a file");
  write("res/notes.txt", "dear");
  write("res/my.yaml", std::string("base: ../small.yaml\n"));
  fs::create_directory(folder_ / "res/tables");
  write("res/tables/own.csv", "1,2\n");
  const Result r = call("run res/my.yaml --output res --overwrite --set seed=3");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_EQ(summary("res")["seed"], 3);
  EXPECT_EQ(run("--output res --overwrite --set packing.file=bad.csv").code, 2);
  EXPECT_EQ(content(folder_ / "res.previous/curves.csv"), "kept by hand");
  EXPECT_EQ(content(folder_ / "res.failed"), "a file");
  EXPECT_EQ(content(folder_ / "res/notes.txt"), "dear");
  EXPECT_EQ(content(folder_ / "res/my.yaml"), "base: ../small.yaml\n");
  EXPECT_EQ(content(folder_ / "res/tables/own.csv"), "1,2\n");
}

TEST_F(Results, WhatTheManifestDoesNotNameIsNotResults) {
  fs::create_directory(folder_ / "case");
  write("case/run.log", "of another program");
  write("case/resolved.yaml", "mine");
  write("case/thesis.txt", "dear");
  const Files before = files("case");
  for (const char* manifest : {"", "{\"format\": \"other\"}", "[]", "not JSON"}) {
    if (*manifest) write("case/breccia.json", manifest);
    const Files now = files("case");
    const Result r = run("--output case --overwrite");
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_NE(r.text.find("not known to be results"), std::string::npos) << r.text;
    EXPECT_EQ(files("case"), now);
    EXPECT_EQ(call(std::string(drive) + "--path path.csv -o case --overwrite").code, 2);
    EXPECT_EQ(files("case"), now);
  }
  // Results of `drive` have no resolved.yaml: this one is the user's.
  ASSERT_EQ(call(std::string(drive) + "--path path.csv -o d").code, 0);
  write("d/resolved.yaml", "mine");
  const Files d = files("d");
  const Result r = run("--output d --overwrite");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_NE(r.text.find("resolved.yaml"), std::string::npos) << r.text;
  EXPECT_EQ(files("d"), d);
  // A manifest cannot lead out of its folder.
  write("d/breccia.json", R"({"format": "breccia results 1", "finished": true, "files": ["../small.csv", "curves.csv",
    "curves.json", "/etc/hostname", "summary.json", "run.log", "resolved.yaml"]})");
  EXPECT_EQ(run("--output d --overwrite").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "small.csv"));
}

TEST_F(Results, ASecondRunIsRefusedAtOnceWithTheOthersProcess) {
  const pid_t first = start_slow("q");
  ASSERT_TRUE(appears("q/curves.csv.partial"));
  for (const char* more : {"--output q", "--output q --overwrite", "--output ./q/. --overwrite"}) {
    const Result r = run(more);
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_NE(r.text.find("process " + std::to_string(first) + " on "), std::string::npos) << r.text;
  }
  EXPECT_EQ(call(std::string(drive) + "--path path.csv -o q --overwrite").code, 2);
  kill(first, SIGKILL);
  EXPECT_EQ(end_of(first), 128 + SIGKILL);
  EXPECT_EQ(run("--output q").code, 2) << "a torso is not replaced unasked";
  EXPECT_EQ(run("--output q --overwrite").code, 0) << "the lock of a killed process does not last";
  expect_whole("q");
}

TEST_F(Results, OfSeveralThatStartAtTheSameInstantOneRuns) {
  for (int round = 0; round < 4; ++round) {
    const std::string out = "q" + std::to_string(round);
    std::vector<pid_t> all;
    for (int k = 0; k < 3; ++k) all.push_back(start({"run", "small.yaml", "--output", out, "--threads", "1"}));
    int finished = 0;
    for (const pid_t child : all) {
      const int code = end_of(child);
      EXPECT_TRUE(code == 0 || code == 2) << code;
      finished += code == 0;
    }
    EXPECT_EQ(finished, 1);
    expect_whole(out);
  }
}

TEST_F(Results, ALinkStaysALink) {
  fs::create_directory(folder_ / "disk");
  fs::create_directory_symlink("disk", folder_ / "link");
  ASSERT_EQ(run("--output link").code, 0);
  EXPECT_EQ(run("--output link --overwrite --set seed=5").code, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  expect_whole("disk");
  EXPECT_EQ(summary("disk")["seed"], 5);
}

TEST_F(Results, AMountPointIsNoHindrance) {
  if (geteuid() != 0) GTEST_SKIP() << "mounting is the administrator's; ALinkStaysALink goes the same way";
  fs::create_directory(folder_ / "disk");
  const Result r = call("run small.yaml --threads 1 --output disk", "mount -t tmpfs none disk 2>/dev/null || exit 77;");
  if (r.code == 77) GTEST_SKIP() << "no mounting here; ALinkStaysALink goes the same way";
  EXPECT_EQ(r.code, 0) << r.text;
  const Result again = run("--output disk --overwrite --set seed=5");
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_EQ(summary("disk")["seed"], 5);
  const std::string unmount = "umount '" + (folder_ / "disk").string() + "'";
  EXPECT_EQ(std::system(unmount.c_str()), 0);
}

TEST_F(Results, TheLastWholeOnesSurviveAnyNumberOfKillsAndFailures) {
  ASSERT_EQ(run("--output out").code, 0);
  std::string curves = content(folder_ / "out/curves.csv"), whole = content(folder_ / "out/summary.json");
  std::mt19937 random(1);
  for (int k = 0; k < 12; ++k) {
    const pid_t child = start_slow("out");
    std::this_thread::sleep_for(std::chrono::milliseconds(std::uniform_int_distribution<int>(0, 600)(random)));
    kill(child, SIGKILL);
    EXPECT_EQ(end_of(child), 128 + SIGKILL);
    EXPECT_EQ(content(folder_ / "out/curves.csv"), curves);
    EXPECT_EQ(content(folder_ / "out/summary.json"), whole);
    if (k % 4 == 3) {
      EXPECT_EQ(run("--output out --overwrite --set packing.file=bad.csv").code, 2);
      EXPECT_EQ(content(folder_ / "out/summary.json"), whole);
    }
  }
  EXPECT_EQ(run("--output out --overwrite").code, 0);
  expect_whole("out");
}

TEST_F(Results, AKillWhileNewOnesTakeOverIsMadeGood) {
  for (const std::string reader : {"run", "compare"}) {
    const std::string out = "out_" + reader;
    ASSERT_EQ(run("--output " + out).code, 0);
    ASSERT_EQ(run("--output new --overwrite --set seed=9").code, 0);
    write(out + "/notes.txt", "dear");
    // As the kill leaves it: some of the files have moved, the manifest has not.
    fs::rename(folder_ / "new", folder_ / out / ".breccia.arriving");
    fs::rename(folder_ / out / ".breccia.arriving/curves.csv", folder_ / out / "curves.csv");
    if (reader == "run") EXPECT_EQ(run("--output " + out).code, 2);
    else EXPECT_EQ(call("compare " + out + " " + out + " -o both").code, 0);
    expect_whole(out);
    EXPECT_EQ(summary(out)["seed"], 9);
    EXPECT_FALSE(fs::exists(folder_ / out / ".breccia.arriving"));
    EXPECT_EQ(content(folder_ / out / "notes.txt"), "dear");
  }
}

TEST_F(Results, AskedToStopARunEndsWithWholeFiles) {
  for (const std::vector<int>& signals :
       std::vector<std::vector<int>>{{SIGTERM, SIGTERM}, {SIGHUP}, {SIGINT}, {SIGHUP, SIGTERM, SIGTERM, SIGINT}}) {
    const std::string out = "out" + std::to_string(signals.size()) + std::to_string(signals[0]);
    const pid_t child = start_slow(out);
    ASSERT_TRUE(appears(out + "/curves.csv.partial"));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    for (const int signal : signals) kill(child, signal);
    EXPECT_EQ(end_of(child), 130);
    expect_whole(out);
    EXPECT_EQ(summary(out)["interrupted"], true);
  }
  const Result r =
      call("run small.yaml --output t --set protocol.platen_velocity='0.00005 m/s' --set 'reference={particles: 128}'",
           "timeout 2");
  EXPECT_EQ(r.code, 124) << r.text;
  EXPECT_NE(r.text.find("\nparticles  "), std::string::npos) << "the table of what there is\n" << r.text;
  EXPECT_NE(r.text.find("The run was stopped before its end: its last values are not final.\n"), std::string::npos)
      << r.text;
  expect_whole("t");
}

TEST_F(Results, WhatWasStoppedDoesNotReplaceWhatHadFinished) {
  ASSERT_EQ(run("--output out").code, 0);
  const Files before = files("out");
  const pid_t child = start_slow("out");
  ASSERT_TRUE(appears("out/unfinished/curves.csv.partial"));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  kill(child, SIGINT);
  EXPECT_EQ(end_of(child), 130);
  for (const auto& [name, text] : before) EXPECT_EQ(content(folder_ / "out" / name), text) << name;
  EXPECT_EQ(summary("out/unfinished")["interrupted"], true);
  EXPECT_EQ(run("--output out --overwrite").code, 0);
  expect_whole("out");
}

TEST_F(Results, AFileAtItsSizeLimitIsToldAndAClosedPipeIsNothing) {
  const Result r = call(
      "run small.yaml --output out --set sampling.every_steps=1 --set protocol.platen_velocity=0.2m/s", "ulimit -f 8;");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_NE(r.text.find("cannot write"), std::string::npos) << r.text;
  EXPECT_NE(r.text.find("File too large"), std::string::npos) << r.text;
  EXPECT_FALSE(fs::exists(folder_ / "out/summary.json"));
  write("pipe.sh", "'" + program +
                       "' run small.yaml --output piped --threads 1 --set 'reference={steps: 1}' 2>&1 | "
                       "head -1\nexit ${PIPESTATUS[0]}\n");
  EXPECT_EQ(std::system(("cd '" + folder_.string() + "' && bash pipe.sh >/dev/null").c_str()), 0);
  expect_whole("piped");
}

TEST_F(Results, NamesStayInResults) {
  for (const std::string name : {"../evil", "/tmp/evil", "..", ".", ".hidden", "a/b", "a\\b", "' '", "\"a\\tb\""}) {
    write("named.yaml", "name: " + name + "\n" + small);
    for (const char* verb : {"validate named.yaml", "run named.yaml"}) {
      const Result r = call(verb);
      EXPECT_EQ(r.code, 2) << name << r.text;
      EXPECT_NE(r.text.find("named.yaml:1:7: name: "), std::string::npos) << r.text;
    }
    write("study.yaml", "name: " + name + "\nworkflow: small.yaml\ngrid: {seed: [1, 2]}\n");
    const Result r = call("sweep study.yaml");
    EXPECT_EQ(r.code, 2) << name << r.text;
    EXPECT_NE(r.text.find("study.yaml:1:7: name: "), std::string::npos) << r.text;
  }
  const Result r = call("run small.yaml --set seed=2 --set name=../evil");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_NE(r.text.find("--set:2:6: name: "), std::string::npos) << r.text;
  write("variant.yaml", std::string(small) + "variants: {../evil: {seed: 2}}\n");
  EXPECT_EQ(call("run variant.yaml --variant ../evil").code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "results"));
  EXPECT_FALSE(fs::exists(folder_ / "evil"));
}

}  // namespace
}  // namespace breccia::testing
