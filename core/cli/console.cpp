// SPDX-License-Identifier: BSD-3-Clause
#include "cli/console.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "breccia/utf8.hpp"

namespace breccia::cli {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

extern "C" void on_signal(int signal) {
  if (stop_requested) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  stop_requested = 1;
}

using std::chrono::duration;
using std::chrono::steady_clock;

std::string clock_text(double seconds) {
  const long s = std::lround(seconds);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

Console::Console(int threads) : threads_(threads), terminal_(isatty(STDERR_FILENO) == 1) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  start_ = steady_clock::now();
  last_drawn_ = last_logged_ = start_ - std::chrono::hours(1);
}

Console::~Console() {
  clear_bar();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void Console::log_to(const std::filesystem::path& file) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), true);
    file_ = std::make_unique<spdlog::logger>("run", sink);
  } catch (const spdlog::spdlog_ex& e) { throw UserError("cannot write " + file.string() + ": " + e.what()); }
  file_->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
  file_->flush_on(spdlog::level::info);
  file_->set_error_handler([](const std::string&) {});  // a full disk is told by the files that matter
}

void Console::clear_bar() {
  if (bar_) std::fputs("\r\033[K", stderr);
  bar_ = false;
}

void Console::info(std::string_view text) {
  clear_bar();
  fmt::print(stderr, "{}\n", printable(text));
  if (file_) file_->info("{}", printable(text));
}

void Console::log_only(const std::string& text) {
  if (file_) file_->error("{}", printable(text));
}

void Console::warn(std::string_view text) {
  clear_bar();
  fmt::print(stderr, "warning: {}\n", printable(text));
  if (file_) file_->warn("{}", printable(text));
}

void Console::draw(const std::string& text) {
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  std::fflush(stderr);
  bar_ = true;
}

void Console::progress(std::string_view what, double done) {
  const auto now = steady_clock::now();
  if (!terminal_ || duration<double>(now - last_drawn_).count() < 0.2) return;
  last_drawn_ = now;
  draw(fmt::format("{} {:.0f} %", what, 100 * done));
}

void Console::status(const RunStatus& s) {
  const auto now = steady_clock::now();
  if (s.step == 0) start_ = now;
  const double elapsed = duration<double>(now - start_).count();
  const std::string eta = s.share_done > 0.01 ? clock_text(elapsed * (1 - s.share_done) / s.share_done) : "?";
  const std::string tail = fmt::format("step {}  {}  {} bonds broken", s.step, s.protocol_status, s.bonds_broken);
  if (terminal_ && duration<double>(now - last_drawn_).count() > 0.2) {
    last_drawn_ = now;
    const int width = 24, filled = int(s.share_done * width);
    draw(fmt::format("[{}{}] {:3.0f} %  at most {} left  {}", std::string(std::size_t(filled), '#'),
                     std::string(std::size_t(width - filled), '.'), 100 * s.share_done, eta, tail));
  }
  if (duration<double>(now - last_logged_).count() > 10) {
    last_logged_ = now;
    const std::string line = fmt::format("{:.0f} %  {}", 100 * s.share_done, tail);
    if (!terminal_) fmt::print(stderr, "{}\n", line);
    if (file_) file_->info("{}", line);
  }
}

bool Console::cancelled() const { return stop_requested != 0; }

}  // namespace breccia::cli
