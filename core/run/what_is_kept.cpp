// SPDX-License-Identifier: BSD-3-Clause
#include "run/what_is_kept.hpp"

#include <fmt/format.h>

#include "archive/checkpoint_file.hpp"

namespace breccia {
namespace fs = std::filesystem;

std::string what_is_kept(const fs::path& place, const fs::path& folder) {
  std::error_code none;
  std::string text;
  for (const char* name : {"curves.csv", "curves.csv.partial"})
    if (const auto size = fs::file_size(place / name, none); text.empty() && !none && size > 0)
      text = "what was measured until then is in " + (place / name).string();
  const bool begun = fs::exists(place / "curves.csv.partial", none);
  if (text.empty() && begun) text = "nothing of what was measured could be written";
  const auto checkpoints = checkpoints_in(place / "checkpoints");
  if (checkpoints.empty()) return text.empty() ? text : text + "; there is no checkpoint to go on from";
  std::string step = checkpoints.front().stem().string().substr(std::string("step_").size());
  step.erase(0, std::min(step.find_first_not_of('0'), step.size() - 1));
  return text + fmt::format("{}once the cause is mended, `breccia run --resume {}` goes on from step {}",
                            text.empty() ? "" : "; ", folder.string(), step);
}

}  // namespace breccia
