// SPDX-License-Identifier: BSD-3-Clause
#include "results/file_lock.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <system_error>

#include "results/temporary_folder.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;
using State = FileLock::State;

class FileLocks : public ::testing::Test {
 protected:
  const TemporaryFolder folder_{fs::temp_directory_path(), "breccia-lock"};
  const fs::path file_ = folder_.path() / "a.lock";
};

TEST_F(FileLocks, OneHasItAtATimeAndTheFileGoesWithIt) {
  std::optional<FileLock> first(file_);
  ASSERT_EQ(first->state(), State::held);
  EXPECT_EQ(FileLock(file_).state(), State::with_another);
  EXPECT_TRUE(fs::exists(file_)) << "one who did not get it took the file away";
  first.reset();
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_EQ(FileLock(file_).state(), State::held);
}

TEST_F(FileLocks, WhatItsHolderSaysStandsInTheFile) {
  const FileLock lock(file_);
  lock.say("123 here\n");
  lock.say("4 there\n");  // in place of the first
  std::ifstream in(file_);
  std::string said;
  std::getline(in, said);
  EXPECT_EQ(said, "4 there");
}

/// A file that another process has put there meanwhile is not this one's to remove.
TEST_F(FileLocks, AnotherFileOfThatNameStays) {
  {
    const FileLock lock(file_);
    fs::remove(file_);
    std::ofstream(file_) << "of another";
    EXPECT_EQ(FileLock(file_).state(), State::held);  // nobody holds what stands there now: taken, and removed
    std::ofstream(file_) << "of another";
  }
  EXPECT_TRUE(fs::exists(file_));
}

TEST_F(FileLocks, AMovedOneIsHeldByTheOther) {
  std::optional<FileLock> to;
  {
    FileLock from(file_);
    to.emplace(std::move(from));
  }
  EXPECT_EQ(FileLock(file_).state(), State::with_another);
}

TEST_F(FileLocks, WhatCannotBeMadeSaysWhy) {
  try {
    const FileLock lock(folder_.path() / "nowhere" / "a.lock");
    FAIL() << "there is no such folder";
  } catch (const std::system_error& e) { EXPECT_EQ(e.code(), std::errc::no_such_file_or_directory); }
}

}  // namespace
}  // namespace breccia
