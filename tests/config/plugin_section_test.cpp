// SPDX-License-Identifier: BSD-3-Clause
#include "workflow/plugin_section.hpp"

#include <gtest/gtest.h>

namespace breccia {
namespace {

YamlPtr tree_of(const std::string& text, int source = 0) {
  std::vector<Finding> findings;
  return parse_yaml(text, {source, 1, 1}, findings);
}

using Paths = std::vector<std::filesystem::path>;
using Overrides = std::vector<std::string>;

TEST(PluginSection, OfTheWorkflowReplacesThatOfItsBase) {
  BaseChain chain;
  chain.whole = true;
  chain.files.push_back({"a.yaml", "/a", tree_of("plugins: [{path: mine.so}, {path: /x/all}]"), {}});
  chain.files.push_back({"b.yaml", "/b", tree_of("plugins: [{path: theirs.so}]", 1), {}});
  EXPECT_EQ(plugin_paths(chain), (Paths{"/a/mine.so", "/x/all"}));
}

TEST(PluginSection, OfTheBaseStartsAtItsFolder) {
  BaseChain chain;
  chain.whole = true;
  chain.files.push_back({"a.yaml", "/a", tree_of("seed: 1"), {}});
  chain.files.push_back({"b.yaml", "/b", tree_of("plugins: [{path: theirs.so}]", 1), {}});
  EXPECT_EQ(plugin_paths(chain), (Paths{"/b/theirs.so"}));
}

TEST(PluginSection, LeavesMistakesToTheReader) {
  for (const char* text : {"plugins: 3", "plugins: [3, {path: [1]}, {pth: x}]", "[]", "plugins:", "plugins: {path: x}",
                           "plugins: [[x]]", "plugins: [path:x]"}) {
    BaseChain chain;
    chain.whole = true;
    chain.files.push_back({"a.yaml", "/a", tree_of(text), {}});
    EXPECT_EQ(plugin_paths(chain), Paths{}) << text;
  }
  BaseChain broken;
  broken.files.push_back({"a.yaml", "/a", nullptr, {}});
  EXPECT_EQ(plugin_paths(broken), Paths{});
}

TEST(PluginSection, APathStandsForAMappingWithThePath) {
  BaseChain chain;
  chain.whole = true;
  chain.files.push_back({"a.yaml", "/a", tree_of("plugins: [mine.so, {path: /x/all}, 'with space.so']"), {}});
  EXPECT_EQ(plugin_paths(chain), (Paths{"/a/mine.so", "/x/all", "/a/with space.so"}));
}

TEST(PluginSection, IsWhatOverridesAndVariantsLeave) {
  BaseChain chain;
  chain.whole = true;
  const char* text = "plugins: [mine.so]\nvariants: {v: {plugins: [other.so]}, w: {seed: 2}}";
  chain.files.push_back({"a.yaml", "/a", tree_of(text), {}});
  EXPECT_EQ(plugin_paths(chain, Overrides{"plugins=[set.so]"}), (Paths{"/a/set.so"}));
  EXPECT_EQ(plugin_paths(chain, Overrides{"plugins.0=set.so"}), (Paths{"/a/set.so"}));
  EXPECT_EQ(plugin_paths(chain, Overrides{"plugins=[]"}), Paths{});
  EXPECT_EQ(plugin_paths(chain, Overrides{}, "v"), (Paths{"/a/other.so"}));
  EXPECT_EQ(plugin_paths(chain, Overrides{}, "w"), (Paths{"/a/mine.so"}));
  EXPECT_EQ(plugin_paths(chain, Overrides{"plugins=[{path: set.so}]"}, "v"), (Paths{"/a/set.so"}));
  ValuesOnTop study{{"s.yaml", "/s", nullptr, {}}, {{"plugins", {}, tree_of("[study.so]")}}, "", nullptr};
  EXPECT_EQ(plugin_paths(chain, study), (Paths{"/s/study.so"}));
}

}  // namespace
}  // namespace breccia
