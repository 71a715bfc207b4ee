/// @file
/// Base guard in front of a base that cannot be configured (A2).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mtr_drive_control/base_guard.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kPeriodS = 0.02;
constexpr std::int64_t kPeriodNs = 20'000'000;
constexpr BaseLimits kLimits{0.25, 3.0, 6.0};
constexpr Velocity kCruise{0.7, 0.3};

class BaseGuardTest : public ::testing::Test {
 protected:
  Velocity command(const Velocity& velocity, int steps = 50) {
    Velocity sent;
    for (int step = 0; step < steps; ++step) {
      guard.take(now_ns, velocity);
      sent = next();
    }
    return sent;
  }

  Velocity next() {
    now_ns += kPeriodNs;
    return guard.step(now_ns);
  }

  std::int64_t now_ns = 1'000'000'000'000;
  BaseGuard guard{kLimits, kPeriodS};
};

TEST_F(BaseGuardTest, WithoutACommandTheBaseStands) { EXPECT_TRUE(next().is_zero()); }

TEST_F(BaseGuardTest, CommandIsReachedNoFasterThanTheLimits) {
  Velocity before;
  for (int step = 0; step < 50; ++step) {
    const Velocity sent = command(kCruise, 1);
    EXPECT_LE(sent.linear_mps - before.linear_mps, 3.0 * kPeriodS + 1e-12);
    EXPECT_LE(sent.angular_radps - before.angular_radps, 6.0 * kPeriodS + 1e-12);
    before = sent;
  }
  EXPECT_DOUBLE_EQ(before.linear_mps, 0.7);
  EXPECT_DOUBLE_EQ(before.angular_radps, 0.3);
}

TEST_F(BaseGuardTest, SilentDriveControlIsBrakedForAtTheLimit) {
  double before_mps = command(kCruise).linear_mps;
  double stopped_s = 0.0;
  for (double time_s = kPeriodS; before_mps > 0.0; time_s += kPeriodS) {
    ASSERT_LT(time_s, 1.0);
    const double sent_mps = next().linear_mps;
    EXPECT_LE(before_mps - sent_mps, 3.0 * kPeriodS + 1e-12);
    before_mps = sent_mps;
    stopped_s = time_s;
  }
  EXPECT_LE(stopped_s, kLimits.command_timeout_s + 0.7 / 3.0 + 2.0 * kPeriodS);
}

TEST_F(BaseGuardTest, PauseInWhichTheBaseTimedOutIsFollowedByStandstillWhateverWaitedInTheQueue) {
  command(kCruise);
  now_ns += 300 * 1'000'000;
  guard.take(now_ns, kCruise);
  for (int step = 0; step < 4; ++step) {
    EXPECT_TRUE(next().is_zero());
  }
}

TEST_F(BaseGuardTest, ShortPauseIsFollowedByBrakingFromWhatWasSent) {
  command(kCruise);
  now_ns += 80 * 1'000'000;
  EXPECT_NEAR(next().linear_mps, 0.7 - 3.0 * kPeriodS, 1e-9);
}

TEST_F(BaseGuardTest, CommandsAreListenedToAgainAfterAPause) {
  command(kCruise);
  now_ns += 2'000'000'000;
  EXPECT_DOUBLE_EQ(command(kCruise).linear_mps, 0.7);
}

TEST_F(BaseGuardTest, CommandThatIsNoNumberIsNone) {
  command(kCruise);
  for (int step = 0; step < 100; ++step) {
    guard.take(now_ns, {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()});
    EXPECT_TRUE(next().is_finite());
  }
  EXPECT_TRUE(next().is_zero());
}

}  // namespace
}  // namespace mtr_drive_control
