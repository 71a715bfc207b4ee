/// @file
/// Priority of the sources, and the reaction to their faults.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mtr_drive_control/tip_over.hpp"
#include "scene.hpp"

namespace mtr_drive_control {
namespace {

constexpr std::int64_t kMs = mtr_core::kMillisecondNs;
constexpr std::int64_t kTickNs = 5000 * kMs;
const ImuReading kLevel{kTickNs, {}, {0.0, 0.0, 9.81}};

class DriveControlTest : public ::testing::Test {
 protected:
  static SourceCommand command(double linear_mps, bool active = true, std::int64_t stamp_ns = kTickNs - 20 * kMs) {
    return {stamp_ns, {linear_mps, 0.0}, active};
  }

  /// Step on open ground with a live front LiDAR and a low key.
  Decision step(const std::vector<EngagedLock>& locks, const std::optional<SourceCommand>& manual,
                const std::optional<SourceCommand>& planner) {
    const auto sweep = Scene().sweep(Pose(), kTickNs - 40 * kMs);
    const Motion motion{kTickNs, Pose(), sent};
    const Decision decision = control.step(
        kTickNs, {locks, 0.0, manual, planner, {sweep, nullptr, motion}, KeyHeight{kTickNs, 0.35}, kLevel});
    sent = decision.velocity;
    return decision;
  }

  Decision drive_at_full_speed() {
    Decision decision;
    for (int tick = 0; tick < 100; ++tick) {
      decision = step({}, std::nullopt, command(1.5));
    }
    return decision;
  }

