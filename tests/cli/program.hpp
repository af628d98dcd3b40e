// SPDX-License-Identifier: BSD-3-Clause
/// The program as a user meets it: a folder of one's own, a command line, an exit code and what was printed.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "breccia/schema.hpp"

namespace breccia::testing {

namespace fs = std::filesystem;

inline const std::string program = BRECCIA_BINARY_DIR "/bin/breccia";

inline std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Result {
  int code;
  std::string text;  ///< both streams
};

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "breccia-test-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    ::setenv("BRECCIA_CACHE", (folder_ / "cache").c_str(), 1);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// In the folder; `before` stands before the program on the command line.
  Result call(const std::string& arguments, const std::string& before = "") const {
    const fs::path out = folder_.string() + ".txt";
    const std::string command = "cd '" + folder_.string() + "' && " + before + " '" + program + "' " + arguments +
                                " >'" + out.string() + "' 2>&1 </dev/null";
    const int status = std::system(command.c_str());
    Result result{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), content(out)};
    fs::remove(out);
    return result;
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  fs::path folder_;
};

/// A summary less what differs between two processes that did the same.
inline Json without_the_computers(Json summary) {
  for (const char* key : {"wall_time_s", "ns_per_bond_step", "threads"}) summary.erase(key);
  for (const char* name : {"wall_time", "ns_per_bond_step", "threads"}) summary["values"].erase(name);
  return summary;
}

}  // namespace breccia::testing
