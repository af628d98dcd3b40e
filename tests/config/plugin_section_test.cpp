// SPDX-License-Identifier: BSD-3-Clause
#include "run/plugin_section.hpp"

#include <gtest/gtest.h>

namespace breccia {
namespace {

YamlPtr tree_of(const std::string& text) {
  std::vector<Finding> findings;
  return parse_yaml(text, {}, findings);
}

using Paths = std::vector<std::filesystem::path>;

TEST(PluginSection, OfTheWorkflowReplacesThatOfItsBase) {
  BaseChain chain;
  chain.files.push_back({"a.yaml", "/a", tree_of("plugins: [{path: mine.so}, {path: /x/all}]"), {}});
  chain.files.push_back({"b.yaml", "/b", tree_of("plugins: [{path: theirs.so}]"), {}});
  EXPECT_EQ(plugin_paths(chain), (Paths{"/a/mine.so", "/x/all"}));
}

TEST(PluginSection, OfTheBaseStartsAtItsFolder) {
  BaseChain chain;
  chain.files.push_back({"a.yaml", "/a", tree_of("seed: 1"), {}});
  chain.files.push_back({"b.yaml", "/b", tree_of("plugins: [{path: theirs.so}]"), {}});
  EXPECT_EQ(plugin_paths(chain), (Paths{"/b/theirs.so"}));
}

TEST(PluginSection, LeavesMistakesToTheReader) {
  for (const char* text :
       {"plugins: 3", "plugins: [3, {path: [1]}, {pth: x}]", "[]", "plugins:", "plugins: {path: x}"}) {
    BaseChain chain;
    chain.files.push_back({"a.yaml", "/a", tree_of(text), {}});
    chain.files.push_back({"b.yaml", "/b", nullptr, {}});
    EXPECT_EQ(plugin_paths(chain), Paths{}) << text;
  }
}

}  // namespace
}  // namespace breccia
