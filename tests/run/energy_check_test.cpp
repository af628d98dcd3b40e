// SPDX-License-Identifier: BSD-3-Clause
#include "run/energy_check.hpp"

#include <gtest/gtest.h>

#include "breccia/error.hpp"

namespace breccia {
namespace {

struct Listener final : SilentHost {
  void warn(std::string_view text) override { warnings.emplace_back(text); }
  std::vector<std::string> warnings;
};

/// Work [J] of which a share went nowhere.
EnergyLedger lost(double work, double share) {
  EnergyLedger e;
  e.boundary_work = work;
  e.elastic = work * (1 - share);
  return e;
}

TEST(EnergyCheck, WarnsOnceFromItsShareOnAndEndsTheRunAboveTheLimit) {
  Listener host;
  EnergyCheck check({0.01, 0.10, 0}, "some_law");
  check.sample(lost(2, 0.009), 50, host);
  EXPECT_TRUE(host.warnings.empty());
  check.sample(lost(2, 0.011), 100, host);
  check.sample(lost(2, 0.095), 150, host);
  ASSERT_EQ(host.warnings.size(), 1u);
  EXPECT_NE(host.warnings[0].find("1.1 % of the work is unaccounted for at step 100"), std::string::npos)
      << host.warnings[0];
  EXPECT_NE(host.warnings[0].find("`some_law`"), std::string::npos);
  EXPECT_THROW(check.sample(lost(2, 0.105), 200, host), UserError);
  EXPECT_THROW(check.sample(lost(2, -0.12), 200, host), UserError) << "energy out of nothing is as wrong";
}

TEST(EnergyCheck, IsOfTheLargestEnergySoFar) {
  Listener host;
  EnergyCheck check({0.01, 0.10, 0}, "some_law");
  check.sample(lost(10, 0), 50, host);
  check.sample(lost(0.1, 0.5), 100, host);  // unloaded: 0.05 J of 10 J
  EXPECT_TRUE(host.warnings.empty());
}

TEST(EnergyCheck, BelowTheFloorNothingIsSaidBeforeTheEnd) {
  Listener host;
  EnergyCheck check({0.01, 0.10, 1000}, "some_law");
  check.sample(lost(1, 0.5), 50, host);
  EXPECT_TRUE(host.warnings.empty());
  check.finish(lost(1, 0.5), 60, host);
  ASSERT_EQ(host.warnings.size(), 1u);
  EXPECT_NE(host.warnings[0].find("at the end, step 60"), std::string::npos) << host.warnings[0];
}

}  // namespace
}  // namespace breccia
