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

/// Whether it is what `calling` makes of an exception that a plugin did not mean for the user: "packing `from_file`
/// failed while ...". Compared here, unwatched, because libFuzzer would learn those words and put them into names.
__attribute__((no_sanitize("coverage"))) inline bool is_fault(std::string_view said) {
  constexpr std::string_view words = " failed while ";
  std::size_t ticks = 0, at = 0;
  for (; at < said.size() && ticks < 2; ++at) ticks += said[at] == '`';
  if (said.size() - at < words.size()) return false;
  for (std::size_t k = 0; k < words.size(); ++k)
    if (said[at + k] != words[k]) return false;
  return true;
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
    if (is_fault(said)) fail(said);
    return false;
  }
}

}  // namespace breccia::fuzz
