// SPDX-License-Identifier: BSD-3-Clause
// What a rank makes of a packing is its share of the whole, and no more; what is chosen over the whole is the same.
#include <gtest/gtest.h>

#include "archive/memory_archive.hpp"
#include "engine/assembly.hpp"
#include "engine/migration.hpp"
#include "ranks/thread_ranks.hpp"
#include "support/same_bits.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

/// Of a packing what one of the ranks has: of three the first nothing, the second a third.
PackedParticles piece_of(PackedParticles packing, RankLink* link) {
  if (!link) return packing;
  const std::size_t n = packing.radius.size(), most = std::size_t(link->ranks() * (link->ranks() - 1)),
                    r = std::size_t(link->rank());
  const auto from = [&](std::size_t rank) { return std::ptrdiff_t(n * (rank * (rank - 1)) / most); };
  packing.position = {packing.position.begin() + from(r), packing.position.begin() + from(r + 1)};
  packing.radius = {packing.radius.begin() + from(r), packing.radius.begin() + from(r + 1)};
  return packing;
}

struct Bonded {
  std::vector<Index> i, j, id;
  std::vector<double> distance, radius;
  BondingResult result;
  SpecimenShape shape;
  double porosity = 0, height_of_axis_x = 0;
  std::vector<std::size_t> held;  ///< particles of each rank, with copies
};

Bonded bonded(int ranks, const BondingRule& rule, bool periodic, int height = 16) {
  PackedParticles packing = random_block(10, 10, height, 1e-3, 11);
  for (std::size_t k = 0; k < packing.radius.size(); k += 7) packing.radius[k] *= 0.8;
  if (periodic) packing.period = Vec3(20e-3, 20e-3, 2e-3 * height);
  Bonded all;
  std::mutex guard;
  on_ranks(ranks, [&](RankLink* link) {
    const auto law = make_law(elastic_brittle({}), "elastic_brittle");
    EngineSettings settings;
    settings.link = link;
    Simulation s(assemble(piece_of(packing, link), {2650}, 3, 1.0, link), *law, settings);
    const BondingResult result = s.bond(rule);
    {
      const std::lock_guard lock(guard);
      all.held.push_back(s.state().particles.size());
    }
    const SpecimenShape across = s.set_specimen_axis(Vec3::UnitX());
    const SimulationView v = s.view();
    if (link && !link->first()) return;
    const auto list = [](auto span) { return std::vector(span.begin(), span.end()); };
    all.i = list(v.bonds.i);
    all.j = list(v.bonds.j);
    all.distance = list(v.bonds.initial_distance);
    all.id = list(v.particles.id);
    all.radius = list(v.particles.radius);
    all.result = result;
    all.shape = v.specimen;
    all.porosity = s.porosity();
    all.height_of_axis_x = across.height;
  });
  return all;
}

TEST(Shares, AreBondedAsTheWhole) {
  const BondingRule by_limit{GapMeasure::relative, 0.15, std::nullopt},
      by_number{GapMeasure::relative, std::nullopt, 7.3}, by_gap{GapMeasure::absolute, std::nullopt, 9.1};
  for (const BondingRule& rule : {by_limit, by_number, by_gap})
    for (const bool periodic : {false, true}) {
      const Bonded one = bonded(1, rule, periodic);
      ASSERT_GT(one.i.size(), 1000u);
      EXPECT_EQ(one.result.bonds, one.i.size());
      for (const int ranks : {2, 3, 5}) {
        const Bonded many = bonded(ranks, rule, periodic);
        EXPECT_EQ(one.i, many.i) << ranks;
        EXPECT_EQ(one.j, many.j) << ranks;
        EXPECT_EQ(one.id, many.id) << ranks;
        EXPECT_TRUE(same_bits(one.distance, many.distance)) << ranks;
        EXPECT_TRUE(same_bits(one.radius, many.radius)) << ranks;
        EXPECT_EQ(one.result.limit, many.result.limit) << ranks;
        EXPECT_EQ(one.result.coordination_number, many.result.coordination_number) << ranks;
        EXPECT_EQ(one.result.bonds, many.result.bonds) << ranks;
        EXPECT_EQ(one.shape.volume, many.shape.volume) << ranks;
        EXPECT_EQ(one.porosity, many.porosity) << ranks;
        EXPECT_EQ(one.height_of_axis_x, many.height_of_axis_x) << ranks;
      }
    }
}

/// Of 2900 particles the ranks own two or three blocks, 512 or 768 particles: what one of them asks all of them ask.
TEST(Shares, OfUnequalSizeAskForTheSame) {
  const BondingRule rule{GapMeasure::relative, 0.15, std::nullopt};
  EXPECT_EQ(bonded(1, rule, false, 29).i, bonded(5, rule, false, 29).i);
}

TEST(Shares, HaveCopiesOfNeighboursAndNoMore) {
  const Bonded many = bonded(4, {GapMeasure::relative, 0.15, std::nullopt}, false, 100);
  ASSERT_EQ(many.held.size(), 4u);
  for (const std::size_t held : many.held) EXPECT_LT(held, 10000u * 2 / 5) << "far more than a quarter stands here";
}

