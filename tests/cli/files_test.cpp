// SPDX-License-Identifier: BSD-3-Clause
// Disks that are full, texts from other systems, cache entries that are no files, names that are no text.
#include <sys/stat.h>

#include <cmath>

#include "program.hpp"

namespace breccia::testing {
namespace {

class FilesCli : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("disc.csv", discs());
    write("w.yaml", brazilian);
  }

  /// A hexagonal lattice of touching discs of radius 1 in a disc of diameter 20.
  static std::string discs() {
    std::ostringstream csv;
    csv << "x,y,radius\n";
    for (int j = -6; j <= 6; ++j)
      for (int i = -6; i <= 6; ++i) {
        const double x = 2 * i + (j % 2 != 0), y = std::sqrt(3.0) * j;
        if (std::hypot(x, y) < 9.01) csv << x << ',' << y << ",1\n";
      }
    return csv.str();
  }
  Result run(const std::string& arguments, const std::string& before = "") const {
    return call("run w.yaml --threads 1 " + arguments, before);
  }
  Json summary(const std::string& folder) const { return Json::parse(content(folder_ / folder / "summary.json")); }
  static void expect(const Result& r, int code, const std::string& part) {
    EXPECT_EQ(r.code, code) << r.text;
    EXPECT_NE(r.text.find(part), std::string::npos) << r.text;
  }

  static constexpr const char* brazilian = R"(dimension: 2
thickness: 10 mm
packing: {type: from_file, file: disc.csv, length_unit: mm, outline: disc}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.01}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 20 MPa, shear_strength: 20 MPa, friction: 0.5}
damping: {translational: 0.7, rotational: 0.7}
protocol: {type: brazilian, platen_velocity: 0.1 m/s, max_displacement: 0.1 %}
)";
  static constexpr const char* law =
      "elastic_brittle --set contact_law.bond_modulus=10GPa --set contact_law.stiffness_ratio=3.7 "
      "--set contact_law.tensile_strength=40MPa --set contact_law.shear_strength=40MPa --set contact_law.friction=0.5 ";
  static constexpr const char* frames = "--set 'outputs=[{type: vtk, interval: 1 s}]' ";
  /// A limit of the size stands for the full disk: writes fail half-way in the same manner.
  static constexpr const char* full = "ulimit -f 8; trap '' XFSZ;";
};

TEST_F(FilesCli, ADiscFromAFileIsSplit) {
  expect(run(std::string(frames) + "--output r"), 0, "finished");
  EXPECT_TRUE(summary("r").contains("brazilian_tensile_strength_Pa")) << summary("r").dump(2);
  // A frame says itself what its specimen is.
  const std::string frame = "--set 'packing={type: from_file, file: r/particles_000000.vtp";
  expect(run(frame + "}' --output a"), 0, "finished");
  expect(run(frame + ", outline: box}' --output b"), 0, "is a frame of a disc: `outline: box` is not used");
  // So it is told again when the packing comes from the cache.
  expect(run(frame + ", outline: box}' --overwrite --output b"), 0, "is a frame of a disc");
  EXPECT_NE(summary("b")["warnings"].dump().find("is a frame of a disc"), std::string::npos);
  EXPECT_EQ(summary("a")["particles"], summary("r")["particles"]);
  EXPECT_EQ(summary("a")["porosity"], summary("b")["porosity"]);
  expect(run("--set packing.outline=box --output c"), 2, "with from_file `outline: disc`");
  expect(run("--set packing.outline=cylinder --output c"), 2, "`outline: disc`");
}

TEST_F(FilesCli, AFullDiskEndsARunWithTheFileAndTheReason) {
  expect(run(std::string(frames) + "--output out", full), 2, "out/unfinished/particles_000000.vtp: File too large");
  EXPECT_FALSE(fs::exists(folder_ / "out/particles_000000.vtp"));
  EXPECT_FALSE(fs::exists(folder_ / "out/unfinished/particles_000000.vtp"));
}

TEST_F(FilesCli, PicturesReplaceNothingUnaskedAndTellOfAFullDisk) {
  expect(run(std::string(frames) + "--output r"), 0, "finished");
  const Result first = call("render r");
  expect(first, 0, "picture r/");
  const std::string before = content(folder_ / "r/specimen.png");
  ASSERT_FALSE(before.empty());
  write("r/specimen.png", "of the user");
  expect(call("render r"), 2, "already holds");
  EXPECT_EQ(content(folder_ / "r/specimen.png"), "of the user");
  expect(call("render r --overwrite"), 0, "picture r/specimen.png");
  EXPECT_EQ(content(folder_ / "r/specimen.png"), before);
  expect(call("render r --output new", full), 2, "cannot write new/");
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  for (const auto& entry : fs::directory_iterator(folder_ / "r")) EXPECT_NE(entry.path().filename().string()[0], '.');
}