  /// Velocity of the wheels, which follow the commands.
  Velocity sent;
  const Parameters limits = limits_at(Parameters{}, 0.35);
  DriveControl control{Parameters{}, CollisionParameters{}, test_shape(false), 0.02};
};

TEST_F(DriveControlTest, PlannerDrivesWhenNothingElseWantsTo) {
  const Decision decision = step({}, std::nullopt, command(0.5));
  EXPECT_EQ(decision.source, "planner");
  EXPECT_GT(decision.velocity.linear_mps, 0.0);
  EXPECT_EQ(decision.message.text, "");
}

TEST_F(DriveControlTest, ManualControllerTakesPrecedenceOverThePlanner) {
  const Decision decision = step({}, command(-0.5), command(0.5));
  EXPECT_EQ(decision.source, "manual");
  EXPECT_LT(decision.velocity.linear_mps, 0.0);
}

TEST_F(DriveControlTest, InactiveManualControllerLeavesTheFloorToThePlanner) {
  EXPECT_EQ(step({}, command(-0.5, false), command(0.5)).source, "planner");
}

TEST_F(DriveControlTest, ManualControllerSilentWhileDrivingStopsTheRobotAndKeepsThePlannerOut) {
  const Decision decision = step({}, command(0.5, true, kTickNs - 160 * kMs), command(0.5));
  EXPECT_EQ(decision.source, "none");
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
  EXPECT_EQ(decision.message.text, "The manual controller is silent.");
}

TEST_F(DriveControlTest, LockStopsEverySourceAndIsNamed) {
  const Decision decision =
      step({{"dispatcher", mtr_core::problem_with_text("The link is silent.")}}, command(0.5), command(0.5));
  EXPECT_EQ(decision.source, "locked");
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
  EXPECT_EQ(decision.engaged_locks, std::vector<std::string>{"dispatcher"});
  EXPECT_EQ(decision.message.text, "The link is silent.");
}

TEST_F(DriveControlTest, LockAtFullSpeedIsZeroAfterHalfASecond) {
  ASSERT_DOUBLE_EQ(drive_at_full_speed().velocity.linear_mps, limits.max_linear_mps);
  Decision decision;
  for (int tick = 0; tick < 25; ++tick) {
    decision = step({{"dispatcher", mtr_core::problem_with_text("Stop.")}}, std::nullopt, command(1.5));
  }
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
}

TEST_F(DriveControlTest, ReleasedStopRampsFromStandstillWhateverTheHardwareDidToTheWheels) {
  for (const bool hardware_stops : {true, false}) {
    drive_at_full_speed();
    for (int tick = 0; tick < 200; ++tick) {
      const Decision decision =
          step({{"/base_stop", mtr_core::problem_with_text("Stop.")}}, std::nullopt, command(1.5));
      sent = hardware_stops ? Velocity{} : decision.velocity;
      EXPECT_TRUE(tick < 25 || decision.velocity.is_zero());
    }
    double before_mps = 0.0;
    for (int tick = 0; tick < 100; ++tick) {
      const double now_mps = step({}, std::nullopt, command(1.5)).velocity.linear_mps;
      EXPECT_LE(now_mps - before_mps, limits.linear_acceleration_mps2 * 0.02 + 1e-9) << tick;
      before_mps = now_mps;
    }
    EXPECT_GT(before_mps, 0.5);
  }
}

TEST_F(DriveControlTest, LateLockSlowsTheRobotBeforeItCountsAsSilentAndItStandsHalfASecondAfterTheLastWord) {
  double speed_mps = drive_at_full_speed().velocity.linear_mps;
  const auto sweep = Scene().sweep(Pose(), kTickNs - 40 * kMs);
  for (double age_s = 0.12; age_s < 0.5; age_s += 0.02) {
    const Motion motion{kTickNs, Pose(), sent};
    sent =
        control
            .step(kTickNs,
                  {{}, age_s, std::nullopt, command(1.5), {sweep, nullptr, motion}, KeyHeight{kTickNs, 0.35}, kLevel})
            .velocity;
    EXPECT_LE(age_s + sent.linear_mps / limits.emergency_linear_deceleration_mps2, kStandstillWithinS + 1e-9);
    EXPECT_LE(speed_mps - sent.linear_mps, 1.01 * limits.emergency_linear_deceleration_mps2 * 0.02);
    speed_mps = sent.linear_mps;
  }
  EXPECT_EQ(speed_mps, 0.0);
}

TEST_F(DriveControlTest, SilentPlannerIsAnEmergencyStop) {
  drive_at_full_speed();
  const Decision decision = step({}, std::nullopt, command(1.5, true, kTickNs - 160 * kMs));
  EXPECT_EQ(decision.source, "none");
  EXPECT_NEAR(decision.velocity.linear_mps, limits.max_linear_mps - limits.emergency_linear_deceleration_mps2 * 0.02,
              1e-9);
  EXPECT_EQ(decision.message.text, "The motion planner is silent.");
}

TEST_F(DriveControlTest, PlannerWithoutADesiredVelocityIsBrakedForAtTheNormalLimit) {
  drive_at_full_speed();
  const Decision decision = step({}, std::nullopt, command(1.5, false));
  EXPECT_EQ(decision.source, "none");
  EXPECT_NEAR(decision.velocity.linear_mps, limits.max_linear_mps - 1.5 * 0.02, 1e-9);
  EXPECT_EQ(decision.message.text, "");
}

TEST_F(DriveControlTest, NoPlannerYetStandsStillAndSaysSo) {
  const Decision decision = step({}, std::nullopt, std::nullopt);
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
  EXPECT_EQ(decision.message.text, "Waiting for the motion planner.");
}

TEST_F(DriveControlTest, DesiredVelocityThatIsNotAFiniteNumberStopsTheRobotWithAMessage) {
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Decision decision = step({}, std::nullopt, command(wrong));
    EXPECT_EQ(decision.velocity.linear_mps, 0.0);
    EXPECT_NE(decision.message.text, "");
  }
}

TEST_F(DriveControlTest, UnknownKeyHeightLowersTheSpeedToThatOfTheRaisedKey) {
  Decision decision;
  for (int tick = 0; tick < 100; ++tick) {
    const auto sweep = Scene().sweep(Pose(), kTickNs - 40 * kMs);
    decision = control.step(
        kTickNs,
        {{}, 0.0, std::nullopt, command(1.5), {sweep, nullptr, Motion{kTickNs, Pose(), sent}}, std::nullopt, kLevel});
    sent = decision.velocity;
  }
  EXPECT_DOUBLE_EQ(decision.velocity.linear_mps, limits_at(Parameters{}, 1.55).max_linear_mps);
  EXPECT_LT(decision.velocity.linear_mps, limits.max_linear_mps);
}

TEST_F(DriveControlTest, WrongParameterIsRefusedAtConstruction) {
  Parameters parameters;
  parameters.max_linear_mps = -1.0;
  EXPECT_THROW(DriveControl(parameters, CollisionParameters{}, test_shape(false), 0.02), mtr_core::ConfigurationError);
}

}  // namespace
}  // namespace mtr_drive_control
