// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of a plugin need, on its author's side: the program, led by its command line with the plugin as it
/// was just built, and a comparison that says what differs. `breccia_add_plugin_checks(... TESTS file.cpp)` in CMake
/// builds such a test and tells it where things are:
///
///     int main(int argc, char** argv) {
///       return breccia::test_tools::run_tests(argc, argv, [](breccia::test_tools::PluginTest& test) {
///         const breccia::TableFile curves = test.drive("my_law", "normal_m\n1e-6\n", {"--set",
///         "contact_law.stiffness=1 MN/m"}); test.near("force [N]", curves.last("normal_force_N"), 1, 1e-9);
///       });
///     }
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "breccia/atomic_file.hpp"
#include "breccia/result_tools/table_file.hpp"

namespace breccia::test_tools {

using breccia::TableFile;

class PluginTest {
 public:
  /// Arguments: the program, the plugin's file, the folder of the project.
  PluginTest(int argc, char** argv) {
    if (argc != 4) throw UserError("usage: test PROGRAM PLUGIN PROJECT; `ctest` calls it so");
    program_ = argv[1];
    plugin_ = argv[2];
    project_ = argv[3];
    // Beside the build's own files, and gone before the next time.
    work_ = std::filesystem::absolute(std::filesystem::path(argv[0]).filename().string() + "_results");
    std::filesystem::remove_all(work_);
    std::filesystem::create_directories(work_);
    setenv("BRECCIA_PLUGIN_PATH", plugin_.parent_path().c_str(), 1);
  }

  /// Runs a workflow of the project with more options if need be ({"--set", "seed=2"}); the folder of the results.
  std::filesystem::path run(const std::string& workflow, const std::vector<std::string>& options = {}) {
    const std::filesystem::path results = next("run");
    std::vector<std::string> words = {"run",      (project_ / workflow).string(),
                                      "--set",    "plugins=['" + plugin_.string() + "']",
                                      "--output", results.string()};
    words.insert(words.end(), options.begin(), options.end());
    breccia(words);
    return results;
  }

  /// Runs a calibration of the project; the folder of the results.
  std::filesystem::path calibrate(const std::string& calibration) {
    const std::filesystem::path results = next("calibration");
    breccia({"calibrate", (project_ / calibration).string(), "--output", results.string()});
    return results;
  }

  /// Leads one pair along a path (the text of the file that `breccia drive --path` takes); the curves of that.
  TableFile drive(const std::string& law, const std::string& path, const std::vector<std::string>& options = {}) {
    const std::filesystem::path results = next("drive"), file = results.string() + ".csv";
    write_file(file, path);
    std::vector<std::string> words = {"drive", law, "--path", file.string(), "--output", results.string()};
    words.insert(words.end(), options.begin(), options.end());
    breccia(words);
    return TableFile(results / "curves.csv");
  }

  /// The program with these words; UserError with what it printed when it does not end well.
  void breccia(const std::vector<std::string>& words) {
    std::string command = quoted(program_.string());
    for (const std::string& word : words) command += " " + quoted(word);
    const std::filesystem::path said = next("said");
    if (std::system((command + " >" + quoted(said.string()) + " 2>&1 </dev/null").c_str()) != 0)
      throw UserError(command + "\n" + read_bytes(said));
  }

  /// `got` lies within `tolerance` of `expected`.
  void near(const std::string& what, double got, double expected, double tolerance) {
    if (std::abs(got - expected) <= tolerance) return;  // what is not a number is not near
    std::printf("FAILED  %s: %.10g, expected %.10g within %.3g\n", what.c_str(), got, expected, tolerance);
    ++failed_;
  }
  void holds(const std::string& what, bool is_so) {
    if (is_so) return;
    std::printf("FAILED  %s\n", what.c_str());
    ++failed_;
  }
  int failed() const { return failed_; }

 private:
  std::filesystem::path next(const char* what) { return work_ / (what + std::to_string(++count_)); }
  static std::string quoted(const std::string& word) {
    std::string out = "'";
    for (const char c : word)
      if (c == '\'') out += "'\\''";
      else out += c;
    return out + "'";
  }

  std::filesystem::path program_, plugin_, project_, work_;
  int count_ = 0, failed_ = 0;
};

/// The body of `main`: `tests` are called with a PluginTest. Exit code 1 when something failed.
template <class Tests>
int run_tests(int argc, char** argv, Tests&& tests) {
  try {
    PluginTest test(argc, argv);
    tests(test);
    if (test.failed() == 0) std::printf("all holds\n");
    return test.failed() == 0 ? 0 : 1;
  } catch (const std::exception& e) {
    std::printf("FAILED  %s\n", e.what());
    return 1;
  }
}

}  // namespace breccia::test_tools
