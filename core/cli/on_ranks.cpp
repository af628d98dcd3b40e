// SPDX-License-Identifier: BSD-3-Clause
#include "cli/on_ranks.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "breccia/utf8.hpp"
#include "cli/verbs.hpp"
#include "ranks/join_ranks.hpp"

namespace breccia::cli {
namespace {

int ended(RankLink& link, const std::string& text, int code) {
  const auto say = [&] {
    if (!text.empty()) std::fprintf(stderr, "%s\n", printable(text).c_str());
  };
  if (link.first()) say();
  if (link.all_end()) return code;
  if (!link.first()) say();
  std::fflush(stderr);
  link.abort(code);
  return code;
}

}  // namespace

int on_ranks(const std::function<int(RankLink*)>& verb) {
  const std::unique_ptr<RankLink> link = join_ranks();
  if (!link) return verb(nullptr);
  try {
    return verb(link.get());
  } catch (const Cancelled&) {
    return ended(*link, "breccia: stopped on request", interrupted);
  } catch (const UserError& e) { return ended(*link, e.what(), bad_input); } catch (const std::bad_alloc&) {
    return ended(*link, "breccia: there is not enough memory", failure);
  } catch (const std::exception& e) { return ended(*link, std::string("breccia: ") + e.what(), failure); }
}

int threads_of_rank(RankLink& link, int cores) {
  const long all = sysconf(_SC_NPROCESSORS_ONLN);
  return int(std::clamp<long>(all / link.ranks_on_machine(), 1, cores));
}

}  // namespace breccia::cli