/// Many in the same cell of the curve, and in one place: those that come first in the packing come first.
TEST(Shares, HaveTheOrderOfTheWhole) {
  PackedParticles packing;
  for (int k = 0; k < 6000; ++k) {
    packing.position.push_back(1e-3 * Vec3((k * 37) % 11, (k * 53) % 3, 1e-9 * ((k * 71) % 17)));
    packing.radius.push_back(1e-3 + 1e-8 * k);
  }
  packing.outline = SpecimenShape::Outline::box;
  const State whole = assemble(packing, {2650}, 3, 1.0);
  for (const int ranks : {2, 3, 5, 8}) {
    std::mutex guard;
    std::vector<std::vector<Index>> id{std::size_t(ranks)};
    on_ranks(ranks, [&](RankLink* link) {
      const State part = assemble(piece_of(packing, link), {2650}, 3, 1.0, link);
      EXPECT_EQ(part.specimen.volume, whole.specimen.volume);
      EXPECT_EQ(part.particles.row.front(), even_shares(packing.radius.size(), ranks)[std::size_t(link->rank())]);
      const std::lock_guard lock(guard);
      id[std::size_t(link->rank())] = part.particles.id;
    });
    std::vector<Index> joined;
    for (const auto& part : id) joined.insert(joined.end(), part.begin(), part.end());
    EXPECT_EQ(joined, whole.particles.id) << ranks;
  }
}

TEST(Shares, OfABadParticleAreRefusedByAll) {
  PackedParticles packing = random_block(10, 10, 16, 1e-3, 11);
  packing.radius[700] = -1;
  std::atomic<int> refused = 0;
  on_ranks(3, [&](RankLink* link) {
    try {
      (void)assemble(piece_of(packing, link), {2650}, 3, 1.0, link);
    } catch (const UserError& e) {
      EXPECT_NE(std::string(e.what()).find("particle 700 of the packing"), std::string::npos) << e.what();
      ++refused;
    }
  });
  EXPECT_EQ(refused, 3);
}

TEST(Shares, OfACoincidentPairAreRefusedByAll) {
  PackedParticles packing = random_block(10, 10, 16, 1e-3, 11);
  packing.position[7] = packing.position[8];
  std::atomic<int> refused = 0;
  on_ranks(3, [&](RankLink* link) {
    const auto law = make_law(elastic_brittle({}), "elastic_brittle");
    EngineSettings settings;
    settings.link = link;
    Simulation s(assemble(piece_of(packing, link), {2650}, 3, 1.0, link), *law, settings);
    EXPECT_THROW(s.bond({GapMeasure::relative, 0.1, std::nullopt}), UserError);
    ++refused;
  });
  EXPECT_EQ(refused, 3);
}

/// What moves arrives once, with what belongs to it, whoever told of it.
TEST(Migration, OfPairsThatTwoRanksKnow) {
  // Rows 0 to 7 of two ranks; the cut goes from 4 to 2.
  on_ranks(2, [&](RankLink* link) {
    const Migration move(*link, {0, 4, 8}, {0, 2, 8});
    const bool first = link->first();
    const std::vector<Index> i = first ? std::vector<Index>{0, 1, 3, 3} : std::vector<Index>{3, 5},
                             j = first ? std::vector<Index>{1, 2, 4, 5} : std::vector<Index>{4, 6};
    std::vector<double> value;
    for (std::size_t k = 0; k < i.size(); ++k) value.push_back(10 * i[k] + j[k]);
    const PairMigration pairs(move, i, j);
    pairs(value);
    std::vector<double> none;
    pairs(none);  // an array that no rank has stays so
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(pairs.i, first ? (std::vector<Index>{0, 1}) : (std::vector<Index>{1, 3, 3, 5}));
    EXPECT_EQ(pairs.j, first ? (std::vector<Index>{1, 2}) : (std::vector<Index>{2, 4, 5, 6}));
    EXPECT_EQ(value, first ? (std::vector<double>{1, 12}) : (std::vector<double>{12, 34, 35, 56}));
    std::vector<Index> rows;
    for (Index row = first ? 0 : 4; row < (first ? 4u : 8u); ++row) rows.push_back(row);
    EXPECT_EQ(move.rows(std::span<const Index>(rows)),
              first ? (std::vector<Index>{0, 1}) : (std::vector<Index>{2, 3, 4, 5, 6, 7}));
  });
}

/// A test that begins on the specimen of another one's checkpoint.
TEST(Shares, TakeTheSpecimenOfACheckpoint) {
  const PackedParticles packing = random_block(10, 10, 16, 1e-3, 11);
  const auto made = [&](RankLink* link) {
    EngineSettings settings;
    settings.link = link;
    settings.damping = {0.2, 0.2};
    return make_bench(packing, elastic_brittle({{"tensile_strength", 5e6}}), 0.15, settings);
  };
  MemoryArchive kept;
  {
    Bench b = made(nullptr);
    b->prepare();
    for (Index a = 0; a < 1500; a += 3) b->hold(a, dof::all, Vec3(0, 0, a % 2 ? 3 : -3), Vec3::Zero());
    b.steps(300);
    ASSERT_GT(b->broken_bonds(), 20u);
    b->archive(kept);
  }
  std::vector<Vec3> one;
  for (const int ranks : {1, 2, 3})
    on_ranks(ranks, [&](RankLink* link) {
      Bench b = made(link);
      MemoryArchive from;
      from.read_back(kept);
      b->take_specimen(from);
      b->prepare();
      b.steps(200);
      const auto x = b->particles().position;
      const std::vector<Vec3> end(x.begin(), x.end());
      if (ranks == 1) one = end;
      else EXPECT_TRUE(same_bits(one, end)) << ranks << " ranks";
    });
}

}  // namespace
}  // namespace breccia::testing
