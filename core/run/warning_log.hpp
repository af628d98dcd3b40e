// SPDX-License-Identifier: BSD-3-Clause
/// Keeps what a host was warned of, so that it stands in the summary as well as on the terminal and in the log.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "breccia/archive.hpp"
#include "breccia/services.hpp"

namespace breccia {

/// A monitor (`Host` or `RunMonitor`) in front of another: passes everything on, keeps each warning once.
template <class Monitor>
class WarningLog : public Monitor {
 public:
  explicit WarningLog(Monitor& to) : to_(to) {}
  void info(std::string_view text) override { to_.info(text); }
  void warn(std::string_view text) override {
    if (std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end()) return;
    warnings_.emplace_back(text);
    to_.warn(text);
  }
  void progress(std::string_view what, double done) override { to_.progress(what, done); }
  bool cancelled() const override { return to_.cancelled(); }
  int threads() const override { return to_.threads(); }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// What is read goes before what was said here.
  void archive(Archive& archive) {
    const std::vector<std::string> own = warnings_;
    archive("warnings", warnings_);
    for (const std::string& w : own)
      if (std::find(warnings_.begin(), warnings_.end(), w) == warnings_.end()) warnings_.push_back(w);
  }

 protected:
  Monitor& to_;

 private:
  std::vector<std::string> warnings_;
};

}  // namespace breccia
