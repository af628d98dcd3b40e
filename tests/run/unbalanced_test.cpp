// SPDX-License-Identifier: BSD-3-Clause
// Which rows tell whether a test is quasi-static.
#include <gtest/gtest.h>

#include "run/checks.hpp"

namespace breccia {
namespace {

TEST(UnbalancedOnTheRise, IsTheLargestBetweenTenAndNinetyPercentOfThePeak) {
  const std::vector<LoadedRow> rows{{5, 0.9}, {11, 0.2}, {40, 0.5}, {60, 0.3}, {89, 0.4}, {91, 0.8}, {100, 0.7}};
  EXPECT_EQ(unbalanced_on_the_rise(rows, 100), 0.5);
  EXPECT_EQ(unbalanced_on_the_rise({}, 100), 0);
}

TEST(UnbalancedOnTheRise, WhatADropSetsFreeDoesNotCount) {
  // Some bonds fail at 74 % of the peak; the specimen goes on to carry more.
  const std::vector<LoadedRow> rows{{20, 0.01}, {74, 0.08}, {66, 0.20}, {62, 0.22}, {64, 0.15}, {73, 0.03}, {88, 0.02}};
  EXPECT_EQ(unbalanced_on_the_rise(rows, 100), 0.08);
}

TEST(UnbalancedOnTheRise, ALoadThatWavesStillRises) {
  const std::vector<LoadedRow> rows{{20, 0.1}, {40, 0.3}, {39.5, 0.6}, {50, 0.2}};
  EXPECT_EQ(unbalanced_on_the_rise(rows, 100), 0.6);
}

}  // namespace
}  // namespace breccia
