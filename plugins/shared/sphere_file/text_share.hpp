// SPDX-License-Identifier: BSD-3-Clause
/// Of a text that several ranks read together the lines of one of them.
#pragma once

#include <fstream>

#include "breccia/packing.hpp"
#include "breccia/text_file.hpp"

namespace breccia::sphere_file {

struct TextShare {
  std::string text;        ///< whole lines, each ended by \n alone
  std::size_t before = 0;  ///< lines of the shares before
};

namespace detail {

/// Where the first line begins that does so at `from` or behind it: behind the first end of a line from the byte before
/// on.
inline std::size_t line_from(std::ifstream& in, std::size_t from, std::size_t size) {
  if (from == 0) return 0;
  in.clear();
  in.seekg(std::streamoff(from - 1));
  for (std::size_t at = from; at <= size; ++at) {
    const int c = in.get();
    if (c == '\n') return at;
    if (c == '\r') return at + (in.peek() == '\n');
    if (c == std::char_traits<char>::eof()) break;
  }
  return size;
}

}  // namespace detail

/// Each has those that begin within as many bytes of the file as the others have. UserError as of `read_text_file`.
inline TextShare read_text_share(const std::filesystem::path& file, const PackingRequest& request) {
  if (!request.share.part) return {read_text_file(file)};
  (void)read_bytes(file, 1);  // its words for a file that is not there or may not be read
  std::error_code unknown;
  const auto size = std::filesystem::file_size(file, unknown);
  const OwnRows own = request.share_of(unknown ? 0 : std::size_t(size));
  std::ifstream in(file, std::ios::binary);
  const std::size_t begin = detail::line_from(in, own.first(), size), end = detail::line_from(in, own.behind(), size);
  std::string bytes(end - begin, '\0');
  in.clear();
  in.seekg(std::streamoff(begin));
  if (!in.read(bytes.data(), std::streamsize(bytes.size()))) throw UserError("cannot read " + file.string());
  if (text_fault(bytes)) (void)read_text_file(file);  // which says where
  TextShare share{plain_lines(bytes)};
  const std::vector lines{std::size_t(std::count(share.text.begin(), share.text.end(), '\n'))};
  const std::vector<std::size_t> of_all = request.share.all(lines);
  for (std::size_t r = 0; r < std::size_t(request.share.part->number); ++r) share.before += of_all[r];
  return share;
}

/// What one share has found is told to all: the text of the first that has one, and the number of that share.
inline std::string told_by_first(const SeenInPart& share, const std::string& own, std::size_t& teller) {
  const std::vector<std::size_t> sizes = share.all(std::vector{own.size()});
  teller = 0;
  while (teller < sizes.size() && sizes[teller] == 0) ++teller;
  const bool tells = !share.part || std::size_t(share.part->number) == teller;
  const std::vector<char> text = share.all(tells ? std::vector<char>(own.begin(), own.end()) : std::vector<char>());
  return {text.begin(), text.end()};
}

}  // namespace breccia::sphere_file
