// SPDX-License-Identifier: BSD-3-Clause
/// What the targets of libFuzzer share. Each gives bytes to one reader, which may refuse them in words for the user and
/// do nothing else: whatever comes out besides ends the target, and is a mistake of the reader.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "breccia/error.hpp"
#include "breccia/services.hpp"

namespace breccia::fuzz {

[[noreturn]] inline void fail(std::string_view why) {
  std::fprintf(stderr, "fuzz: %.*s\n", int(why.size()), why.data());
  std::abort();
}

inline std::string_view text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A file in the working folder, which tools/fuzz makes for each target.
inline void write(const char* name, std::string_view bytes) {
  std::ofstream out(name, std::ios::binary | std::ios::trunc);
  if (!out.write(bytes.data(), std::streamsize(bytes.size())).flush()) fail("cannot write the input's file");
}

/// Whether `read` went through. Other exceptions than UserError end the program: nobody catches them.
template <class F>
bool is_read(F&& read) {
  try {
    read();
    return true;
  } catch (const UserError& e) {
    const std::string_view said = e.what();
    if (said.empty()) fail("refused without a word");
    // What a plugin did not say itself, `calling` puts this way: to the user it is a fault of the plugin.
    if (said.find(" failed while ") != said.npos) fail(said);
    return false;
  }
}

class SilentHost final : public Host {
 public:
  void info(std::string_view) override {}
  void warn(std::string_view) override {}
  void progress(std::string_view, double) override {}
  bool cancelled() const override { return false; }
  int threads() const override { return 1; }
};

}  // namespace breccia::fuzz
