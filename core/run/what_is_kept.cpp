// SPDX-License-Identifier: BSD-3-Clause
#include "run/what_is_kept.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "archive/checkpoint_file.hpp"

namespace breccia {
namespace fs = std::filesystem;

namespace {

bool has_rows(const fs::path& table) {
  std::ifstream in(table);
  std::string header, row;
  return std::getline(in, header) && std::getline(in, row) && !row.empty();
}

}  // namespace

std::string what_is_kept(const fs::path& place, const fs::path& folder) {
  std::error_code none;
  std::string text;
  for (const char* name : {"curves.csv", "curves.csv.partial"})
    if (text.empty() && has_rows(place / name)) text = "what was measured until then is in " + (place / name).string();
  const auto checkpoints = checkpoints_in(place / "checkpoints");
  if (checkpoints.empty() && text.empty())
    return fs::exists(place / "curves.csv.partial", none) ? "no row of the curves is on the disk, and no checkpoint"
                                                          : "";
  if (checkpoints.empty()) return text + "; there is no checkpoint to go on from";
  std::string step = checkpoints.front().stem().string().substr(std::string("step_").size());
  step.erase(0, std::min(step.find_first_not_of('0'), step.size() - 1));
  return text + fmt::format("{}once the cause is mended, `breccia run --resume {}` goes on from step {}",
                            text.empty() ? "" : "; ", folder.string(), step);
}

}  // namespace breccia
