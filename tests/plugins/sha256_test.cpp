// SPDX-License-Identifier: BSD-3-Clause
/// Vectors of NIST (FIPS 180-2, appendix B, and the CAVP byte vectors), and lengths around the padding's edge.
#include "hash/sha256.hpp"

#include <gtest/gtest.h>

#include <set>

namespace breccia {

static std::string hash_of(const std::string& text) { return sha256(std::as_bytes(std::span(text))); }

TEST(Sha256, PublishedVectors) {
  EXPECT_EQ(hash_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash_of(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, EveryLengthAroundABlockDiffers) {
  std::set<std::string> seen;
  for (std::size_t n = 50; n < 135; ++n) EXPECT_TRUE(seen.insert(hash_of(std::string(n, '\0'))).second) << n;
}

TEST(Sha256, PieceByPieceIsTheWhole) {
  std::string text;
  for (int k = 0; k < 300; ++k) text += char(k * 7);
  for (std::size_t first = 0; first < 140; ++first)
    for (const std::size_t second :
         {std::size_t(0), std::size_t(1), std::size_t(63), std::size_t(64), std::size_t(130)}) {
      Sha256 hash;
      std::size_t at = 0;
      for (const std::size_t size : {first, second, text.size() - first - second}) {
        hash.add(std::as_bytes(std::span(text)).subspan(at, size));
        at += size;
      }
      EXPECT_EQ(hash.hex(), hash_of(text)) << first << ", " << second;
    }
}

}  // namespace breccia
