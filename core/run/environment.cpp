// SPDX-License-Identifier: BSD-3-Clause
#include "run/environment.hpp"

#include <sys/utsname.h>

#include <fstream>

#include "breccia/utf8.hpp"
#include "build_facts.hpp"

namespace breccia {
namespace {

/// The value of the first line that begins with `key`, up to `by` and behind it.
std::string first_value(const char* file, const std::string& key, char by) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t at = line.find(by);
    std::string value = at == line.npos ? "" : line.substr(at + 1);
    while (!value.empty() && (value.front() == ' ' || value.front() == '"')) value.erase(0, 1);
    while (!value.empty() && (value.back() == ' ' || value.back() == '"')) value.pop_back();
    return valid_utf8(value);
  }
  return {};
}

}  // namespace

Json environment() {
  utsname about{};
  uname(&about);
  const std::string kernel = std::string(about.sysname) + " " + about.release + " " + about.machine,
                    distribution = first_value("/etc/os-release", "PRETTY_NAME=", '=');
  return {{"breccia", BRECCIA_VERSION},
          {"commit", build_commit},
          {"compiler", build_compiler},
          {"build", build_type},
          {"host", valid_utf8(about.nodename)},
          {"system", distribution.empty() ? kernel : distribution + ", " + kernel},
          {"processor", first_value("/proc/cpuinfo", "model name", ':')}};
}

}  // namespace breccia
