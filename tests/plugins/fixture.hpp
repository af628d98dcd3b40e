// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of plugins share: folders of their own, and built plugins under chosen names and with chosen damage.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "breccia/error.hpp"

namespace breccia::test {

namespace fs = std::filesystem;

/// A new folder, gone at the end of the test.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "breccia_plugins_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make a folder for the test");
    path_ = fs::canonical(pattern);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const fs::path& path() const { return path_; }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

inline std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline fs::path write(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.string());
  return file;
}

/// A command of the shell that must end well; what it prints is added to `log`.
inline void run(const std::string& command, const fs::path& log) {
  if (std::system(("(" + command + ") >>'" + log.string() + "' 2>&1").c_str()) != 0)
    throw std::runtime_error(command + "\n" + read(log));
}

#ifdef BRECCIA_FIXTURES
/// The bytes of a plugin that the build made (`tests/plugins/fixtures`).
inline std::string built(const std::string& target) { return read(fs::path(BRECCIA_FIXTURES) / (target + ".so")); }
#endif

/// The text of the UserError that `f` throws; another outcome fails the test.
template <class F>
std::string refusal(F&& f) {
  try {
    f();
  } catch (const UserError& e) { return e.what(); } catch (const std::exception& e) {
    ADD_FAILURE() << "not a UserError: " << e.what();
    return {};
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

/// An environment variable for the length of a scope.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

}  // namespace breccia::test