TEST_F(FilesCli, AnOutputIntervalThatDoesNotMoveTheTimeMeansAFrameEachSample) {
  for (const char* interval : {"1e-18 s", "1 fs"}) {
    const Result r =
        run("--overwrite --output out --set sampling.every_steps=20 --set 'outputs=[{type: vtk, interval: " +
                std::string(interval) + "}]'",
            "timeout 60");
    expect(r, 0, "finished");
    std::size_t made = 0, rows = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out"))
      made += entry.path().filename().string().starts_with("particles_") && entry.path().extension() == ".vtp";
    for (const char c : content(folder_ / "out/curves.csv")) rows += c == '\n';
    EXPECT_GT(made, 3u);
    EXPECT_NEAR(double(made), double(rows - 1), 1) << interval;  // the last state once more
  }
}

TEST_F(FilesCli, ACacheEntryThatIsNoFileIsAWarning) {
  expect(run("--output a"), 0, "finished");
  fs::path entry;
  for (const auto& e : fs::directory_iterator(folder_ / "cache/packings")) entry = e.path();
  ASSERT_EQ(entry.extension(), ".cbor");
  const auto again = [&](const char* what) {
    const Result r = run("--overwrite --output a", "timeout 20");
    expect(r, 0, "finished");
    EXPECT_NE(r.text.find("cannot be read"), std::string::npos) << what << ": " << r.text;
    fs::remove_all(entry);
  };
  fs::remove(entry);
  fs::create_directory(entry);
  again("a folder");
  ASSERT_EQ(mkfifo(entry.c_str(), 0644), 0);
  again("a pipe");
  fs::create_symlink(entry.filename(), entry);
  again("a link to itself");
  fs::create_symlink("/no/where", entry);
  expect(run("--overwrite --output a", "timeout 20"), 0, "finished");
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(entry)));
  for (const auto& e : fs::directory_iterator(folder_ / "cache/packings")) EXPECT_EQ(e.path(), entry);
}

TEST_F(FilesCli, ACacheThatCannotBeWrittenIsAWarning) {
  write("file", "");
  expect(run("--output a", "BRECCIA_CACHE=file/x"), 0,
         "warning: the packing was not kept for the next run: cannot make");
}

TEST_F(FilesCli, EveryReaderTakesTextsOfOtherSystems) {
  const auto cr = [](std::string text) {
    for (char& c : text) c = c == '\n' ? '\r' : c;
    return "\xEF\xBB\xBF" + text;
  };
  const auto wide = [](const std::string& text) {
    std::string out = "\xFF\xFE";
    for (const char c : text) out.append(1, c).append(1, '\0');
    return out;
  };
  const std::string path = "normal_m\n1e-7\n";
  write("p.CSV", cr(path));
  expect(call("drive " + std::string(law) + "--path p.CSV -o d"), 0, "made");
  write("p16.csv", wide(path));
  expect(call("drive " + std::string(law) + "--path p16.csv -o d2"), 2,
         "p16.csv:1:1: the file is UTF-16; save it as UTF-8");
  write("W.YAML", cr(brazilian));
  write("DISC.CSV", cr(discs()));
  expect(call("run W.YAML --threads 1 --set packing.file=DISC.CSV --output w"), 0, "finished");
  write("w16.yaml", wide(brazilian));
  expect(call("validate w16.yaml"), 2, "w16.yaml:1:1: the file is UTF-16; save it as UTF-8");
  write("s16.yaml", wide("workflow: w.yaml\n"));
  expect(call("sweep s16.yaml --cases"), 2, "s16.yaml:1:1: the file is UTF-16; save it as UTF-8");
}

TEST_F(FilesCli, NamesThatAreNoTextAreShownAndWritten) {
  write("n\xFF.yaml", brazilian);
  const Result r = call("run 'n\xFF.yaml' --threads 1 --output 'o\xFF'");
  expect(r, 0, "results in o\\xFF");
  EXPECT_EQ(r.text.find('\x1B'), std::string::npos);
  EXPECT_EQ(summary("o\xFF")["workflow"], "n\xEF\xBF\xBD");
  expect(call("validate 'o\xFF/resolved.yaml'"), 0, "ok");
  expect(call("validate 'no\xFF\x1B.yaml'"), 2, "cannot read no\\xFF\\x1B.yaml: no such file");
}

TEST_F(FilesCli, ASeedIsKeptExactlyOrRefused) {
  expect(run("--output a --set seed=9223372036854775807"), 0, "finished");
  EXPECT_EQ(summary("a")["seed"], std::int64_t(9223372036854775807));
  EXPECT_NE(content(folder_ / "a/resolved.yaml").find("seed: 9223372036854775807"), std::string::npos);
  expect(run("--output b --set seed=18446744073709551615"), 2, "is too large for a whole number");
}

}  // namespace
}  // namespace breccia::testing
