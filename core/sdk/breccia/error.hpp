// SPDX-License-Identifier: BSD-3-Clause
/// The user's mistakes are exceptions with a text to act on; a programmer's mistake is an assertion.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#define BRECCIA_API __attribute__((visibility("default")))

namespace breccia {

/// Something the user can mend. `what()` is printed as it stands: no internal names in it.
class BRECCIA_API UserError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A picture cannot be had on this machine (no OpenGL, say); all else goes on.
class BRECCIA_API Unavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user asked to stop (Ctrl-C) while something long was under way.
class BRECCIA_API Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("stopped on request") {}
};

/// One finding about a value of the configuration; `path` is relative to the plugin's own section
/// ("radius.mean", "walls[2].friction"); empty for the section itself.
struct Issue {
  std::string path;
  std::string text;
};
using Issues = std::vector<Issue>;

[[noreturn]] inline void assertion_failed(const char* what, const char* file, int line) {
  std::fprintf(stderr, "breccia: internal error: %s (%s:%d)\n", what, file, line);
  std::abort();
}

}  // namespace breccia

/// For what only a mistake in the program can cause. Stays on in release builds: not for inner loops.
#define BRECCIA_ASSERT(condition) ((condition) ? void(0) : ::breccia::assertion_failed(#condition, __FILE__, __LINE__))
