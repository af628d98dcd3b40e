// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/drawing.hpp"

#include <gtest/gtest.h>

namespace breccia {
namespace {

using Files = std::vector<std::filesystem::path>;

struct Listener final : SilentHost {
  void warn(std::string_view text) override { warnings.emplace_back(text); }
  std::vector<std::string> warnings;
};

struct NoPlugins final : PluginDirectory {
  std::vector<std::string> names(const std::string&) const override { return {}; }
  const Documentation& documentation(const std::string&, const std::string& name) const override {
    throw UserError("no plugin " + name);
  }
  Issues check(const std::string&, const std::string&, const Json&) const override { return {}; }
};

TEST(Drawing, AMachineThatCannotDrawIsAWarningWhateverElseIsAsked) {
  for (const Refusal refusal : {Refusal::warns, Refusal::ends}) {
    Listener host;
    EXPECT_TRUE(drawn("charts", "painter", refusal, host, []() -> Files { throw Unavailable("no screen"); }).empty());
    EXPECT_EQ(host.warnings, std::vector<std::string>{"no charts by renderer `painter`: no screen"});
  }
}

TEST(Drawing, WhatARendererRefusesEndsTheWorkOnlyWhereItIsWhatWasAskedFor) {
  Listener host;
  const auto refuses = []() -> Files { throw UserError("no such field"); };
  EXPECT_TRUE(drawn("pictures", "painter", Refusal::warns, host, refuses).empty());
  EXPECT_EQ(host.warnings, std::vector<std::string>{"no pictures by renderer `painter`: no such field"});
  EXPECT_THROW(drawn("pictures", "painter", Refusal::ends, host, refuses), UserError);
  EXPECT_EQ(host.warnings.size(), 1U);
}

TEST(Drawing, FilesComeThrough) {
  Listener host;
  EXPECT_EQ(drawn("charts", "painter", Refusal::ends, host, [] { return Files{"a.svg"}; }), Files{"a.svg"});
  EXPECT_TRUE(host.warnings.empty());
}

TEST(Drawing, WithoutPicturesThereIsAWarningAndSettingsOfThemAreAMistake) {
  Listener host;
  EXPECT_FALSE(usual_renderer({}, NoPlugins(), host));
  EXPECT_EQ(host.warnings.size(), 1U);
  EXPECT_THROW(usual_renderer({"width=3"}, NoPlugins(), host), UserError);
}

}  // namespace
}  // namespace breccia
