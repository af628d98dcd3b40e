// SPDX-License-Identifier: BSD-3-Clause
#include "archive/checkpoint_digest.hpp"

#include <fstream>
#include <numeric>

namespace breccia::checkpoint {

std::optional<std::string> own_digests(const std::filesystem::path& file, std::size_t bytes, RankLink* link) {
  const std::size_t behind = bytes - std::min(bytes, header_size);
  const ListShare share = Slabs(blocks_of(behind), link ? link->ranks() : 1).of(link ? link->rank() : 0);
  std::ifstream in(file, std::ios::binary);
  in.seekg(std::streamoff(header_size + share.first * block));
  std::string digests, text;
  for (std::size_t b = share.first; b < share.first + share.rows; ++b) {
    text.resize(std::min(block, behind - b * block));
    if (!in.read(text.data(), std::streamsize(text.size()))) return {};
    digests += sha256(text);
  }
  return digests;
}

std::string of_all(const std::string& own, RankLink& link, bool everywhere) {
  const auto sizes = link.numbers_of_all(own.size() / digest_size);
  std::string all;
  if (everywhere || link.first()) all.resize(std::accumulate(sizes.begin(), sizes.end(), std::size_t(0)) * digest_size);
  link.gather(own.data(), sizes, digest_size, all.data(), everywhere);
  return all;
}

}  // namespace breccia::checkpoint
