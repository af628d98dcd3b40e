// SPDX-License-Identifier: BSD-3-Clause
/// What is wrong with a workflow, and where.
#pragma once

#include <string>
#include <vector>

#include "breccia/error.hpp"

namespace breccia {

/// One finding. Line and column count from 1, columns in characters. For values of the command line, `file` is
/// "--set" and `line` says which of the overrides it is.
struct Problem {
  std::string file;
  int line = 1, column = 1;
  std::string path;  ///< "contact_law.friction", "walls[0].point"; empty for the whole file
  std::string text;
  /// "workflow.yaml:12:3: contact_law.friction: must be at least 0, not `-1`"
  std::string str() const;
};

/// Everything that is wrong with a workflow, file by file (the workflow, its bases, the command line) and in the order
/// of each; `what()` is one line for each.
class ConfigError : public UserError {
 public:
  explicit ConfigError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace breccia
