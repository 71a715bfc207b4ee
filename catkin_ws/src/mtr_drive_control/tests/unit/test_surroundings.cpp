/// @file
/// Ground is remembered with the time of its observation, and discarded after a clock or odometry step (A10).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene.hpp"

namespace mtr_drive_control {
namespace {

constexpr std::int64_t kNowNs = 5'000 * kTestMs;
constexpr Point kAhead{1.5, 0.0};

class GroundThatWasSeen : public ::testing::Test {
 protected:
  /// Runs a tick after a sweep of both LiDARs, on open ground, with this time.
  void look(std::int64_t tick_ns, std::int64_t seen_ns) {
    const auto sweep = Scene().sweep(Pose(), seen_ns);
    surroundings.take(tick_ns, {sweep, sweep, Motion{tick_ns, Pose(), {}}});
  }

  Surroundings surroundings{CollisionParameters{}, test_shape(true)};
  std::int64_t runs = 0;
};

TEST_F(GroundThatWasSeen, IsFree) {
  look(kNowNs, kNowNs - kTestSweepNs);
  EXPECT_TRUE(surroundings.was_free(kAhead, 20.0));
}

TEST_F(GroundThatWasSeen, IsForgottenWhenTheClockGoesBack) {
  for (const std::int64_t step_ns : {50 * kTestMs, 1'000 * kTestMs, 4'000 * kTestMs}) {
    look(kNowNs, kNowNs - kTestSweepNs);
    surroundings.take(kNowNs - step_ns, {nullptr, nullptr, Motion{kNowNs - step_ns, Pose(), {}}});
    EXPECT_FALSE(surroundings.was_free(kAhead, 20.0));
  }
}

TEST_F(GroundThatWasSeen, InTheFutureIsNotRemembered) {
  look(kNowNs, kNowNs + 10'000 * kTestMs);
  EXPECT_TRUE(surroundings.blindness());
  EXPECT_FALSE(surroundings.was_free(kAhead, 20.0));
}

TEST_F(GroundThatWasSeen, TooLongAgoIsNotRemembered) {
  look(kNowNs, kNowNs - 1'000 * kTestMs);
  EXPECT_TRUE(surroundings.blindness());
  EXPECT_FALSE(surroundings.was_free(kAhead, 20.0));
}

/// The wheels' odometry resumes at a different pose after a pause.
TEST_F(GroundThatWasSeen, IsForgottenWhenTheOdometryBeginsAgain) {
  struct Step {
    std::int64_t pause_ns;
    Pose pose;
    bool is_forgotten;
  };
  for (const auto& [pause_ns, pose, is_forgotten] :
       {Step{20 * kTestMs, Pose(0.02, 0.0, 0.0), false}, Step{20 * kTestMs, Pose(3.0, 0.0, 0.0), true},
        Step{20 * kTestMs, Pose(0.0, -0.2, 0.0), true}, Step{20 * kTestMs, Pose(0.0, 0.0, 0.6), true},
        Step{180 * kTestMs, Pose(0.1, 0.0, 0.0), false}, Step{220 * kTestMs, Pose(0.1, 0.0, 0.0), true},
        Step{5'000 * kTestMs, Pose(), true}}) {
    surroundings.forget_ground();
    const std::int64_t now_ns = kNowNs + 1'000'000 * kTestMs * ++runs;
    look(now_ns, now_ns - kTestSweepNs);
    ASSERT_TRUE(surroundings.was_free(kAhead, 20.0));
    const std::int64_t later_ns = now_ns + pause_ns;
    surroundings.take(later_ns, {nullptr, nullptr, Motion{later_ns, pose, {}}});
    const Point ahead = pose.undo(kAhead);
    EXPECT_EQ(surroundings.was_free(ahead, 20.0), !is_forgotten) << pause_ns << " " << pose.position().x_m;
  }
}

}  // namespace
}  // namespace mtr_drive_control
