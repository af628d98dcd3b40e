// SPDX-License-Identifier: BSD-3-Clause
// `breccia check` of the kinds that are no contact law: all that is shipped holds, and each mistake that an author may
// make is found by the check that is for it.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <filesystem>
#include <vector>

#include "shell.hpp"

namespace breccia::testing {
namespace {

Output check(const std::string& plugin, const std::string& more = "") {
  Output out = shell(BRECCIA_PROGRAM " check " + plugin + " " + more);
  out.code = WEXITSTATUS(out.code);
  return out;
}

class Shipped : public ::testing::TestWithParam<const char*> {};

TEST_P(Shipped, Holds) {
  const std::string kind = GetParam(), head = "breccia_" + kind + ".";
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BRECCIA_BINARY_DIR "/lib/breccia")) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with(head)) continue;
    const Output out = check(kind + "/" + file.substr(head.size(), file.size() - head.size() - 3));
    EXPECT_EQ(out.code, 0) << out.text;
    EXPECT_TRUE(has(out.text, "\nall holds")) << out.text;
    EXPECT_TRUE(has(out.text, "    ok  ")) << out.text;
    ++count;
  }
  if (kind == "output" || kind == "renderer" || kind == "search") return;  // a build without VTK, OpenTURNS has none
  EXPECT_GE(count, kind == "packing" ? 5u : 7u);
}

INSTANTIATE_TEST_SUITE_P(Plugins, Shipped,
                         ::testing::Values("packing", "protocol", "postprocessor", "output", "renderer", "search"),
                         [](const auto& its) { return its.param; });

struct Mistake {
  const char *mistake, *finding;
};

void finds(const std::string& kind, const std::vector<Mistake>& mistakes) {
  const std::string plugin = "--plugin " BRECCIA_FIXTURES "/mistaken_" + kind + ".so --set mistake=";
  const Output none = check(kind + "/mistaken", plugin + "none");
  EXPECT_EQ(none.code, 0) << none.text;
  EXPECT_TRUE(has(none.text, "\nall holds")) << none.text;
  for (const Mistake& m : mistakes) {
    const Output out = check(kind + "/mistaken", plugin + m.mistake);
    const bool fails = std::string(m.finding).starts_with("FAILED");
    EXPECT_EQ(out.code, fails ? 2 : 0) << m.mistake << "\n" << out.text;
    EXPECT_TRUE(has(out.text, m.finding)) << m.mistake << "\n" << out.text;
  }
}

TEST(KindMistakes, OfPackings) {
  finds("packing", {{"outside", "FAILED  inside the container"},
                    {"seed", "FAILED  another seed"},
                    {"threads", "FAILED  threads"},
                    {"clock", "FAILED  the same twice"},
                    {"number", "FAILED  makes a packing"},
                    {"twice", "FAILED  no two in one place"},
                    {"radii", "FAILED  radii asked for"},
                    {"report", "FAILED  report"},
                    {"plane", "FAILED  in the plane"},
                    {"images", "FAILED  overlaps: 3D, box, periodic"},
                    {"cell", "FAILED  within one cell"},
                    {"volume", "FAILED  shape of the specimen: 2D"},
                    {"half", "FAILED  shape of the specimen"},
                    {"deaf", "FAILED  cancellation"},
                    {"stubborn", "FAILED  cancellation"},
                    {"exception", "FAILED  numbers for all that the ranges allow"},
                    {"shares", "FAILED  in two shares"},
                    {"measures", "FAILED  in two shares"}});
}

TEST(KindMistakes, OfProtocols) {
  finds("protocol", {{"forgets", "FAILED  archive and resume"},
                     {"says_nothing", "not checked  archive and resume"},
                     {"endless", "FAILED  runs to its end"},
                     {"never_begins", "FAILED  rows of curves"},
                     {"unset", "FAILED  names, units and numbers of the curves"},
                     {"number", "FAILED  names, units and numbers of the curves"},
                     {"unit", "FAILED  names, units and numbers of the curves"},
                     {"hidden", "FAILED  threads"},
                     {"samples", "FAILED  rows more rarely"},
                     {"share", "FAILED  share done"},
                     {"finish", "FAILED  stopped on request"},
                     {"result", "FAILED  results"},
                     {"exception", "FAILED  runs to its end"},
                     {"stale", "FAILED  energy closes"}});
}

TEST(KindMistakes, OfPostprocessors) {
  finds("postprocessor", {{"rotation", "FAILED  no strain in a rigid motion"},
                          {"sign", "FAILED  strain of an affine displacement"},
                          {"accumulates", "FAILED  sampled once or three times"},
                          {"number", "FAILED  finite numbers: 3D, box, without bonds"},
                          {"forgets", "FAILED  archive and resume"},
                          {"says_nothing", "not checked  archive and resume"},
                          {"order", "FAILED  order of the particles"},
                          {"ends", "FAILED  order of the particles"},
                          {"threads", "FAILED  threads"},
                          {"unit", "FAILED  names and units"},
                          {"name", "FAILED  names and units"},
                          {"unset", "FAILED  finite numbers"},
                          {"field", "FAILED  finite numbers"},
                          {"hidden", "FAILED  the same twice"},
                          {"exception", "FAILED  measures"},
                          {"parts", "FAILED  in two parts"}});
}

TEST(KindMistakes, OfOutputsAndRenderers) {
  finds("output", {{"forgets", "FAILED  archive and resume"},
                   {"silent", "FAILED  a write that fails"},
                   {"partial", "FAILED  writes frames"},
                   {"clock", "FAILED  the same twice"}});
  finds("renderer", {{"source", "FAILED  leaves the run alone"},
                     {"left", "FAILED  draws a run"},
                     {"nothing", "FAILED  draws a run"}});
}

TEST(KindMistakes, OfSearches) {
  finds("search", {{"outside", "FAILED  points in the cube"},
                   {"few", "FAILED  points in the cube"},
                   {"again", "FAILED  new points"},
                   {"lost", "FAILED  finds what is wanted"},
                   {"sure", "FAILED  says how sure it is"},
                   {"spread", "FAILED  points that agree"},
                   {"idle", "FAILED  sensitivities"},
                   {"clock", "FAILED  the same when told again"},
                   {"gaps", "FAILED  values that are missing"},
                   {"exception", "FAILED  answers"}});
}

TEST(Check, SaysWhatToWrite) {
  const Output kind = check("packing");
  EXPECT_EQ(kind.code, 2);
  EXPECT_TRUE(has(kind.text, "one plugin is checked at a time: write one of")) << kind.text;
  EXPECT_TRUE(has(kind.text, "`packing/regular`")) << kind.text;
  const Output name = check("regular");
  EXPECT_EQ(name.code, 0) << name.text;
  EXPECT_TRUE(name.text.starts_with("packing/regular ")) << name.text;
  const Output slip = check("reglar");
  EXPECT_EQ(slip.code, 2);
  EXPECT_TRUE(has(slip.text, "did you mean `regular`? check takes KIND/NAME")) << slip.text;
  const Output other = check("packing/reglar");
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(has(other.text, "no packing named `reglar`; did you mean `regular`")) << other.text;
  const Output unknown = check("parking/regular");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(has(unknown.text, "packing")) << unknown.text;
  const Output value = check("packing/regular", "--set gap=nought");
  EXPECT_EQ(value.code, 2);
  EXPECT_TRUE(has(value.text, "gap")) << value.text;
}

}  // namespace
}  // namespace breccia::testing
