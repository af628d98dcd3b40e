// SPDX-License-Identifier: BSD-3-Clause
// `mpirun -n N breccia run`: the files of one rank, byte for byte, for every plugin that is shipped, and on with
// another number of ranks from a checkpoint.
#include <gtest/gtest.h>

#include "ranks/launched.hpp"
#include "ranks/same_lists.hpp"

namespace breccia::testing {
namespace {

class RanksOfEach : public Ranks, public ::testing::WithParamInterface<Case> {};

TEST_P(RanksOfEach, WriteTheFilesOfOne) {
  write_many_spheres();
  write("w.yaml", larger(GetParam().text));
  const Result one = call("run w.yaml --output one --threads 1");
  ASSERT_EQ(one.code, 0) << one.text;
  const auto checkpoints = checkpoints_of(folder_ / "one");
  ASSERT_GE(checkpoints.size(), 2u) << one.text;
  const Result many = call("run w.yaml --output many --threads 1", on(3));
  ASSERT_EQ(many.code, 0) << many.text;
  expect_same_results(folder_ / "one", folder_ / "many");
  // What three have written two go on with, and change ranks whenever they can.
  fs::copy(folder_ / "many", folder_ / "on", fs::copy_options::recursive);
  for (std::size_t k = 1; k < checkpoints.size(); ++k)
    fs::remove(folder_ / "on/checkpoints" / checkpoints[k].filename());
  const Result further = call("run --resume on --threads 2", "BRECCIA_IMBALANCE=-1 " + on(2));
  ASSERT_EQ(further.code, 0) << further.text;
  EXPECT_TRUE(has(further.text, "goes on from")) << further.text;
  expect_same_results(folder_ / "one", folder_ / "on");
}

INSTANTIATE_TEST_SUITE_P(Shipped, RanksOfEach, ::testing::ValuesIn(cases()),
                         [](const auto& its) { return its.param.name; });

struct ManyCase {
  Case its;
  std::pair<int, int> ranks;  ///< that begin, that go on
  bool migrates;              ///< work shifts: at the ends, which are crushed, pairs are lost
};
/// More ranks than two cores have: some that share nothing, and such as own a single block.
class ManyRanks : public Ranks, public ::testing::WithParamInterface<ManyCase> {
 protected:
  /// 12 x 12 x 32 tangent spheres in sheared layers, 18 blocks; a hexagonal cell of 10 x 10 discs, whose 5 x 5 copies
  /// make 10 blocks.
  void write_particles() const {
    std::ostringstream spheres_csv, discs_csv;
    spheres_csv << "x,y,z,radius\n";
    for (int k = 0; k < 32; ++k)
      for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 12; ++i)
          spheres_csv << 2 * i + 1 + 0.2 * ((i * 7 + j * 3 + k) % 5) << ',' << 2 * j + 1 << ',' << 2 * k + 1 << ",1\n";
    write("small.csv", spheres_csv.str());
    discs_csv << "x,y,radius\n";
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 10; ++i) discs_csv << 2 * i + j % 2 << ',' << 1.7320508 * j << ",1\n";
    write("cell.csv", discs_csv.str());
  }
};

TEST_P(ManyRanks, GiveTheBitsOfOneAndGoOnInAnyNumber) {
  write_particles();
  write("w.yaml", GetParam().its.text);
  const Result one = call("run w.yaml --output one --threads 1");
  ASSERT_EQ(one.code, 0) << one.text;
  const Json s = summary("one");
  EXPECT_GT(s["bonds_broken_tension"].get<int>() + s["bonds_broken_shear"].get<int>(), 100)
      << "the test must break something";
  EXPECT_GT(s["neighbour_list_rebuilds"].get<int>(), 3) << "the test must make its list anew";
  const auto [first, second] = GetParam().ranks;
  // Work is dealt anew whenever the list is made anew.
  const Result many = call("run w.yaml --output many --threads 1", "BRECCIA_IMBALANCE=-1 " + on(first));
  ASSERT_EQ(many.code, 0) << many.text;
  EXPECT_EQ(has(many.text, "particles changed ranks"), GetParam().migrates) << many.text;
  expect_same_results(folder_ / "one", folder_ / "many");
  // What they have written another number goes on with.
  const auto written = checkpoints_of(folder_ / "many");
  ASSERT_GE(written.size(), 2u);
  for (std::size_t k = 1; k < written.size(); ++k) fs::remove(written[k]);
  const Result further = call("run --resume many --threads 1", on(second));
  ASSERT_EQ(further.code, 0) << further.text;
  expect_same_results(folder_ / "one", folder_ / "many");
}

