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
