// SPDX-License-Identifier: BSD-3-Clause
/// What holds for every text that Breccia reads, workflow or table, in the core or a plugin: UTF-8 with or without a
/// byte order mark, lines that end in \n, \r\n or \r, endings of names in upper or lower case.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "breccia/error.hpp"
#include "breccia/utf8.hpp"

namespace breccia {

/// Whether the name ends like that (".csv"), in upper or lower case.
inline bool has_ending(const std::filesystem::path& file, std::string_view ending) {
  const std::string own = file.extension().string();
  return std::equal(own.begin(), own.end(), ending.begin(), ending.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  });
}

/// The bytes of a file, of its beginning when it has more than `most`. UserError with the reason when there is no such
/// file, no permission, a folder in its place, or the disk fails.
inline std::string read_bytes(const std::filesystem::path& file,
                              std::size_t most = std::numeric_limits<std::size_t>::max()) {
  const auto fail = [&](int reason) {
    throw UserError("cannot read " + file.string() + ": " +
                    (reason == ENOENT || reason == ENOTDIR || reason == ENAMETOOLONG ? "no such file"
                     : reason == EACCES                                              ? "no permission"
                     : reason == EISDIR                                              ? "it is a folder"
                                                                                     : std::strerror(reason)));
  };
  struct Closed {
    int number;
    ~Closed() {
      if (number >= 0) close(number);
    }
  };
  const Closed in{open(file.c_str(), O_RDONLY | O_CLOEXEC)};
  if (in.number < 0) fail(errno);
  struct stat about;
  std::string bytes;
  if (fstat(in.number, &about) == 0 && S_ISREG(about.st_mode))
    bytes.reserve(std::min(most, std::size_t(std::max<off_t>(about.st_size, 0))));
  char piece[1 << 16];
  while (bytes.size() < most) {
    const ssize_t n = read(in.number, piece, std::min(sizeof piece, most - bytes.size()));
    if (n == 0) break;
    if (n > 0) bytes.append(piece, std::size_t(n));
    else if (errno != EINTR) fail(errno);
  }
  return bytes;
}

/// Why bytes are no text, and where.
struct TextFault {
  std::size_t at;  ///< offset of the byte
  std::string what;
};

/// The first byte that no text in UTF-8 has. Tabs and line ends are the only control characters of a text.
inline std::optional<TextFault> text_fault(std::string_view text) {
  using namespace std::string_view_literals;
  const auto zero = [&](std::size_t k) { return k < text.size() && text[k] == 0; };
  const auto mark = [&](std::string_view m) { return text.starts_with(m); };
  // The mark of UTF-32, least byte first, begins with that of UTF-16. Files without a mark are told by their zeros.
  const bool without_mark_32 =
      text.size() >= 4 && ((!zero(0) && zero(1) && zero(2) && zero(3)) || (zero(0) && zero(1) && zero(2) && !zero(3)));
  if (mark("\xFF\xFE\0\0"sv) || mark("\0\0\xFE\xFF"sv) || without_mark_32)
    return TextFault{0, "the file is UTF-32; save it as UTF-8"};
  const bool without_mark_16 = text.size() >= 4 && zero(0) != zero(1) && zero(0) == zero(2) && zero(1) == zero(3);
  if (mark("\xFF\xFE"sv) || mark("\xFE\xFF"sv) || without_mark_16)
    return TextFault{0, "the file is UTF-16; save it as UTF-8"};
  for (std::size_t at = 0; at < text.size();) {
    const unsigned char c = static_cast<unsigned char>(text[at]);
    if (c >= 0x20 && c < 0x7F) {
      ++at;
      continue;
    }
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) return TextFault{at, "the text is not UTF-8 here; save the file as UTF-8"};
    if (c == 0) return TextFault{at, "a zero byte: the file is not a text in UTF-8"};
    if (c < 0x20 && c != '\t' && c != '\n' && c != '\r')
      return TextFault{at, "a control character, which no text has; delete it"};
    at += length;
  }
  return {};
}

/// Without a byte order mark.
inline std::string_view without_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

/// Without a byte order mark, every line ended by \n alone.
inline std::string plain_lines(std::string_view text) {
  text = without_mark(text);
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '\r') out += text[at];
    else if (at + 1 == text.size() || text[at + 1] != '\n') out += '\n';
  }
  return out;
}

/// A text whose lines all end in \n. UserError as "file:line:column: what is wrong" when it is none.
inline std::string read_text_file(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file);
  if (const auto fault = text_fault(bytes)) {
    const std::string before = plain_lines(std::string_view(bytes).substr(0, fault->at));
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    const auto column = std::count_if(before.begin() + std::ptrdiff_t(line_start), before.end(),
                                      [](char c) { return !continues_character(c); });
    throw UserError(file.string() + ":" + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ":" +
                    std::to_string(column + 1) + ": " + fault->what);
  }
  return plain_lines(bytes);
}

}  // namespace breccia
