// SPDX-License-Identifier: BSD-3-Clause
// Packings that ranks make or read together are those of one, bit for bit, however many there are.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ranks/thread_ranks.hpp"
#include "run/packing_cache.hpp"
#include "support/same_bits.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

class QuietHost final : public SilentHost {};

class Packings : public ::testing::Test {
 protected:
  ~Packings() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& text) const {
    const auto name = folder_ / "p.csv";
    std::ofstream(name, std::ios::binary) << text;
    return name.string();
  }

  /// Made by one and by several: all of it, and what each says of it.
  void expect_same(const std::string& type, const Json& config, PackingRequest request = {}) {
    QuietHost host;
    const PackingOutcome one = obtain_packing(registry(), {type, config}, request, {}, host);
    ASSERT_GT(one.count, 0u);
    for (const int ranks : {2, 3, 5, 8}) {
      SCOPED_TRACE(ranks);
      std::vector<PackingOutcome> pieces{std::size_t(ranks)};
      on_ranks(ranks, [&](RankLink* link) {
        QuietHost quiet;
        pieces[std::size_t(link->rank())] = obtain_packing(registry(), {type, config}, request, {}, quiet, link);
      });
      PackedParticles all;
      for (const auto& column : one.particles.columns) all.columns.push_back({column.first, {}});
      const auto append = [](auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); };
      for (const PackingOutcome& piece : pieces) {
        EXPECT_TRUE(piece.in_pieces);
        EXPECT_EQ(piece.count, one.count);
        EXPECT_EQ(piece.hash, one.hash);
        append(all.position, piece.particles.position);
        append(all.radius, piece.particles.radius);
        ASSERT_EQ(piece.particles.columns.size(), all.columns.size());
        for (std::size_t c = 0; c < all.columns.size(); ++c)
          append(all.columns[c].second, piece.particles.columns[c].second);
        EXPECT_EQ(piece.particles.period, one.particles.period);
        EXPECT_EQ(piece.particles.container_volume, one.particles.container_volume);
        ASSERT_EQ(piece.particles.report.size(), one.particles.report.size());
        for (std::size_t k = 0; k < one.particles.report.size(); ++k)
          EXPECT_EQ(piece.particles.report[k].got, one.particles.report[k].got) << one.particles.report[k].name;
      }
      EXPECT_TRUE(same_bits(all.radius, one.particles.radius));
      EXPECT_TRUE(all.position == one.particles.position);
      EXPECT_EQ(all.columns, one.particles.columns);
    }
  }

  static Registry& registry() {
    static Registry all;
    return all;
  }

  std::filesystem::path folder_ = [] {
    const auto made = std::filesystem::temp_directory_path() / ("breccia-shares-" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    return made;
  }();
};

TEST_F(Packings, OfALattice) {
  const Json cylinder = {{"shape", "cylinder"}, {"diameter", 0.02}, {"height", 0.03}};
  expect_same("regular", {{"lattice", "fcc"}, {"container", cylinder}, {"radius", 1e-3}, {"gap", 0.0}});
  PackingRequest repeats;
  repeats.periodic = {true, false, true};
  const Json box = {{"shape", "box"}, {"size", {0.01, 0.012, 0.014}}};
  expect_same("regular", {{"lattice", "hcp"}, {"container", box}, {"radius", 1e-3}, {"gap", 0.1}}, repeats);
}

TEST_F(Packings, OfCopiesOfACell) {
  std::string cell = "x,y,z,radius,grain\n";  // 4 x 4 x 4 of a lattice, shaken
  for (int k = 0; k < 64; ++k)
    cell += std::to_string(2 * (k % 4) + 0.05 * (k * 7 % 5)) + ',' + std::to_string(2 * (k / 4 % 4)) + ',' +
            std::to_string(2 * (k / 16)) + ',' + std::to_string(1 + 0.002 * (k % 11)) + ',' + std::to_string(k) + '\n';
  Json config = {{"file", file(cell)}, {"length_unit", "mm"}, {"period", {8e-3, 8e-3, 8e-3}}};
  config["copies"] = {{"x", 2}, {"y", 3}, {"z", 1}};
  PackingRequest repeats;
  expect_same("replicated_cell", config);
  repeats.periodic = {true, true, true};
  expect_same("replicated_cell", config, repeats);
  config.erase("copies");
  config["cut"] = {{"shape", "cylinder"}, {"diameter", 0.021}, {"height", 0.025}};
  expect_same("replicated_cell", config);
}

/// Lines of every kind, of which some shares have none.
TEST_F(Packings, OfATable) {
  const auto read = [&](const std::string& text) {
    expect_same("from_file", {{"file", file(text)}, {"length_unit", "mm"}, {"outline", "box"}});
  };
  read("x,y,z,radius\n0,0,0,1\n");
  std::string lines;
  for (int k = 0; k < 40; ++k)
    lines += std::string(k % 7 == 3 ? "# a line that says nothing, and goes on for a while\n\n" : "") +
             std::to_string(3 * k) + ";" + std::to_string(k % 3) + ";0;1." + std::string(std::size_t(k % 5), '1') +
             ";" + (k == 17 ? "quartz" : std::to_string(k)) + ";" + std::to_string(k % 4) + "\n";
  const std::string columns = "x;y;z;radius;name;grain\n";
  read(columns + lines);
  read("\xEF\xBB\xBF# of the year before\n#\n" + std::string(600, '#') + "\n" + columns + lines);
  lines.pop_back();  // its last line has no end
  read(columns + lines);
  for (const char* end : {"\r\n", "\r"}) {
    std::string others;
    for (const char c : columns + lines) others += c == '\n' ? std::string(end) : std::string(1, c);
    read(others);
  }
}

/// What is wrong is said with its line, and by all.
TEST_F(Packings, OfABadTableAreRefusedByAll) {
  std::string text = "x,y,z,radius\n";
  for (int k = 0; k < 100; ++k) text += std::to_string(3 * k) + (k == 77 ? ",0,0,one\n" : ",0,0,1\n");
  const std::string name = file(text);
  std::atomic<int> refused = 0;
  on_ranks(3, [&](RankLink* link) {
    QuietHost quiet;
    try {
      (void)obtain_packing(registry(), {"from_file", {{"file", name}, {"length_unit", "mm"}, {"outline", "box"}}}, {},
                           {}, quiet, link);
    } catch (const UserError& e) {
      EXPECT_NE(std::string(e.what()).find("line 79: radius is `one`"), std::string::npos) << e.what();
      ++refused;
    }
  });
  EXPECT_EQ(refused, 3);
}

}  // namespace
}  // namespace breccia::testing
