// SPDX-License-Identifier: BSD-3-Clause
#include "config/problem.hpp"

namespace breccia {

namespace {

std::string joined(const std::vector<Problem>& problems) {
  std::string all;
  for (const Problem& p : problems) all += (all.empty() ? "" : "\n") + p.str();
  return all;
}

}  // namespace

std::string Problem::str() const {
  const std::string where = file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": ";
  return where + (path.empty() ? "" : path + ": ") + text;
}

ConfigError::ConfigError(std::vector<Problem> problems) : UserError(joined(problems)), problems_(std::move(problems)) {
  BRECCIA_ASSERT(!problems_.empty());
}

}  // namespace breccia
