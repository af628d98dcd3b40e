// SPDX-License-Identifier: BSD-3-Clause
/// Checks of the raw text, before any YAML is read: what the YAML library would misread in silence.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "config/yaml_tree.hpp"

namespace breccia {

constexpr std::size_t max_workflow_bytes = std::size_t(4) << 20;

/// A text with its lines, to turn byte offsets into places and to look again at what was written.
class SourceText {
 public:
  /// `origin` is the place of the first character.
  SourceText(std::string_view text, Place origin);
  std::string_view text() const { return text_; }
  /// Of the byte at `offset`.
  Place place(std::size_t offset) const;
  /// The line (0-based) without its end; empty past the last one.
  std::string_view line(std::size_t number) const;
  std::size_t line_of(std::size_t offset) const;
  std::size_t line_start(std::size_t number) const { return starts_[number]; }

 private:
  std::string_view text_;
  Place origin_;
  std::vector<std::size_t> starts_;
};

/// Size, encoding, control characters, tabs in the indentation. Adds at most a few findings; true when there was none.
bool check_text(const SourceText& source, std::vector<Finding>& findings);

}  // namespace breccia