INSTANTIATE_TEST_SUITE_P(
    FiveAndEight, ManyRanks,
    ::testing::Values(
        ManyCase{{"crushed",
                  std::string(spheres) + brittle +
                      "protocol: {type: uniaxial_compression, platen_velocity: 40 m/s, platen_stiffness: 15 MN/m, "
                      "max_strain: 4 %}\nengine: {skin: 0.05}\n"
                      "postprocessors: [{type: stress}, {type: damage}, {type: energy}]\n"
                      "checkpoints: {every_steps: 50, keep: 100, at_end: true}\nsampling: {every_steps: 25}\n"},
                 {8, 5},
                 true},
        ManyCase{{"periodic_in_the_plane",
                  "dimension: 2\nthickness: 10 mm\nperiodic: [x, y]\npacking: {type: replicated_cell, file: cell.csv, "
                  "length_unit: mm, period: [20 mm, 17.320508 mm], copies: {x: 5, y: 5}}\n"
                  "material: {density: 2650 kg/m3}\nbonding: {tolerance: 0.01}\n"
                  "damping: {translational: 0.5, rotational: 0.5}\n" +
                      std::string(brittle) +
                      "protocol: {type: periodic_cell, axis: y, strain_rate: 1200 1/s, lateral_pressure: 0 MPa, "
                      "max_strain: 3 %}\nengine: {skin: 0.02}\n"
                      "postprocessors: [{type: stress}, {type: damage}, {type: energy}]\n"
                      "checkpoints: {every_steps: 100, keep: 100, at_end: true}\nsampling: {every_steps: 50}\n"},
                 {5, 8},
                 false}),
    [](const auto& its) { return its.param.its.name; });

/// Post-processors and a protocol that see parts: for them, and for the checks, nothing is brought together; and the
/// numbers are those of one rank.
TEST_F(Ranks, NothingIsBroughtTogetherForWhoSeesParts) {
  write_many_spheres();
  write("w.yaml",
        column +
            "postprocessors: [{type: stress}, {type: fabric, of: touching}, {type: energy}, {type: damage}, "
            "{type: gauges}, "
            "{type: contact_stress}, {type: elastic_constants, strain: platen_strain, lateral: "
            "gauge_lateral_strain}, {type: bond_statistics}, {type: statistics}]\nsampling: {every_steps: 20}\n"
            "checkpoints: {every_steps: 60, keep: 100}\n");
  const Result one = call("run w.yaml --output one --threads 1");
  ASSERT_EQ(one.code, 0) << one.text;
  for (const int ranks : {2, 3}) {
    const std::string folder = "on_" + std::to_string(ranks);
    const Result many = call("run w.yaml --threads 1 --output " + folder, on(ranks));
    ASSERT_EQ(many.code, 0) << many.text;
    EXPECT_TRUE(has(many.text, "never brought together")) << many.text;
    EXPECT_GE(checkpoints_of(folder_ / folder).size(), 2u) << "the test must write checkpoints";
    expect_same_results(folder_ / "one", folder_ / folder);
  }
  // One that does not is shown the whole, beside the others.
  write("v.yaml", replaced(content(folder_ / "w.yaml"), "{type: energy}", "{type: energy}, {type: bagi_strain}"));
  ASSERT_EQ(call("run v.yaml --output with_bagi_strain --threads 1").code, 0);
  const Result many = call("run v.yaml --threads 1 --output on_3_with_bagi_strain", on(3));
  ASSERT_EQ(many.code, 0) << many.text;
  EXPECT_FALSE(has(many.text, "never brought together")) << many.text;
  expect_same_results(folder_ / "with_bagi_strain", folder_ / "on_3_with_bagi_strain");
}

/// Nor for tests that hold and load particles.
TEST_F(Ranks, TestsOfHeldParticlesSeeParts) {
  write_many_spheres();
  const std::pair<const char*, const char*> tests[] = {
      {"tension",
       "protocol: {type: direct_tension, plate_velocity: 0.3 m/s, ramp_time: 5 us, grip: 3 mm, breakable_layer: 0.5, "
       "max_strain: 0.05 %}\n"},
      {"load",
       "protocol: {type: end_load, supports: [{at: lower, holds: [all]}], loads: [{at: upper, force: [0 N, 10 N, 0 N], "
       "share: mass}, {height: 14 mm, moment: [0 N m, 0 N m, 0.01 N m]}], ramp_time: 20 us, duration: 40 us}\n"}};
  for (const auto& [name, protocol] : tests) {
    write("w.yaml", std::string(spheres) + brittle + protocol +
                        "postprocessors: [{type: stress}, {type: energy}]\nsampling: {every_steps: 20}\n"
                        "checkpoints: {keep: 0}\n");
    const std::string one = std::string("one_") + name, many = std::string("many_") + name;
    const Result alone = call("run w.yaml --threads 1 --output " + one);
    ASSERT_EQ(alone.code, 0) << alone.text;
    const Result beside = call("run w.yaml --threads 1 --output " + many, "BRECCIA_IMBALANCE=-1 " + on(3));
    ASSERT_EQ(beside.code, 0) << beside.text;
    EXPECT_TRUE(has(beside.text, "never brought together")) << beside.text;
    expect_same_results(folder_ / one, folder_ / many);
  }
}

