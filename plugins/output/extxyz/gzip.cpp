// SPDX-License-Identifier: BSD-3-Clause
#include "gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "breccia/error.hpp"

namespace breccia {

std::string gzipped(std::string_view text) {
  z_stream z{};
  constexpr int largest_window = 15, with_header_of_gzip = 16, usual_memory = 8;
  if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, largest_window + with_header_of_gzip, usual_memory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string out, block(std::size_t(1) << 18, '\0');
  int end = Z_OK;
  for (std::size_t at = 0; end != Z_STREAM_END;) {
    // What zlib counts with may be shorter than a frame.
    const std::size_t some = std::min(text.size() - at, std::size_t(std::numeric_limits<int>::max()));
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data() + at));  // it only reads there
    z.avail_in = uInt(some);
    const bool last = at + some == text.size();
    do {
      z.next_out = reinterpret_cast<Bytef*>(block.data());
      z.avail_out = uInt(block.size());
      end = deflate(&z, last ? Z_FINISH : Z_NO_FLUSH);
      BRECCIA_ASSERT(end != Z_STREAM_ERROR);
      out.append(block.data(), block.size() - z.avail_out);
    } while (z.avail_out == 0);
    at += some;
  }
  deflateEnd(&z);
  return out;
}

}  // namespace breccia
