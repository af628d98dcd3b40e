// SPDX-License-Identifier: BSD-3-Clause
#include "report/html.hpp"

#include <cstdint>

#include "breccia/error.hpp"
#include "breccia/utf8.hpp"
#include "report/page_style.hpp"

namespace breccia::report {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : valid_utf8(text)) {
    const unsigned char code = static_cast<unsigned char>(c);
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '"') out += "&quot;";
    else if (c == '\'') out += "&#39;";
    else if ((code < 0x20 && c != '\n' && c != '\t') || code == 0x7F) out += "\xEF\xBF\xBD";
    else out += c;
  }
  return out;
}

Table& Table::column(std::string_view title, Is is) {
  columns_.emplace_back(title, is);
  return *this;
}

std::string Table::html() const {
  if (rows_.empty()) return {};
  const auto of_kind = [&](std::size_t c) { return columns_[c].second == Is::number ? " class=\"n\"" : ""; };
  // Whoever has no mouse scrolls it by the keyboard: it takes the focus, and says what it is.
  std::string out = std::string("<div class=\"scroll") + (rows_.size() <= 14 ? " short" : "") +
                    "\" tabindex=\"0\" role=\"region\" aria-label=\"" + escaped(caption_) + "\">\n<table>\n<caption>" +
                    escaped(caption_) + "</caption>\n<thead><tr>";
  for (std::size_t c = 0; c < columns_.size(); ++c)
    out += std::string("<th scope=\"col\"") + of_kind(c) + ">" + escaped(columns_[c].first) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  bool in_foot = false;
  for (const Row& row : rows_) {
    BRECCIA_ASSERT(row.cells.size() == columns_.size());
    if (row.foot && !in_foot) out += "</tbody>\n<tbody class=\"foot\">\n";
    in_foot = row.foot;
    out += "<tr>";
    for (std::size_t c = 0; c < row.cells.size(); ++c)
      out += (c == 0 ? "<th scope=\"row\"" : "<td") + std::string(of_kind(c)) + ">" + row.cells[c] +
             (c == 0 ? "</th>" : "</td>");
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n</div>\n";
}

std::string section(std::string_view id, std::string_view title, const std::string& body) {
  if (body.empty()) return {};
  const std::string name(id);
  return "<section aria-labelledby=\"" + name + "\">\n<h2 id=\"" + name + "\">" + escaped(title) + "</h2>\n" + body +
         "</section>\n";
}

std::string paragraph(std::string_view text) { return "<p>" + escaped(text) + "</p>\n"; }

std::string foldable(std::string_view title, const std::string& body) {
  if (body.empty()) return {};
  return "<details>\n<summary>" + escaped(title) + "</summary>\n" + body + "</details>\n";
}

std::string page(std::string_view title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n"
         // Belt and braces: even what would have slipped through `escaped` loads and runs nothing.
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
         "'unsafe-inline'\">\n<title>" +
         escaped(title) + "</title>\n<style>\n" + std::string(page_style) + "</style>\n</head>\n<body>\n" + body +
         "</body>\n</html>\n";
}

std::string base64(std::string_view bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) out += at + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return out;
}

}  // namespace breccia::report
