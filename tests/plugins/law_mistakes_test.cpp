// SPDX-License-Identifier: BSD-3-Clause
// Mistakes that a law's author may make are loud: for the compiler, or for `breccia check`.
#include <gtest/gtest.h>

#include <string>

#include "shell.hpp"

namespace breccia::testing {
namespace {

Output compile(int which, const std::string& flags = "") {
  return shell(std::string(BRECCIA_CXX_COMPILER) +
               " -std=c++20 -fsyntax-only -I" BRECCIA_SOURCE_DIR "/core/sdk -I" BRECCIA_BINARY_DIR
               "/sdk -isystem " BRECCIA_EIGEN " -DBRECCIA_PLUGIN_VERSION='\"0\"' -DWHICH=" +
               std::to_string(which) + " " + flags + " " BRECCIA_SOURCE_DIR "/tests/plugins/fixtures/incomplete.cpp");
}

TEST(LawCompiles, OrSaysInALineWhatIsWrong) {
  const Output whole = compile(0);
  EXPECT_EQ(whole.code, 0) << whole.text;
  struct {
    int which;
    const char* flags;
    const char* said;
  } mistakes[] = {{1, "", "a_unit_must_be_in_SI"},
                  {2, "", "`columns` must name each member of State once"},
                  {3, "", "the names in `columns` must differ"},
                  {4, "", "`columns` must name each member of State once"},
                  {5, "", "the law lacks `breccia::ContactStiffness stiffness(const breccia::Contact&) const`"},
                  {0, "-ffast-math", "cannot be compiled with -ffast-math"}};
  for (const auto& m : mistakes) {
    const Output out = compile(m.which, m.flags);
    EXPECT_NE(out.code, 0) << m.said;
    EXPECT_TRUE(has(out.text, m.said)) << m.said << "\n" << out.text;
    std::size_t errors = 0;
    for (std::size_t at = 0; (at = out.text.find("error:", at)) != std::string::npos; ++at) ++errors;
    EXPECT_EQ(errors, 1u) << "nothing else is said\n" << out.text;
  }
}

Output check(const std::string& law, const std::string& more = "") {
  return shell(BRECCIA_PROGRAM " check contact_law/" + law + " " + more);
}

TEST(LawCheck, ShippedLawsHold) {
  for (const char* law : {BRECCIA_CONTACT_LAWS}) {
    const Output out = check(law);
    EXPECT_EQ(out.code, 0) << out.text;
    EXPECT_TRUE(has(out.text, "all holds")) << out.text;
  }
}

/// A joint lies in space as it is told to: the pair is turned with it, the joint's own direction, too.
TEST(LawCheck, TurnsDirectionsWithThePair) {
  for (const char* normal : {"1, 0, 0", "1, 2, -3"}) {
    const Output out = check("jcfpm", std::string("--set smooth_joint=true --set 'dilation_angle=10 deg' --set "
                                                  "'joint_normal=[") +
                                          normal + "]'");
    EXPECT_EQ(out.code, 0) << out.text;
    EXPECT_TRUE(has(out.text, "ok  turned in space, contact without a bond")) << out.text;
  }
}

TEST(LawCheck, FindsEachMistakeAndSaysWhere) {
  const std::string plugin = "--plugin " BRECCIA_FIXTURES "/mistaken.so --set mistake=";
  // Without any other, its loop is one that no compiler vectorises: it may count its calls.
  const Output none = check("mistaken", plugin + "none");
  const std::string scalar = "FAILED  the loop is vectorised";
  EXPECT_TRUE(has(none.text, scalar) && has(none.text, "1 of the checks failed")) << none.text;
  struct {
    const char* mistake;
    const char* check;
  } mistakes[] = {{"energy", "FAILED  energy against work, tension"},
                  {"shear_sign", "FAILED  energy against work, shear"},
                  {"stiffness", "FAILED  stiffness, normal"},
                  {"hidden", "FAILED  the same twice"},
                  {"ends", "FAILED  ends exchanged"},
                  {"axes", "FAILED  turned in space"},
                  {"dissipation", "FAILED  dissipation, shear"},
                  {"number", "FAILED  numbers for all that the ranges allow"}};
  for (const auto& m : mistakes) {
    const Output out = check("mistaken", plugin + m.mistake);
    EXPECT_NE(out.code, 0) << m.mistake;
    EXPECT_TRUE(has(out.text, m.check)) << m.mistake << "\n" << out.text;
  }
  const Output moments = check("mistaken", plugin + "moments");
  EXPECT_NE(moments.code, 0);
  EXPECT_TRUE(has(moments.text, "fills moments, which would be lost")) << moments.text;
}

}  // namespace
}  // namespace breccia::testing
