// SPDX-License-Identifier: BSD-3-Clause
/// Pieces of an HTML page. Whatever comes from files or names is a text until `escaped` has seen it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace breccia::report {

/// A text as it may stand between tags and in attributes: UTF-8, no control characters, nothing that is markup.
std::string escaped(std::string_view text);

/// A table with a caption that says what it is of, a header for each column, and the first cell of each row as the
/// header of the row. It scrolls by itself where the page is narrower than it.
class Table {
 public:
  enum class Is { text, number };
  explicit Table(std::string caption) : caption_(std::move(caption)) {}
  Table& column(std::string_view title, Is is = Is::text);
  /// Markup; one per column.
  void row(std::vector<std::string> cells) { rows_.push_back({std::move(cells), false}); }
  void foot(std::vector<std::string> cells) { rows_.push_back({std::move(cells), true}); }
  bool empty() const { return rows_.empty(); }
  std::string html() const;  ///< empty without rows

 private:
  struct Row {
    std::vector<std::string> cells;
    bool foot;
  };
  std::string caption_;
  std::vector<std::pair<std::string, Is>> columns_;
  std::vector<Row> rows_;
};

/// With a heading that can be jumped to; empty when `body` is.
std::string section(std::string_view id, std::string_view title, const std::string& body);
std::string paragraph(std::string_view text);
/// What is shown when asked for: closed on the screen, left out in print.
std::string foldable(std::string_view title, const std::string& body);

/// The whole page; it needs nothing but itself.
std::string page(std::string_view title, const std::string& body);

std::string base64(std::string_view bytes);

}  // namespace breccia::report
