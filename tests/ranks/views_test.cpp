// SPDX-License-Identifier: BSD-3-Clause
// Plugins that see parts of a specimen: what they measure, and the fields they give, are those of the whole to the last
// bit, and nothing is brought together for them; what fails in one fails in all.
#include <gtest/gtest.h>

#include "check/kept.hpp"
#include "ranks/thread_ranks.hpp"
#include "run/frame_fields.hpp"
#include "run/step_views.hpp"
#include "support/same_bits.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

using Posts = std::vector<Listed<Postprocessor>>;

Posts posts(bool first) {
  static Registry registry;
  Posts all;
  for (const auto& [name, config] : std::vector<std::pair<std::string, Json>>{
           {"stress", Json::object()},
           {"fabric", {{"of", "touching"}, {"columns", true}}},
           {"energy", Json::object()},
           {"damage", Json::object()},
           {"gauges", {{"particles", 4}, {"axial_length", 0.5}}},
           {"contact_stress", {{"at", {0.5, 1.0}}, {"bins", 9}, {"area_factor", 1.0}}}})
    all.emplace_back(PluginChoice{name, config}, registry, first);
  return all;
}

/// What the first rank ends with.
struct Measured {
  KeptCurves curves;
  std::map<std::string, Json> results;
  std::map<std::string, Table> tables;
  std::vector<Field> fields;
  std::size_t broken = 0;
  int gatherings = 0;
};

/// A block that is crushed between two walls, some of it held and some pushed.
Measured measured(RankLink* link) {
  EngineSettings settings;
  settings.damping = {0.2, 0.2};
  settings.link = link;
  Bench b =
      make_bench(random_block(10, 10, 16, 1e-3, 11), elastic_brittle({{"tensile_strength", 5e6}}), 0.15, settings);
  const SpecimenShape s = b->set_specimen_axis(Vec3::UnitZ());
  const auto low = b->add_wall({"low", s.base, Vec3::UnitZ(), 15e6, 5e6, 0.3});
  const auto high = b->add_wall({"high", s.base + s.height * Vec3::UnitZ(), -Vec3::UnitZ(), 15e6, 5e6, 0.3});
  MeetingParts others(link);
  Posts all = posts(others.first());
  Measured m;
  SilentHost host;
  {
    StepViews before(*b.simulation, others);
    for (auto& p : all)
      p.show(before, "beginning", [&](Postprocessor& q, const SimulationView& view) { q.begin(view, m.curves, host); });
  }
  b->prepare();
  b->set_wall_velocity(low, Vec3(0, 0, 4));
  b->set_wall_velocity(high, Vec3(0, 0, -4));
  for (int k = 0; k <= 400; ++k) {
    if (k == 100)
      for (Index a = 0; a < 1600; a += 71) b->set_applied_force(a, Vec3(0.01, 0, 0), Vec3::Zero(), Mat3::Identity());
    if (k == 150)
      for (Index a = 100; a < 1600; a += 370) b->hold(a, dof::all, Vec3(0, 0, 0.1), Vec3::Zero(), Vec3(0, 0, 1e-3));
    b->forces(k % 50 == 0);
    if (k % 50 == 0) {
      if (k == 50) b->mark_start_of_loading();
      StepViews views(*b.simulation, others);
      for (auto& p : all)
        p.show(views, "measuring", [&](Postprocessor& q, const SimulationView& view) {
          if (k == 50) q.start_of_loading(view);
          q.sample(view, m.curves);
        });
      m.curves.end_row();
      if (k == 400) {
        KeptSummary summary;
        for (auto& p : all)
          p.show(views, "summing up",
                 [&](Postprocessor& q, const SimulationView& view) { q.finish(view, m.curves, summary); });
        m.results = summary.all;
        m.tables = summary.tables;
        m.gatherings = b->gatherings();
        m.fields = FrameFields(views, all).of_whole();
      }
    }
    b->advance();
  }
  m.broken = b->broken_bonds();
  return m;
}

void expect_same(const Measured& a, const Measured& b, const std::string& what) {
  ASSERT_EQ(a.curves.columns().size(), b.curves.columns().size()) << what;
  for (std::size_t c = 0; c < a.curves.columns().size(); ++c)
    EXPECT_TRUE(same_bits(a.curves.values(c), b.curves.values(c))) << what << ", " << a.curves.columns()[c].name;
  EXPECT_EQ(a.results, b.results) << what;
  ASSERT_EQ(a.tables.size(), b.tables.size()) << what;
  for (const auto& [name, table] : a.tables)
    for (std::size_t c = 0; c < table.values.size(); ++c)
      EXPECT_TRUE(same_bits(table.values[c], b.tables.at(name).values[c])) << what << ", " << name << ", column " << c;
}

