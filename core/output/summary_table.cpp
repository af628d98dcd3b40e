// SPDX-License-Identifier: BSD-3-Clause
#include "output/summary_table.hpp"

#include "output/atomic_file.hpp"

namespace breccia {

void SummaryTable::set(const std::string& key, Json value, const std::string& owner) {
  const auto [it, is_new] = owner_.emplace(key, owner);
  if (!is_new)
    throw UserError("`" + it->second + "` and `" + owner + "` both report " + key + " in the summary: keep one of them in the workflow");
  json_[key] = std::move(value);
}

void SummaryTable::write(const std::filesystem::path& path) const { write_file(path, json_.dump(2) + "\n"); }

}  // namespace breccia
