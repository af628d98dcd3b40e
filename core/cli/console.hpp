// SPDX-License-Identifier: BSD-3-Clause
/// The terminal and the log file of a run.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "run/terminal.hpp"

namespace spdlog {
class logger;
}

namespace breccia::cli {

/// A progress bar with ETA on a terminal, plain lines now and then elsewhere. Ctrl-C, SIGTERM and
/// SIGHUP ask the run to stop; another one ends the program, unless it follows at once (see on_signal). While it lives,
/// closed pipes and files at their size limit are errors of the write, not signals.
class Console final : public Terminal {
 public:
  explicit Console(int threads);
  ~Console();
  void log_to(const std::filesystem::path& file, bool go_on = false) override;
  void info(std::string_view text) override;
  void warn(std::string_view text) override;
  void progress(std::string_view what, double done) override;
  void status(const RunStatus& status) override;
  bool cancelled() const override;
  int threads() const override { return threads_; }
  void clear_bar() override;
  void log_only(const std::string& text) override;

 private:
  void draw(const std::string& text);
  int threads_;
  bool terminal_, bar_ = false;
  std::chrono::steady_clock::time_point start_, last_drawn_, last_logged_;
  std::unique_ptr<spdlog::logger> file_;
};

}  // namespace breccia::cli
