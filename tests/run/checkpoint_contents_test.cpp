// SPDX-License-Identifier: BSD-3-Clause
/// A checkpoint that is whole, but does not hold what is read from it: refused in words, before memory is taken for
/// what it says to hold.
#include <gtest/gtest.h>
#include <unistd.h>

#include "archive/checkpoint_file.hpp"

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

TEST(CheckpointContents, RecordsAreAsManyAsTheirMembers) {
  std::vector<Record> list;
  const std::string said = refusal([&](Archive& a) { a.records("list", list, std::pair("x", &Record::x)); });
  EXPECT_NE(said.find("/list/x: 2 values where 1152921504606846976 belong"), std::string::npos) << said;
}

}  // namespace
}  // namespace breccia
