// SPDX-License-Identifier: BSD-3-Clause
/// A checkpoint that is whole, but does not hold what is read from it: refused in words, before memory is taken for
/// what it says to hold.
#include <gtest/gtest.h>
#include <unistd.h>

#include "archive/checkpoint_file.hpp"
#include "breccia/atomic_file.hpp"
#include "breccia/text_file.hpp"

namespace breccia {
namespace {

struct Record {
  double x = 0;
};

/// What reading says of the length 2^60 in place of a list's.
template <class Read>
std::string refusal(Read&& read) {
  const auto file =
      std::filesystem::temp_directory_path() / ("checkpoint_contents_" + std::to_string(getpid()) + ".h5");
  {
    const auto writer = begin_checkpoint();
    const Archive::Group group(*writer, "list");
    std::uint64_t size = std::uint64_t(1) << 60;
    std::string first = "text";
    std::vector<double> x = {1, 2};
    (*writer)("size", size);
    (*writer)("0", first);
    (*writer)("x", x);
    writer->commit(file);
  }
  std::string said;
  try {
    const auto reader = read_checkpoint(file);
    read(*reader);
  } catch (const UserError& e) { said = e.what(); }
  std::filesystem::remove(file);
  return said;
}

TEST(CheckpointContents, AListEndsWhereThereIsNoMore) {
  std::vector<std::string> list;
  EXPECT_NE(refusal([&](Archive& a) { a("list", list); }).find("/list/1: is missing"), std::string::npos);
}

TEST(CheckpointContents, ANameThatIsThereTwiceIsRefusedAndTheNextCheckpointIsMade) {
  double x = 1;
  std::vector<double> list = {1, 2};
  const auto second = [&](const char* first, const char* name, auto& value) -> std::string {
    const auto writer = begin_checkpoint();
    (*writer)(first, x);
    try {
      (*writer)(name, value);
    } catch (const UserError& e) { return e.what(); }
    return {};
  };
  const std::string twice = "no checkpoint can be made: /a";
  EXPECT_EQ(second("a", "a", x).substr(0, twice.size()), twice);
  EXPECT_EQ(second("a", "a/b", x).substr(0, twice.size()), twice);
  EXPECT_EQ(second("a/b", "a", x).substr(0, twice.size()), twice);
  EXPECT_EQ(second("a/b", "a/c", x), "");
  EXPECT_EQ(second("a", "b", list), "");
}

/// A checkpoint of two blocks, in a file of its own.
class CheckpointFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto writer = begin_checkpoint();
    std::vector<double> list(200000, 0.5);
    (*writer)("list", list);
    writer->commit(file_);
  }
  void TearDown() override { std::filesystem::remove(file_); }
  const std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("checkpoint_file_" + std::to_string(getpid()) + ".h5");
};

TEST_F(CheckpointFile, OfAnEarlierFormatIsRefused) {
  std::string bytes = read_bytes(file_);
  const std::string now = "breccia checkpoint 2";
  ASSERT_TRUE(bytes.starts_with(now + "\n"));
  bytes[now.size() - 1] = '1';
  write_file(file_, bytes);
  try {
    read_checkpoint(file_);
    FAIL();
  } catch (const UserError& e) {
    EXPECT_NE(std::string(e.what()).find("has the format `breccia checkpoint 1`, this program reads `" + now + "`"),
              std::string::npos)
        << e.what();
  }
}

TEST_F(CheckpointFile, ItsDigestIsWhatTheDocumentationSays) {
  const std::string command = "tail -c +513 '" + file_.string() +
                              "' | split -b 1M --filter=sha256sum | cut -c-64 | tr -d '\\n' | sha256sum | cut -c-64";
  FILE* const out = popen(command.c_str(), "r");
  char digest[65] = {};
  ASSERT_EQ(fread(digest, 1, 64, out), 64u);
  pclose(out);
  EXPECT_NE(read_bytes(file_).find(std::string("\nsha256 of blocks ") + digest + "\n"), std::string::npos) << digest;
}

TEST(CheckpointContents, RecordsAreAsManyAsTheirMembers) {
  std::vector<Record> list;
  const std::string said = refusal([&](Archive& a) { a.records("list", list, std::pair("x", &Record::x)); });
  EXPECT_NE(said.find("/list/x: 2 values where 1152921504606846976 belong"), std::string::npos) << said;
}

}  // namespace
}  // namespace breccia
