// SPDX-License-Identifier: BSD-3-Clause
#include "cli/console.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>

#include "breccia/utf8.hpp"
#include "plugin/guarded.hpp"

namespace breccia::cli {
namespace {

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t first_request = 0;  // [s], of a clock that cannot be set

constexpr unsigned patience = 3;  // [s] for a plugin to come back
pthread_t own_thread;

/// As a signal handler may: without memory from the heap.
void write_words(std::initializer_list<std::string_view> words) {
  for (const std::string_view w : words) (void)!write(STDERR_FILENO, w.data(), w.size());
}

/// What the program's own thread is doing in a plugin, between the two; nothing when it is in none.
bool name_plugin_at_work(std::string_view lead, std::string_view end) {
  const AtWork* at = AtWork::innermost();
  if (at)
    write_words({"\nbreccia: ", lead, at->plugin.kind, " `", at->plugin.type, "` is still ", at->doing, end, "\n"});
  return at;
}

/// What a handler calls leaves no trace in what it interrupts.
class KeptErrno {
 public:
  ~KeptErrno() { errno = kept_; }

 private:
  const int kept_ = errno;
};

/// The first signal asks the run to stop. One that comes at once after it is no second thought: `timeout` and batch
/// systems signal the process and its group, a closing terminal sends SIGHUP and SIGTERM. Only a later one ends the
/// program, for a run that is stuck in a plugin.
extern "C" void on_signal(int signal) {
  const KeptErrno keep;
  if (!pthread_equal(pthread_self(), own_thread)) {
    pthread_kill(own_thread, signal);
    return;
  }
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (stop_requested) {
    if (now.tv_sec - first_request < 2) return;
    name_plugin_at_work("ended at once: ", "");
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  } else {
    first_request = std::sig_atomic_t(now.tv_sec);
    stop_requested = 1;
    alarm(patience);
  }
}

extern "C" void on_alarm(int) {
  const KeptErrno keep;
  constexpr std::string_view again = "; asked once more, the program ends at once";
  if (!pthread_equal(pthread_self(), own_thread)) pthread_kill(own_thread, SIGALRM);
  else if (!name_plugin_at_work("asked to stop, but ", again))
    write_words({"\nbreccia: asked to stop, and not done yet: results are written, or another thread is in a plugin",
                 again, "\n"});
}

/// To the terminal, if there still is one: a closed pipe (`| head`) does not end a run.
void say(const std::string& text) { std::fputs(text.c_str(), stderr); }

using std::chrono::duration;
using std::chrono::steady_clock;

std::string clock_text(double seconds) {
  const long s = std::lround(seconds);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

Console::Console(int threads) : threads_(threads), terminal_(isatty(STDERR_FILENO) == 1) {
  own_thread = pthread_self();
  std::signal(SIGALRM, on_alarm);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler != SIG_IGN) std::signal(signal, on_signal);  // nohup's wish stands
  }
  // A file that may not grow (ulimit -f) and a reader that is gone are told by the write that fails.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  start_ = steady_clock::now();
  last_drawn_ = last_logged_ = start_ - std::chrono::hours(1);
}

Console::~Console() {
  clear_bar();
  alarm(0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler == on_signal) std::signal(signal, SIG_DFL);
  }
}

void Console::log_to(const std::filesystem::path& file, bool go_on) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), !go_on);
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
  say(fmt::format("{}\n", printable(text)));
  if (file_) file_->info("{}", printable(text));
}

void Console::log_only(const std::string& text) {
  if (file_) file_->error("{}", printable(text));
}

void Console::warn(std::string_view text) {
  clear_bar();
  say(fmt::format("warning: {}\n", printable(text)));
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
    if (!terminal_) say(line + "\n");
    if (file_) file_->info("{}", line);
  }
}

bool Console::cancelled() const { return stop_requested != 0; }

}  // namespace breccia::cli