TEST(PartViews, ShowWhatTheWholeShows) {
  const Measured one = measured(nullptr);
  ASSERT_GT(one.broken, 100u) << "the test must break something";
  ASSERT_EQ(one.fields.size(), 6u);
  for (const int ranks : {2, 3}) {
    std::vector<Measured> of_rank(static_cast<std::size_t>(ranks));
    // -1: particles change their ranks whenever the list is made anew.
    on_ranks(
        ranks, [&](RankLink* link) { of_rank[std::size_t(link->rank())] = measured(link); }, ranks == 3 ? -1 : 0.2);
    for (int r = 0; r < ranks; ++r) {
      const Measured& m = of_rank[std::size_t(r)];
      const std::string what = "rank " + std::to_string(r) + " of " + std::to_string(ranks);
      expect_same(one, m, what);
      EXPECT_EQ(m.gatherings, 0) << what;
    }
    ASSERT_EQ(of_rank[0].fields.size(), one.fields.size());
    for (std::size_t k = 0; k < one.fields.size(); ++k) {
      EXPECT_EQ(of_rank[0].fields[k].name, one.fields[k].name);
      EXPECT_TRUE(same_bits(of_rank[0].fields[k].values, one.fields[k].values)) << one.fields[k].name;
    }
  }
}

/// What each of some ranks is told when `work` is done together.
std::vector<std::string> told(int ranks, const std::function<void(MeetingParts&, RankLink&)>& work) {
  std::vector<std::string> texts(static_cast<std::size_t>(ranks));
  on_ranks(ranks, [&](RankLink* link) {
    MeetingParts others(link);
    try {
      others.together([&] { work(others, *link); });
    } catch (const std::exception& e) { texts[std::size_t(link->rank())] = e.what(); }
    double after = 1;  // they can go on
    others.together([&] { others.largest({&after, 1}); });
  });
  return texts;
}

TEST(PartsThatMeet, FailTogetherWithTheTextOfTheOneThatFailed) {
  const auto sum = [](MeetingParts& others) {
    std::vector<ExactSum> sums(2);
    others.add(sums);
  };
  // One fails while the others wait for sums, or are through.
  for (const bool asked : {true, false})
    for (const std::string& text : told(3, [&](MeetingParts&others, RankLink&link) {
           if (link.rank() == 1) throw UserError("no such thing");
           if (asked) sum(others);
         }))
      EXPECT_EQ(text, "no such thing");
  // One asks for something else, more often, or swallows what it is told.
  for (const std::string& text : told(3, [&](MeetingParts&others, RankLink&link) {
         double number = 0;
         if (link.rank() == 2) others.largest({&number, 1});
         else sum(others);
       }))
    EXPECT_NE(text.find("must ask for the same sums"), text.npos) << text;
  for (const std::string& text : told(2, [&](MeetingParts&others, RankLink&link) {
         sum(others);
         try {
           if (link.rank() == 1) sum(others);
         } catch (const UserError&) {}
       }))
    EXPECT_NE(text.find("must ask for the same sums"), text.npos) << text;
  for (const std::string& text : told(2, [&](MeetingParts&others, RankLink&) { sum(others); })) EXPECT_EQ(text, "");
}

TEST(PartsThatMeet, PutRecordsOneBehindTheOther) {
  on_ranks(3, [&](RankLink* link) {
    MeetingParts others(link);
    SimulationView view;
    view.part = PartOfSpecimen{&others, {}, {}, {}, link->rank(), link->ranks()};
    std::vector<int> own(static_cast<std::size_t>(link->rank()), link->rank());  // of the first none
    EXPECT_EQ(view.all(own), (std::vector<int>{1, 2, 2}));
    ExactSumOf<std::size_t> count;
    ExactSumOf<Vec3> sum;
    count.add(std::size_t(link->rank()));
    sum.add(Vec3(0x1p900, link->rank(), link->rank() == 1 ? -0x1p900 : 0));
    const auto [n, s] = view.sum(count, sum);
    EXPECT_EQ(n, 3u);
    EXPECT_EQ(s, Vec3(0x1.8p901, 3, -0x1p900));
    EXPECT_EQ(view.max(-double(link->rank())), 0);
  });
}

}  // namespace
}  // namespace breccia::testing
