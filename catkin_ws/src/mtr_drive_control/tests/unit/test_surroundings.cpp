/// @file
/// Ground is remembered as of the time at which it was seen, and that of another time is forgotten (A10).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene.hpp"

namespace mtr_drive_control {
namespace {

constexpr std::int64_t kNowNs = 5'000 * kTestMs;
constexpr Point kAhead{1.5, 0.0};

class GroundThatWasSeen : public ::testing::Test {
 protected:
  /// A tick at which front and rear LiDAR, on open ground, have just spoken of this time.
  void look(std::int64_t tick_ns, std::int64_t seen_ns) {
    const auto sweep = Scene().sweep(Pose(), seen_ns);
    surroundings.take(tick_ns, {sweep, sweep, Motion{tick_ns, Pose(), {}}});
  }

  Surroundings surroundings{CollisionParameters{}, test_shape(true)};
};

TEST_F(GroundThatWasSeen, IsFree) {
  look(kNowNs, kNowNs - kTestSweepNs);
  EXPECT_TRUE(surroundings.was_free(kAhead));
}

TEST_F(GroundThatWasSeen, IsForgottenWhenTheClockGoesBack) {
  for (const std::int64_t step_ns : {50 * kTestMs, 1'000 * kTestMs, 4'000 * kTestMs}) {
    look(kNowNs, kNowNs - kTestSweepNs);
    surroundings.take(kNowNs - step_ns, {nullptr, nullptr, Motion{kNowNs - step_ns, Pose(), {}}});
    EXPECT_FALSE(surroundings.was_free(kAhead));
  }
}

TEST_F(GroundThatWasSeen, InTheFutureIsNotRemembered) {
  look(kNowNs, kNowNs + 10'000 * kTestMs);
  EXPECT_TRUE(surroundings.blindness());
  EXPECT_FALSE(surroundings.was_free(kAhead));
}

TEST_F(GroundThatWasSeen, TooLongAgoIsNotRemembered) {
  look(kNowNs, kNowNs - 1'000 * kTestMs);
  EXPECT_TRUE(surroundings.blindness());
  EXPECT_FALSE(surroundings.was_free(kAhead));
}

}  // namespace
}  // namespace mtr_drive_control
