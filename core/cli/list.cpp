// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "plugin/registry.hpp"

namespace breccia::cli {

int list(const std::string& kind) {
  Registry registry;
  int code = ok;
  const std::vector<std::string> kinds = kind.empty() ? registry.kinds() : std::vector<std::string>{kind};
  for (const std::string& k : kinds) {
    for (const std::string& name : registry.names(k)) {
      try {
        fmt::print("{:<36} {}\n", k + "/" + name, registry.documentation(k, name).summary);
      } catch (const UserError& e) {
        fmt::print(stderr, "{}/{}: {}\n", k, name, e.what());
        code = bad_input;
      }
    }
  }
  for (const std::string& w : registry.warnings()) fmt::print(stderr, "warning: {}\n", w);
  return code;
}

}  // namespace breccia::cli
