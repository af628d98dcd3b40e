// SPDX-License-Identifier: BSD-3-Clause
/// Error texts are part of the product: NAME.yaml (and NAME.set, one override a line) must be refused with exactly the
/// lines of NAME.expected. A missing .expected fails; the failure prints what it would have to hold. Files to build on
/// are in `bases/`.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "config/reader.hpp"
#include "fake_workflow.hpp"

namespace breccia {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(CASES))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class ErrorText : public testing::TestWithParam<std::string> {};

TEST_P(ErrorText, IsAsExpected) {
  const std::filesystem::path base = std::filesystem::path(CASES) / GetParam();
  const auto with = [&](const char* ending) { return base.string() + ending; };
  std::vector<std::string> overrides;
  if (std::filesystem::exists(with(".set"))) overrides = lines_of(content_of(with(".set")));
  std::filesystem::current_path(CASES);  // so that messages name files as they are called here
  std::string got;
  try {
    const Json config = read_config(content_of(with(".yaml")), GetParam() + ".yaml", fake::root(), fake::Plugins(),
                                    overrides, fake::rules);
    FAIL() << "no error; it was read as " << config.dump();
  } catch (const ConfigError& error) { got = std::string(error.what()) + "\n"; }
  EXPECT_EQ(got, content_of(with(".expected")));
}

INSTANTIATE_TEST_SUITE_P(Cases, ErrorText, testing::ValuesIn(case_names()),
                         [](const auto& parameter) { return parameter.param; });

TEST(ErrorCases, AreThere) { EXPECT_GE(case_names().size(), 40u); }

}  // namespace
}  // namespace breccia
