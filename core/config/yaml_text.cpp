// SPDX-License-Identifier: BSD-3-Clause
#include "config/yaml_text.hpp"

#include <algorithm>

#include "breccia/text_file.hpp"

namespace breccia {

namespace {

bool check_indentation(const SourceText& source, std::vector<Finding>& findings) {
  const std::size_t lines = source.line_of(source.text().size()) + 1;
  for (std::size_t k = 0; k < lines; ++k) {
    const std::string_view line = source.line(k);
    const std::size_t first = line.find_first_not_of(" \t");
    const std::size_t tab = line.substr(0, first).find('\t');
    if (first == std::string_view::npos || line[first] == '#' || tab == std::string_view::npos) continue;
    findings.push_back({source.place(source.line_start(k) + tab), "", "a tab in the indentation; YAML wants spaces"});
    return false;
  }
  return true;
}

}  // namespace

SourceText::SourceText(std::string_view text, Place origin) : text_(text), origin_(origin), starts_{0} {
  for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
    starts_.push_back(at + 1);
}

std::size_t SourceText::line_of(std::size_t offset) const {
  return std::size_t(std::upper_bound(starts_.begin(), starts_.end(), offset) - starts_.begin()) - 1;
}

std::string_view SourceText::line(std::size_t number) const {
  if (number >= starts_.size()) return {};
  const std::size_t from = starts_[number], end = number + 1 < starts_.size() ? starts_[number + 1] - 1 : text_.size();
  std::string_view line = text_.substr(from, end - from);
  return line;
}

Place SourceText::place(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const std::size_t number = line_of(offset);
  int characters = 0;
  for (std::size_t k = starts_[number]; k < offset; ++k) characters += continues_character(text_[k]) ? 0 : 1;
  Place place = origin_;
  place.line += int(number);
  place.column = (number == 0 ? origin_.column : 1) + characters;
  return place;
}

bool check_text(const SourceText& source, std::vector<Finding>& findings) {
  if (source.text().size() > max_workflow_bytes) {
    findings.push_back({source.place(0), "",
                        "the file has more than 4 MiB, which no workflow needs; particles and curves "
                        "belong in files of their own"});
    return false;
  }
  if (const auto fault = text_fault(source.text())) {
    findings.push_back({source.place(fault->at), "", fault->what});
    return false;
  }
  return check_indentation(source, findings);
}

}  // namespace breccia
