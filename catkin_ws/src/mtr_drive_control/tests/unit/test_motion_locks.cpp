/// @file
/// Locks, their owners and their silence.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mtr_drive_control/motion_locks.hpp"

namespace mtr_drive_control {
namespace {

constexpr std::int64_t kMs = mtr_core::kMillisecondNs;

MotionLocks locks_of(const std::vector<std::string>& owners) { return MotionLocks(owners, 0.35, std::nullopt); }

TEST(MotionLocks, RequiredOwnerNeverHeardIsEngaged) {
  MotionLocks locks = locks_of({"dispatcher"});
  const auto engaged = locks.engaged_at(1000 * kMs);
  ASSERT_EQ(engaged.size(), 1u);
  EXPECT_EQ(engaged[0].owner, "dispatcher");
  EXPECT_EQ(engaged[0].reason.text, "Waiting for the motion lock of dispatcher.");
}

TEST(MotionLocks, ReleasedOwnerDoesNotForbidMotion) {
  MotionLocks locks = locks_of({"dispatcher"});
  locks.take("dispatcher", {1000 * kMs, false, {}});
  EXPECT_TRUE(locks.engaged_at(1100 * kMs).empty());
}

TEST(MotionLocks, EngagedOwnerForbidsMotionWithItsReason) {
  MotionLocks locks = locks_of({"dispatcher"});
  locks.take("dispatcher", {1000 * kMs, true, mtr_core::problem_with_text("The Operator pressed stop.")});
  EXPECT_EQ(locks.engaged_at(1020 * kMs).at(0).reason.text, "The Operator pressed stop.");
}

TEST(MotionLocks, OwnerSilentForMoreThanTheTimeoutIsEngaged) {
  MotionLocks locks = locks_of({"dispatcher"});
  locks.take("dispatcher", {1000 * kMs, false, {}});
  EXPECT_TRUE(locks.engaged_at(1350 * kMs).empty());
  EXPECT_EQ(locks.engaged_at(1360 * kMs).at(0).reason.text, "The motion lock of dispatcher is silent.");
}

TEST(MotionLocks, OnlyTheFirstEngagedWordEngages) {
  MotionLocks locks = locks_of({"dispatcher"});
  EXPECT_FALSE(locks.take("dispatcher", {1000 * kMs, false, {}}));
  EXPECT_TRUE(locks.take("dispatcher", {1100 * kMs, true, mtr_core::problem_with_text("Stop.")}));
  EXPECT_FALSE(locks.take("dispatcher", {1200 * kMs, true, mtr_core::problem_with_text("Stop.")}));
  EXPECT_FALSE(locks.take("dispatcher", {1300 * kMs, false, {}}));
  EXPECT_TRUE(locks.take("dispatcher", {1400 * kMs, true, mtr_core::problem_with_text("Stop.")}));
}

TEST(MotionLocks, ContactThatBouncesEngagesOncePerPeriod) {
  MotionLocks locks = locks_of({"dispatcher", "/e_stop"});
  int steps = 0;
  for (int edge = 0; edge < 20; ++edge) {
    steps += locks.take("/e_stop", {(1000 + edge) * kMs, edge % 2 == 0, {}, true});
  }
  EXPECT_EQ(steps, 1);
  EXPECT_FALSE(locks.take("dispatcher", {1019 * kMs, true, {}, true}));
  EXPECT_FALSE(locks.engaged_at(1020 * kMs).empty());
  locks.take("dispatcher", {1040 * kMs, false, {}});
  EXPECT_TRUE(locks.take("dispatcher", {1045 * kMs, true, {}, true}));
}

TEST(MotionLocks, AgeIsThatOfTheOwnerHeardLongestAgo) {
  MotionLocks locks = locks_of({"dispatcher", "state_machine"});
  locks.take("dispatcher", {1000 * kMs, false, {}});
  locks.take("state_machine", {1060 * kMs, false, {}});
  locks.engaged_at(1080 * kMs);
  EXPECT_NEAR(locks.age_s(), 0.08, 1e-9);
}

TEST(MotionLocks, StampFarInTheFutureIsEngaged) {
  MotionLocks locks = locks_of({"dispatcher"});
  locks.take("dispatcher", {9000 * kMs, false, {}});
  EXPECT_EQ(locks.engaged_at(1000 * kMs).size(), 1u);
}

TEST(MotionLocks, OwnerBeyondTheRequiredOnesIsObeyedAndThenWatched) {
  MotionLocks locks = locks_of({});
  EXPECT_TRUE(locks.engaged_at(1000 * kMs).empty());
  locks.take("visitor", {1000 * kMs, true, mtr_core::problem_with_text("Someone is near.")});
  EXPECT_EQ(locks.engaged_at(1020 * kMs).at(0).owner, "visitor");
  locks.take("visitor", {1100 * kMs, false, {}});
  EXPECT_TRUE(locks.engaged_at(1120 * kMs).empty());
  EXPECT_EQ(locks.engaged_at(1600 * kMs).size(), 1u);
}

class EmergencyStop : public ::testing::Test {
 protected:
  /// Takes a message each 40 ms; returns true if the robot may move after the last one.
  bool may_move_after(std::int64_t duration_ms, bool engaged) {
    for (const std::int64_t end_ms = now_ms + duration_ms; now_ms < end_ms; now_ms += 40) {
      locks.take("controller_input", {now_ms * kMs, engaged, mtr_core::problem_with_text("Pressed."), true});
    }
    return locks.engaged_at(now_ms * kMs).empty();
  }

