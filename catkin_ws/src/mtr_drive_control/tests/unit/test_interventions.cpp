/// @file
/// Events that count as interventions, and their number.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mtr_drive_control/interventions.hpp"

namespace mtr_drive_control {
namespace {

Decision decision_of(const std::string& source, double linear_mps, Zone zone = Zone::kClear) {
  Decision decision;
  decision.source = source;
  decision.velocity.linear_mps = linear_mps;
  decision.zone = zone;
  return decision;
}

Decision locked(bool is_unordered) {
  Decision decision = decision_of("locked", 0.0);
  decision.is_unordered_lock = is_unordered;
  return decision;
}

class Counting : public ::testing::Test {
 protected:
  Interventions after(const std::vector<Decision>& decisions) {
    Interventions counted;
    for (const Decision& decision : decisions) {
      counted = counter.count(decision);
    }
    return counted;
  }

  const Decision driving = decision_of("planner", 0.5);
  InterventionCounter counter;
};

TEST_F(Counting, UndisturbedDriveCountsNothing) {
  const Interventions counted = after({decision_of("none", 0.0), driving, decision_of("planner", 0.3, Zone::kSlowed),
                                       driving, decision_of("none", 0.1), decision_of("none", 0.0)});
  EXPECT_EQ(counted.manual_drives + counted.blockages + counted.lock_stops, 0u);
}

TEST_F(Counting, ManualDriveCountsOnceEachTimeItBegins) {
  const Decision manual = decision_of("manual", 0.2);
  EXPECT_EQ(after({driving, manual, manual, driving, manual}).manual_drives, 2u);
}

TEST_F(Counting, BlockageCountsOnceWhileItLasts) {
  const Decision blocked = decision_of("planner", 0.0, Zone::kBlocked);
  const Decision blind = decision_of("planner", 0.0, Zone::kBlind);
  EXPECT_EQ(after({driving, blocked, blocked, blind, driving, blind}).blockages, 2u);
}

TEST_F(Counting, BlindnessOfARobotThatNobodyWantsToMoveIsNoBlockage) {
  EXPECT_EQ(after({decision_of("none", 0.0, Zone::kBlind), locked(true)}).blockages, 0u);
}

TEST_F(Counting, LockCountsWhenItEndsAMotion) {
  EXPECT_EQ(after({driving, locked(true), locked(true)}).lock_stops, 1u);
}

TEST_F(Counting, LockAtRestIsNoStop) { EXPECT_EQ(after({decision_of("none", 0.0), locked(true)}).lock_stops, 0u); }

TEST_F(Counting, StopThatTheOperatorOrdersIsNoIntervention) {
  EXPECT_EQ(after({driving, locked(false), locked(false)}).lock_stops, 0u);
}

}  // namespace
}  // namespace mtr_drive_control
