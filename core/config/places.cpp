// SPDX-License-Identifier: BSD-3-Clause
#include "config/places.hpp"

#include "config/reader.hpp"
#include "config/section_reader.hpp"

namespace breccia {

std::string Places::with_place(const std::string& path, const std::string& text) const {
  if (!tree_) return text;
  std::vector<Problem> problems = problems_of({{place_of(*tree_, path, tree_->place), "", text}}, files_);
  return problems.front().str();
}

}  // namespace breccia