/// What is said of a specimen, whoever has the particles that it is said of: a small body apart from the large one, and
/// a single stray.
TEST_F(Ranks, DoubtsAreThoseOfOne) {
  write_many_spheres();
  std::string csv = content(folder_ / "small.csv");
  for (int k = 0; k < 40; ++k)
    csv += std::to_string(40 + 2 * (k % 8)) + ",1," + std::to_string(2 * (k / 8) + 9) + ",1\n";
  write("small.csv", csv + "5,90,9,1\n");
  write("w.yaml", column +
                      "postprocessors: [{type: damage}]\nsampling: {every_steps: 20}\n"
                      "checks: {flown_off: 1, unbonded_share: 1 %}\n");
  const Result one = call("run w.yaml --output one --threads 1");
  ASSERT_EQ(one.code, 0) << one.text;
  EXPECT_TRUE(has(one.text, "particles without a bond to the rest make the specimen")) << one.text;
  EXPECT_TRUE(has(one.text, "41 of 937 particles have no bond to the rest")) << one.text;
  EXPECT_TRUE(has(one.text, "particles have flown off: particle 936 of the packing")) << one.text;
  for (const int ranks : {2, 3}) {
    const std::string folder = "on_" + std::to_string(ranks);
    const Result many = call("run w.yaml --threads 1 --output " + folder, on(ranks));
    ASSERT_EQ(many.code, 0) << many.text;
    expect_same_results(folder_ / "one", folder_ / folder);
  }
}

/// Packings that ranks make in shares, or that one makes for all, and materials that are given out by the whole.
TEST_F(Ranks, PackingsAreTheSameHoweverManyMakeThem) {
  const std::string head = "material_of: {", test = std::string(brittle) +
                                                    "protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, "
                                                    "platen_stiffness: 15 MN/m, max_strain: 0.05 %}\n"
                                                    "postprocessors: [{type: stress}]\n"
                                                    "bonding: {tolerance: 0.01}\ncheckpoints: {every_steps: 20}\n"
                                                    "materials: {quartz: {density: 2650 kg/m3}, mica: {density: 2800 "
                                                    "kg/m3}}\n";
  const std::string lattice =
      "packing: {type: regular, lattice: fcc, container: {shape: cylinder, diameter: 20 mm, height: 40 mm}, radius: 1 "
      "mm}\n";
  const std::string discs =
      "packing: {type: collective_rearrangement, container: {shape: cylinder, diameter: 20 mm, height: 30 mm}, "
      "radius: {distribution: uniform, min: 0.8 mm, max: 1.2 mm}, porosity: 0.42}\n";
  const std::pair<std::string, std::string> cases[] = {
      {lattice, "layers: {thicknesses: [3 mm, 2 mm], materials: [quartz, mica], dip: 20 deg, dip_direction: 0 deg}}\n"},
      {lattice, "shares: {quartz: 70 %, mica: 30 %}}\n"},
      {discs, "grains: {size: 6 mm, shares: {quartz: 0.5, mica: 0.5}}}\n"}};
  int number = 0;
  for (const auto& [packing, way] : cases) {
    const std::string name = "case_" + std::to_string(++number);
    write("w.yaml", packing + head + way + test);
    const Result one = call("run w.yaml --threads 1 --output " + name + "_one");
    ASSERT_EQ(one.code, 0) << one.text;
    for (const int ranks : {2, 3}) {
      const Result many = call("run w.yaml --threads 1 --output " + name + "_" + std::to_string(ranks), on(ranks));
      ASSERT_EQ(many.code, 0) << many.text;
      expect_same_results(folder_ / (name + "_one"), folder_ / (name + "_" + std::to_string(ranks)));
    }
  }
}

