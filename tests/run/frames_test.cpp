// SPDX-License-Identifier: BSD-3-Clause
#include "run/frames.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace breccia {
namespace {

TEST(Frames, TheNextOneIsDueAtAMultipleOfTheInterval) {
  EXPECT_EQ(next_due(0, 0.5), 0.5);
  EXPECT_EQ(next_due(0.5, 0.5), 1);
  EXPECT_EQ(next_due(0.6, 0.5), 1);
  EXPECT_EQ(next_due(17.2, 0.5), 17.5);
  for (int k = 1; k < 1000; ++k) {  // rounding never makes it due twice, nor skips one
    const double next = next_due(k * 0.1, 0.1);
    EXPECT_GT(next, k * 0.1);
    EXPECT_LT(next, (k + 1.5) * 0.1);
  }
}

/// Counting up to 1 s would take longer than anyone waits, or for ever.
TEST(Frames, AnIntervalThatDoesNotMoveTheTimeIsDueAtEverySample) {
  EXPECT_EQ(next_due(1, 1e-18), 1);
  EXPECT_EQ(next_due(1, std::numeric_limits<double>::denorm_min()), 1);
  EXPECT_EQ(next_due(1, 0), 1);
  EXPECT_NEAR(next_due(1, 1e-15), 1, 1e-14);
}

TEST(Frames, AnEndlessIntervalIsNeverDueAgain) {
  EXPECT_EQ(next_due(1, std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace breccia