  std::int64_t now_ms = 1000;
  MotionLocks locks = locks_of({"controller_input"});
};

TEST_F(EmergencyStop, IsReleasedByItsOwner) {
  EXPECT_FALSE(may_move_after(400, true));
  EXPECT_TRUE(may_move_after(40, false));
}

// A4
TEST_F(EmergencyStop, OfAnOwnerThatRestartsAndSaysNothingOfItStaysEngaged) {
  may_move_after(400, true);
  now_ms += 2000;
  EXPECT_FALSE(may_move_after(10000, false));
  EXPECT_EQ(locks.engaged_at(now_ms * kMs).at(0).reason.code, "drive_control.emergency_not_released");
}

// A4
TEST_F(EmergencyStop, OfAnOwnerThatRestartedIsReleasedAfterItWasEngagedAnew) {
  may_move_after(400, true);
  now_ms += 2000;
  may_move_after(400, false);
  EXPECT_FALSE(may_move_after(400, true));
  EXPECT_TRUE(may_move_after(40, false));
}

TEST_F(EmergencyStop, ThatWasReleasedBeforeItsOwnerRestartedIsForgotten) {
  may_move_after(400, true);
  may_move_after(400, false);
  now_ms += 2000;
  EXPECT_TRUE(may_move_after(40, false));
}

TEST(MotionLocks, LockThatIsNoEmergencyStopIsReleasedByItsOwnersNextWord) {
  MotionLocks locks = locks_of({"dispatcher"});
  locks.take("dispatcher", {1000 * kMs, true, mtr_core::problem_with_text("Stop.")});
  locks.take("dispatcher", {5000 * kMs, false, {}});
  EXPECT_TRUE(locks.engaged_at(5020 * kMs).empty());
}

// A4
TEST(MotionLocks, RequiredEmergencyStopThatWasNeverHeardIsEngaged) {
  EXPECT_EQ(locks_of({"controller_input"}).engaged_at(1000 * kMs).size(), 1u);
}

TEST(MotionLocks, InLockStepTheLockOfTheOwnersLastTickIsWaitedFor) {
  MotionLocks* target = nullptr;
  int waits = 0;
  const mtr_core::Waiting waiting{
      [&](double) {
        ++waits;
        target->take("state_machine", {2020 * kMs, true, mtr_core::problem_with_text("Fault.")});
        return true;
      },
      [] { return 0.0; }};
  MotionLocks locks({"state_machine"}, 0.35, waiting);
  target = &locks;
  locks.take("state_machine", {1920 * kMs, false, {}});
  EXPECT_TRUE(locks.engaged_at(2020 * kMs).empty());
  EXPECT_EQ(waits, 0);
  EXPECT_EQ(locks.engaged_at(2040 * kMs).at(0).reason.text, "Fault.");
  EXPECT_EQ(waits, 1);
}

}  // namespace
}  // namespace mtr_drive_control