TEST_F(Ranks, CheckpointsHoldWhatThatOfOneDoesAndAnyNumberGoesOn) {
  write_many_spheres();
  write("w.yaml", replaced(kept, "1 m/s", "4 m/s"));  // some bonds break
  const Result one = call("run w.yaml --output one --threads 1");
  ASSERT_EQ(one.code, 0) << one.text;
  const auto of_one = checkpoints_of(folder_ / "one");
  ASSERT_GE(of_one.size(), 2u) << one.text;
  ASSERT_FALSE(lists_of(of_one.back()).at("engine/bonds/cracks/time").second.empty())
      << "the test must break something";
  for (const int ranks : {2, 3}) {
    const std::string folder = "on_" + std::to_string(ranks);
    const Result many = call("run w.yaml --threads 1 --output " + folder, "BRECCIA_IMBALANCE=-1 " + on(ranks));
    ASSERT_EQ(many.code, 0) << many.text;
    const auto written = checkpoints_of(folder_ / folder);
    ASSERT_EQ(written.size(), of_one.size());
    for (std::size_t k = 0; k < written.size(); ++k)
      EXPECT_EQ(different_lists(of_one[k], written[k], "protocol/running"), "") << written[k];
    for (std::size_t k = 1; k < written.size(); ++k) fs::remove(written[k]);
    for (const int further : {1, 2, 3}) {
      const std::string again = folder + "_" + std::to_string(further);
      fs::copy(folder_ / folder, folder_ / again, fs::copy_options::recursive);
      const Result r = call("run --threads 1 --resume " + again, further > 1 ? on(further) : "");
      ASSERT_EQ(r.code, 0) << r.text;
      EXPECT_TRUE(has(r.text, "goes on from")) << r.text;
      expect_same_results(folder_ / "one", folder_ / again);
    }
  }
}

/// Of frames in pieces the readers make what one file holds.
TEST_F(Ranks, PiecesAreTheOneFile) {
  write_many_spheres();
  const std::string text =
      column +
      "postprocessors: [{type: stress}, {type: damage}, {type: bagi_strain}]\nsampling: {every_steps: 20}\n"
      "checkpoints: {every_steps: 60, keep: 100, at_end: true}\n";
  write("w.yaml", text + "outputs: [{type: vtk, interval: 15 us, precision: double}]\n");
  write("v.yaml", text + "outputs: [{type: vtk, interval: 15 us, precision: double, pieces: ranks}]\n");
  ASSERT_EQ(call("run w.yaml --output one --threads 1").code, 0);
  ASSERT_EQ(call("run v.yaml --output one_piece --threads 1").code, 0);
  const Result many = call("run v.yaml --output many --threads 1", on(3));
  ASSERT_EQ(many.code, 0) << many.text;
  const auto frames = [&](const std::string& folder, const std::string& ending) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / folder))
      if (const std::string name = entry.path().filename().string();
          name.starts_with("particles_") && name.ends_with(ending))
        names.insert(entry.path().stem().string());
    return names;
  };
  const auto whole = frames("one", ".vtp");
  ASSERT_GE(whole.size(), 3u);
  EXPECT_EQ(frames("many", ".pvtp"), whole);
  EXPECT_EQ(frames("many", "_2.vtp").size(), whole.size());
  EXPECT_EQ(frames("one_piece", "_0.vtp").size(), whole.size());
  const std::string last = *whole.rbegin();
  const auto expect_whole = [&](const std::string& folder) {
    for (const auto& [from, ending] : {std::pair{std::string("one"), ".vtp"}, {folder, ".pvtp"}}) {
      const Result again = call("run w.yaml --overwrite --threads 1 --output again_" + from +
                                " --set 'packing={type: from_file, file: " + from + "/" + last + ending +
                                "}' --set 'protocol.max_strain=0.05 %' --set 'outputs=[]'");
      ASSERT_EQ(again.code, 0) << again.text;
    }
    EXPECT_EQ(content(folder_ / "again_one/curves.csv"), content(folder_ / ("again_" + folder) / "curves.csv"));
    if (pictures.empty()) return;
    for (const std::string& from : {std::string("one"), folder}) {
      const Result drawn = call("render " + from + " --overwrite");
      ASSERT_EQ(drawn.code, 0) << drawn.text;
    }
    std::size_t compared = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "one"))
      if (entry.path().extension() == ".png") {
        ++compared;
        EXPECT_EQ(content(entry.path()), content(folder_ / folder / entry.path().filename())) << entry.path();
      }
    EXPECT_GT(compared, 0u);
  };
  expect_whole("one_piece");
  expect_whole("many");
  // Two go on from the first checkpoint: their frames have two pieces, none of three is left.
  const auto written = checkpoints_of(folder_ / "many");
  ASSERT_GE(written.size(), 2u);
  for (std::size_t k = 1; k < written.size(); ++k) fs::remove(written[k]);
  const Result further = call("run --resume many --threads 1", on(2));
  ASSERT_EQ(further.code, 0) << further.text;
  EXPECT_EQ(frames("many", ".pvtp"), whole);
  EXPECT_LT(frames("many", "_2.vtp").size(), whole.size());
  EXPECT_FALSE(fs::exists(folder_ / "many" / (last + "_2.vtp")));
  expect_whole("many");
}

}  // namespace
}  // namespace breccia::testing
