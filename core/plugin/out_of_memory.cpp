// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/out_of_memory.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <tuple>

namespace breccia {
namespace {

std::atomic<std::size_t> particles_now{0}, bonds_now{0};

struct Use {
  double total = 0, data = 0;  // of the address space [bytes]
};

Use in_use() {
  char text[256] = {};
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return {};
  const ssize_t got = read(file, text, sizeof text - 1);
  close(file);
  unsigned long total = 0, data = 0;
  if (got <= 0 || std::sscanf(text, "%lu %*u %*u %*u %*u %lu", &total, &data) != 2) return {};
  const double page = double(sysconf(_SC_PAGESIZE));
  return {double(total) * page, double(data) * page};
}

struct Limit {
  double may = 0, has = 0;  // [bytes]
  const char* set_by = nullptr;
};

/// The one that leaves least; without any, that of the machine.
Limit limit_now() {
  const Use use = in_use();
  Limit found;
  for (const auto& [resource, has, name] :
       {std::tuple{RLIMIT_DATA, use.data, "ulimit -d"}, {RLIMIT_AS, use.total, "ulimit -v"}}) {
    rlimit set{};
    if (getrlimit(resource, &set) != 0 || set.rlim_cur == RLIM_INFINITY) continue;
    if (!found.set_by || double(set.rlim_cur) - has < found.may - found.has) found = {double(set.rlim_cur), has, name};
  }
  if (!found.set_by) found = {double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)), use.data, nullptr};
  return found;
}

/// Without memory from the heap.
void write_text(char* to, std::size_t size) {
  const Limit limit = limit_now();
  const double unit = 1e6;
  int n = std::snprintf(to, size, "there is not enough memory: the program had %.0f MB of the %.0f MB that ",
                        limit.has / unit, limit.may / unit);
  const auto more = [&](const char* format, auto... values) {
    if (n >= 0 && std::size_t(n) < size) n += std::snprintf(to + n, size - std::size_t(n), format, values...);
  };
  if (limit.set_by) more("it may have (%s)", limit.set_by);
  else more("%s", "this machine has");
  if (particles_now > 0) more(", for %zu particles and %zu bonds", particles_now.load(), bonds_now.load());
}

std::terminate_handler before = nullptr;

[[noreturn]] void end_with(const char* advice) {
  static char text[512];
  write_text(text, sizeof text);
  for (const char* part : {"breccia: ", static_cast<const char*>(text), advice, "\n"})
    (void)!write(STDERR_FILENO, part, __builtin_strlen(part));
  _exit(1);
}

bool can_be_had(std::size_t bytes) {
  void* volatile memory = std::malloc(bytes);
  std::free(memory);
  return memory != nullptr;
}

[[noreturn]] void at_the_end() {
  const auto e = std::current_exception();
  // Without memory for an exception the C++ library ends the program without one.
  bool memory = !e && !can_be_had(std::size_t(1) << 20);
  try {
    if (e) std::rethrow_exception(e);
  } catch (const std::bad_alloc&) { memory = true; } catch (...) {
  }
  if (memory)
    end_with(
        "; it came where nothing could be brought to an order. What the run had written stays in its folder: `breccia "
        "run --resume FOLDER` goes on from the newest checkpoint there");
  if (before) before();
  std::abort();
}

/// Less than that the libraries themselves do not survive, each in a way of its own [bytes].
constexpr std::size_t least = std::size_t(8) << 20;

}  // namespace

void memory_is_for(std::size_t particles, std::size_t bonds) {
  particles_now = particles;
  bonds_now = bonds;
}

std::string out_of_memory() {
  char text[512];
  write_text(text, sizeof text);
  return text;
}

void end_plainly_without_memory() {
  if (!can_be_had(least)) end_with("; it needs some 12 MB to begin");
  before = std::set_terminate(at_the_end);
}

}  // namespace breccia
