/// @file
/// Contents of the panel for each message.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "core/panel_content.hpp"
#include "core/rows.hpp"

namespace mtr_rviz {
namespace {

constexpr double kNowS = 100.0;

template <typename T>
Heard<T> now(const T& said) {
  return {said, kNowS};
}

PanelContent shown(const Robot& robot) { return content_of(robot, kNowS); }

Row mode_row(Mode mode) {
  Robot robot;
  robot.mode = now(ModeSaid{mode, false, ""});
  return shown(robot).state;
}

TEST(PanelContent, RobotThatWasNeverHeardIsUnknownInEveryLine) {
  const PanelContent content = shown(Robot{});
  EXPECT_EQ(content.state.level, Level::kUnknown);
  EXPECT_EQ(content.state.text, "Never heard.");
  EXPECT_EQ(content.checks.size(), 8u);
  for (const Row& row : content.checks) {
    EXPECT_EQ(row.level, Level::kUnknown) << row.name;
  }
  EXPECT_TRUE(content.reasons.empty());
  EXPECT_FALSE(content.can_inject);
}

TEST(PanelContent, EachModeHasItsWords) {
  EXPECT_EQ(mode_row(Mode::kStarting).text, "Starting");
  EXPECT_EQ(mode_row(Mode::kReadyToMapCar).text, "Ready to map the Car");
  EXPECT_EQ(mode_row(Mode::kMappingCar).text, "Maps the Car");
  EXPECT_EQ(mode_row(Mode::kFollowingWaypoint).level, Level::kGood);
  EXPECT_EQ(mode_row(Mode::kCheckingCar).level, Level::kGood);
  EXPECT_EQ(mode_row(Mode::kFault).level, Level::kBad);
  EXPECT_EQ(mode_row(Mode::kUnknown).level, Level::kUnknown);
}

TEST(PanelContent, HeldRobotIsNotShownAsGood) {
  Robot robot;
  robot.mode = now(ModeSaid{Mode::kFollowingWaypoint, true, "Driven by hand."});
  EXPECT_EQ(shown(robot).state.level, Level::kNote);
  EXPECT_EQ(shown(robot).reasons, std::vector<std::string>{"Driven by hand."});
}

TEST(PanelContent, StateMachineThatFellSilentSaysNothingOfNow) {
  Robot robot;
  robot.mode = {ModeSaid{Mode::kFault, false, "The IMU is silent."}, kNowS - 3.0};
  EXPECT_EQ(shown(robot).state.level, Level::kUnknown);
  EXPECT_EQ(shown(robot).state.text, "Silent for 3 s.");
  EXPECT_TRUE(shown(robot).reasons.empty());
}

TEST(PanelContent, ReasonThatTwoNodesGiveStandsOnce) {
  Robot robot;
  robot.mode = now(ModeSaid{Mode::kFault, false, "The IMU is silent."});
  robot.drive = now(DriveSaid{"locked", 0.0, DriveSaid::Zone::kClear, NAN, "The IMU is silent."});
  robot.motion = now(MotionSaid{MotionSaid::Result::kBlocked, 1.0, "A person is in the way."});
  EXPECT_EQ(shown(robot).reasons, (std::vector<std::string>{"The IMU is silent.", "A person is in the way."}));
}

TEST(PanelContent, PlannerOnItsWayGivesNoReason) {
  Robot robot;
  robot.motion = now(MotionSaid{MotionSaid::Result::kPending, 1.0, "Under way."});
  EXPECT_TRUE(shown(robot).reasons.empty());
}

TEST(PanelContent, LocksAreReasonsWhileTheyAreEngagedOrSilent) {
  Robot robot;
  robot.locks["a"] = now(LockSaid{false, ""});
  robot.locks["b"] = now(LockSaid{true, "Stopped by the Operator."});
  robot.locks["c"] = now(LockSaid{true, ""});
  robot.locks["d"] = {LockSaid{false, ""}, kNowS - 2.0};
  EXPECT_EQ(shown(robot).reasons,
            (std::vector<std::string>{"Stopped by the Operator.", "The motion lock of c is engaged.",
                                      "The motion lock of d: Silent for 2 s."}));
}

TEST(PanelContent, FaultsAreShownWhereTheyCanBeInjected) {
  Robot robot;
  robot.faults = std::vector<std::string>{};
  EXPECT_TRUE(shown(robot).can_inject);
  robot.faults = std::vector<std::string>{"imu: stuck, for another 2 s."};
  EXPECT_EQ(shown(robot).faults, *robot.faults);
}

TEST(Rows, NodeThatFellSilentIsBadAndOneThatNeverSpokeUnknown) {
  EXPECT_EQ(pose_row({PoseSaid{true, 0.01, ""}, kNowS - 90.0}, kNowS).text, "Silent for 2 min.");
  EXPECT_EQ(pose_row({PoseSaid{true, 0.01, ""}, kNowS - 90.0}, kNowS).level, Level::kBad);
  EXPECT_EQ(pose_row({}, kNowS).level, Level::kUnknown);
}

TEST(Rows, PoseTellsItsSigmaOrWhatIsWrong) {
  EXPECT_EQ(pose_row(now(PoseSaid{true, 0.0123, ""}), kNowS).text, "Within 12 mm (1 sigma).");
  const Row lost = pose_row(now(PoseSaid{false, 0.0, "Lost."}), kNowS);
  EXPECT_EQ(lost.level, Level::kBad);
  EXPECT_EQ(lost.text, "Lost.");
}

TEST(Rows, CarTellsItsSizeOnceItIsLocated) {
  using State = CarSaid::State;
  EXPECT_EQ(car_row(now(CarSaid{State::kLocated, 4.5, 1.8, ""}), kNowS).text, "4.50 m by 1.80 m.");
  EXPECT_EQ(car_row(now(CarSaid{State::kCollecting, 0.0, 0.0, ""}), kNowS).level, Level::kNote);
  EXPECT_EQ(car_row(now(CarSaid{State::kFailed, 0.0, 0.0, "No Car."}), kNowS).level, Level::kBad);
  EXPECT_EQ(car_row(now(CarSaid{State::kUnknown, 0.0, 0.0, ""}), kNowS).text, "Not mapped yet.");
}

TEST(Rows, SelfCheckTellsItsDifference) {
  using State = SelfCheckSaid::State;
  EXPECT_EQ(self_check_row(now(SelfCheckSaid{State::kPassed, 0.004, 0.03, ""}), kNowS).text, "4 mm of 30 mm allowed.");
  EXPECT_EQ(self_check_row(now(SelfCheckSaid{State::kFailed, 0.2, 0.03, "Moved."}), kNowS).text, "Moved.");
  EXPECT_EQ(self_check_row(now(SelfCheckSaid{State::kFailed, NAN, 0.03, ""}), kNowS).text, "Failed.");
  EXPECT_EQ(self_check_row(now(SelfCheckSaid{}), kNowS).level, Level::kUnknown);
}

TEST(Rows, WheelsAreGoodOnlyWithNothingInTheWay) {
  using Zone = DriveSaid::Zone;
  const Row clear = drive_row(now(DriveSaid{"planner", 0.3, Zone::kClear, NAN, ""}), kNowS);
  EXPECT_EQ(clear.level, Level::kGood);
  EXPECT_EQ(clear.text, "planner, 0.30 m/s.");
  const Row slowed = drive_row(now(DriveSaid{"planner", 0.1, Zone::kSlowed, 0.8, ""}), kNowS);
  EXPECT_EQ(slowed.level, Level::kNote);
  EXPECT_EQ(slowed.text, "planner, 0.10 m/s. Something 0.80 m away.");
  EXPECT_EQ(drive_row(now(DriveSaid{"locked", 0.0, Zone::kBlind, NAN, "Blind."}), kNowS).level, Level::kBad);
  EXPECT_EQ(drive_row(now(DriveSaid{"locked", 0.0, Zone::kClear, NAN, "Locked."}), kNowS).level, Level::kNote);
}

TEST(Rows, PlannerTellsWhatBecameOfItsGoal) {
  using Result = MotionSaid::Result;
  EXPECT_EQ(motion_row(now(MotionSaid{Result::kPending, 2.34, ""}), kNowS).text, "2.3 m to go.");
  EXPECT_EQ(motion_row(now(MotionSaid{Result::kRefused, 0.0, "Too near."}), kNowS).level, Level::kBad);
  EXPECT_EQ(motion_row(now(MotionSaid{Result::kBlocked, 0.0, ""}), kNowS).level, Level::kNote);
  EXPECT_EQ(motion_row(now(MotionSaid{}), kNowS).text, "No goal.");
}

TEST(Rows, SilentFirmwareIsBadThoughItsNodeSpeaks) {
  EXPECT_EQ(parts_row(now(PartsSaid{false, 0.0, NAN, ""}), kNowS).text, "The firmware is silent.");
  EXPECT_EQ(parts_row(now(PartsSaid{true, 1.0, 0.5, ""}), kNowS).text, "Key at 1.00 m.");
  EXPECT_EQ(parts_row(now(PartsSaid{true, 1.0, 0.5, "Slow."}), kNowS).level, Level::kNote);
}

TEST(Rows, BatteryHasTheLimitsOfTheApplication) {
  EXPECT_EQ(battery_row(now(PartsSaid{true, 1.0, 0.8, ""}), kNowS).text, "80 %.");
  EXPECT_EQ(battery_row(now(PartsSaid{true, 1.0, 0.2, ""}), kNowS).level, Level::kNote);
  EXPECT_EQ(battery_row(now(PartsSaid{true, 1.0, 0.05, ""}), kNowS).level, Level::kBad);
  EXPECT_EQ(battery_row(now(PartsSaid{true, 1.0, NAN, ""}), kNowS).level, Level::kUnknown);
}

TEST(Rows, PreflightIsTheLastOneWithItsAge) {
  EXPECT_EQ(preflight_row(std::nullopt).level, Level::kUnknown);
  EXPECT_EQ(preflight_row(Preflight{12, 0, 180.0, ""}).text, "12 of 12 right, 3 min ago.");
  EXPECT_EQ(preflight_row(Preflight{12, 0, 13.0 * 3600.0, ""}).level, Level::kNote);
  const Row wrong = preflight_row(Preflight{12, 1, 40.0, "disk: Full."});
  EXPECT_EQ(wrong.level, Level::kBad);
  EXPECT_EQ(wrong.text, "1 of 12 wrong, 40 s ago. disk: Full.");
}

TEST(Rows, SignsTellLevelsApartWithoutColours) {
  EXPECT_NE(sign_of(Level::kGood), sign_of(Level::kBad));
  EXPECT_NE(sign_of(Level::kNote), sign_of(Level::kUnknown));
}

}  // namespace
}  // namespace mtr_rviz
