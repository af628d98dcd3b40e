// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run/runner.hpp"

namespace breccia {

/// A monitor that keeps a log file and may show a line that moves.
class Terminal : public RunMonitor {
 public:
  virtual void log_to(const std::filesystem::path& file, bool go_on = false) = 0;  ///< from now on also into this file
  virtual void log_only(const std::string& text) = 0;                              ///< into the file alone
  virtual void clear_bar() = 0;

 protected:
  ~Terminal() = default;
};

}  // namespace breccia
