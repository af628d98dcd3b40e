# SPDX-License-Identifier: BSD-3-Clause
# Writes the header with what was built and by what: cmake -DSOURCE= -DOUTPUT= -DCOMPILER= -DBUILD= -P build_facts.cmake.
# Run by every build, so that the commit is that of the sources; the file is touched only when it changes.
set(commit "")
find_package(Git QUIET)
if(GIT_FOUND)
  # Of this tree, not of one around it into which the sources were unpacked.
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} rev-parse --show-prefix OUTPUT_VARIABLE prefix
    ERROR_QUIET RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed AND prefix STREQUAL "")
    execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} describe --always --abbrev=12 --dirty --exclude=* OUTPUT_VARIABLE commit
      ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
// SPDX-License-Identifier: BSD-3-Clause
/// Made by cmake/build_facts.cmake.
#pragma once

namespace breccia {

inline constexpr const char* build_commit = "@commit@";
inline constexpr const char* build_compiler = "@COMPILER@";
inline constexpr const char* build_type = "@BUILD@";

}  // namespace breccia
]] @ONLY)
