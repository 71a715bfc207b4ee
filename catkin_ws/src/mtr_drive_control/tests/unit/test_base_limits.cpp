/// @file
/// Permitted bases of a robot with a mast (A2).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "mtr_drive_control/base_limits.hpp"

namespace mtr_drive_control {
namespace {

constexpr BaseLimits kShipped{0.25, 2.5, 6.0};

std::string refusal(const BaseLimits& base) {
  try {
    check(base, Parameters{}, "/base");
  } catch (const mtr_core::ConfigurationError& error) {
    return error.what();
  }
  return "";
}

TEST(BaseLimits, ShippedOnesAreServed) { EXPECT_EQ(refusal(kShipped), ""); }

TEST(BaseLimits, BareJackalIsRefusedWithTheValueAndTheLimit) {
  EXPECT_EQ(refusal({0.25, 20.0, 25.0}),
            "Parameter /base/linear/x/max_acceleration is 20 m/s2; allowed is 2.48839 to 2.71022 m/s2.");
}

TEST(BaseLimits, BaseThatCannotFollowAnEmergencyStopIsRefused) {
  EXPECT_NE(refusal({0.25, 2.0, 6.0}).find("linear/x/max_acceleration is 2 m/s2"), std::string::npos);
  EXPECT_NE(refusal({0.25, 2.5, 4.0}).find("angular/z/max_acceleration is 4 rad/s2"), std::string::npos);
}

TEST(BaseLimits, TurnThatStopsTooHardIsRefused) {
  EXPECT_NE(refusal({0.25, 2.5, 25.0}).find("angular/z/max_acceleration is 25 rad/s2"), std::string::npos);
}

TEST(BaseLimits, BaseThatGoesOnWithoutCommandsIsRefused) {
  for (const double wrong : {0.0, 0.02, 0.5, 10.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(refusal({wrong, 2.5, 6.0}).find("/base/cmd_vel_timeout"), std::string::npos);
  }
}

TEST(BaseLimits, ChangedLimitIsNamedWithBothValues) {
  EXPECT_EQ(changed_limit(kShipped, kShipped, "/base"), "");
  EXPECT_EQ(changed_limit(kShipped, {0.25, 20.0, 6.0}, "/base"),
            "Parameter /base/linear/x/max_acceleration was 2.5 and is 20.");
  EXPECT_EQ(changed_limit(kShipped, {0.3, 2.5, 6.0}, "/base"), "Parameter /base/cmd_vel_timeout was 0.25 and is 0.3.");
  EXPECT_EQ(changed_limit(kShipped, {0.25, 2.5, 6.1}, "/base"),
            "Parameter /base/angular/z/max_acceleration was 6 and is 6.1.");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(changed_limit(kShipped, {nan, 2.5, 6.0}, "/base"), "");
  EXPECT_NE(changed_limit(kShipped, {0.25, nan, 6.0}, "/base"), "");
}

}  // namespace
}  // namespace mtr_drive_control
