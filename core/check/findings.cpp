// SPDX-License-Identifier: BSD-3-Clause
#include "check/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace breccia {

void Trials::see(std::string_view check, const std::string& where, bool holds, const std::string& measured,
                 std::string_view mend, double badness) {
  if (user_.cancelled()) throw Cancelled();
  auto it = std::find_if(seen_.begin(), seen_.end(), [&](const Seen& s) { return s.check == check; });
  if (it == seen_.end()) it = seen_.insert(seen_.end(), {std::string(check), "", "", "", "", "", -1, 0, 0});
  ++it->cases;
  if (!holds) {
    if (it->failures++ > 0) return;
    it->failed = measured;
    it->failed_at = where;
    it->mend = mend;
  } else if (badness > it->badness) {
    it->badness = badness;
    it->worst = measured;
    it->worst_at = where;
  }
}

void Trials::skip(std::string_view check, const std::string& where, const std::string& why) {
  if (user_.cancelled()) throw Cancelled();
  auto it = std::find_if(skipped_.begin(), skipped_.end(),
                         [&](const Skipped& s) { return s.check == check && s.why == why; });
  if (it == skipped_.end()) it = skipped_.insert(skipped_.end(), {std::string(check), why, {}});
  if (!where.empty() && std::find(it->where.begin(), it->where.end(), where) == it->where.end())
    it->where.push_back(where);
}

CheckFindings Trials::findings() const {
  using Outcome = CheckFinding::Outcome;
  CheckFindings all;
  for (const Seen& s : seen_) {
    if (s.failures > 0)
      all.push_back({s.check, Outcome::fails,
                     fmt::format("{}: {}{}", s.failed_at, s.failed,
                                 s.failures > 1 ? fmt::format("; so in {} of {} cases", s.failures, s.cases) : ""),
                     s.mend});
    else if (s.cases > 1)
      all.push_back(
          {s.check, Outcome::holds,
           fmt::format("{} cases{}", s.cases, s.worst.empty() ? "" : fmt::format("; {}: {}", s.worst_at, s.worst)),
           ""});
    else all.push_back({s.check, Outcome::holds, s.worst.empty() ? s.worst_at : s.worst_at + ": " + s.worst, ""});
  }
  for (const Skipped& s : skipped_) {
    std::vector<std::string> first(s.where.begin(),
                                   s.where.begin() + std::ptrdiff_t(std::min<std::size_t>(3, s.where.size())));
    std::string where = fmt::format("{}", fmt::join(first, "; "));
    if (s.where.size() > first.size()) where += fmt::format(" and {} more", s.where.size() - first.size());
    all.push_back({s.check, Outcome::not_checked, where.empty() ? s.why : where + ": " + s.why, ""});
  }
  return all;
}

}  // namespace breccia
