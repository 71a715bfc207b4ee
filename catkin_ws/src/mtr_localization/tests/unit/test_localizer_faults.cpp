/// @file
/// Reaction to faults of sensor data.
// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "localizer_fixture.hpp"

namespace mtr_localization {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class LocalizerFaultTest : public LocalizerFixture {
 protected:
  void SetUp() override { ASSERT_TRUE(drive(0.0, 0.0, 2.0).valid); }

  void send_nothing_for(double linear_mps, double duration_s) {
    for (int step = 0; step < std::lround(duration_s / kStepS); ++step) {
      advance_truth(linear_mps, 0.0);
    }
  }
};

TEST_F(LocalizerFaultTest, GapWhileMovingLosesThePoseForGoodWithoutAJump) {
  const Estimate before = drive(0.5, 0.0, 2.0);
  send_nothing_for(0.5, 0.3);
  const Estimate after = drive(0.5, 0.0, 1.0);
  EXPECT_FALSE(after.valid);
  EXPECT_NE(after.message.text.find("Position lost: Wheel odometry was silent for 0.32 s."), std::string::npos)
      << after.message.text;
  EXPECT_EQ(after.x_m, before.x_m);
  EXPECT_FALSE(drive(0.0, 0.0, 5.0).valid);
}

TEST_F(LocalizerFaultTest, ShortGapIsBridged) {
  drive(0.5, 0.0, 2.0);
  send_nothing_for(0.5, 0.1);
  EXPECT_TRUE(drive(0.5, 0.0, 0.9).valid);
  EXPECT_NEAR(newest.x_m, 1.5, 1e-3);
}

TEST_F(LocalizerFaultTest, GapAtStandstillIsOverAfterAnotherStandstill) {
  const Estimate before = drive(0.5, 0.0, 1.0);
  drive(0.0, 0.0, 1.0);
  send_nothing_for(0.0, 3.0);
  EXPECT_FALSE(drive(0.0, 0.0, 0.1).valid);
  EXPECT_EQ(newest.message.text, "Wheel odometry was silent for 3.02 s.");
  EXPECT_TRUE(drive(0.0, 0.0, 2.0).valid);
  EXPECT_NEAR(newest.x_m, before.x_m, 1e-6);
}

TEST_F(LocalizerFaultTest, RobotMovedDuringAGapThatBeganAtStandstillIsLost) {
  drive(0.0, 0.0, 1.0);
  send_nothing_for(0.5, 1.0);
  EXPECT_FALSE(drive(0.0, 0.0, 3.0).valid);
  EXPECT_NE(newest.message.text.find("Position lost"), std::string::npos);
}

TEST_F(LocalizerFaultTest, RobotThatSetsOffBeforeAnInterruptionIsOverIsLost) {
  send_nothing_for(0.0, 1.0);
  drive(0.0, 0.0, 0.2);
  EXPECT_FALSE(drive(0.5, 0.0, 1.0).valid);
  EXPECT_NE(newest.message.text.find("Position lost"), std::string::npos);
}

TEST_F(LocalizerFaultTest, SilentImuIsReportedWhileOdometryGoesOn) {
  const int before = estimates_received;
  for (int step = 0; step < 20; ++step) {
    advance_truth(0.5, 0.0);
    send_wheels();
  }
  EXPECT_FALSE(newest.valid);
  EXPECT_EQ(newest.message.text, "The IMU is silent.");
  EXPECT_EQ(estimates_received - before, 9);
  EXPECT_FALSE(drive(0.5, 0.0, 1.0).valid);
  EXPECT_NE(newest.message.text.find("Position lost: The IMU was silent for 0.42 s."), std::string::npos)
      << newest.message.text;
}

TEST_F(LocalizerFaultTest, ImuRateThatIsNotANumberInvalidatesOnlyThatSample) {
  drive(0.5, 0.0, 1.0);
  advance_truth(0.5, 0.0);
  take(localizer.add_imu({wheels.stamp_ns, kNan}));
  send_wheels();
  EXPECT_FALSE(newest.valid);
  EXPECT_EQ(newest.message.text, "The IMU's readings are no numbers, or none that a robot's motion gives.");
  EXPECT_TRUE(drive(0.5, 0.0, 0.98).valid);
  EXPECT_NEAR(newest.x_m, 1.0, 1e-3);
}

TEST_F(LocalizerFaultTest, FiniteReadingsThatNoRobotGivesAreNoMotion) {
  drive(0.5, 0.0, 1.0);
  for (const ImuSample& wrong :
       {ImuSample{0, -686.73}, ImuSample{0, 0.0, {0.0, 40.0}}, ImuSample{0, 0.0, {0.0, 0.0}, {0.0, 0.0, 1e30}}}) {
    advance_truth(0.5, 0.0);
    ImuSample sample = wrong;
    sample.stamp_ns = wheels.stamp_ns;
    take(localizer.add_imu(sample));
    send_wheels();
    EXPECT_FALSE(newest.valid);
    EXPECT_EQ(newest.message.code, "localization.imu_not_a_number");
    EXPECT_TRUE(drive(0.5, 0.0, 0.1).valid);
    EXPECT_NEAR(newest.heading_rad, 0.0, 1e-3);
  }
}

TEST_F(LocalizerFaultTest, AnImuThatShowsNoTiltAndNoForceByNoNumbersIsGood) {
  drive(0.5, 0.0, 1.0);
  advance_truth(0.5, 0.0);
  take(localizer.add_imu({wheels.stamp_ns, 0.0, {kNan, kNan}, {kNan, kNan, kNan}}));
  send_wheels();
  EXPECT_TRUE(newest.valid);
}

TEST_F(LocalizerFaultTest, WheelSpeedsThatNoBaseHasInvalidateOnlyTheirSamples) {
  drive(0.5, 0.0, 1.0);
  for (const auto& [linear_mps, angular_radps] : {std::pair(500.0, 0.0), std::pair(0.5, -300.0)}) {
    advance_truth(0.5, 0.0);
    send_imu();
    WheelSample broken = wheels;
    broken.x_m = 870.0;
    broken.linear_mps = linear_mps;
    broken.angular_radps = angular_radps;
    take(localizer.add_wheels(broken));
    EXPECT_FALSE(newest.valid);
    EXPECT_EQ(newest.message.code, "localization.wheels_not_finite");
    EXPECT_TRUE(drive(0.5, 0.0, 0.98).valid);
  }
  EXPECT_NEAR(newest.x_m, 1.5, 1e-2);
}

TEST_F(LocalizerFaultTest, WheelOdometryThatIsNotANumberInvalidatesOnlyThatSample) {
  drive(0.5, 0.0, 1.0);
  advance_truth(0.5, 0.0);
  send_imu();
  WheelSample broken = wheels;
  broken.x_m = kNan;
  take(localizer.add_wheels(broken));
  EXPECT_FALSE(newest.valid);
  EXPECT_TRUE(std::isfinite(newest.x_m));
  EXPECT_TRUE(drive(0.5, 0.0, 0.98).valid);
  EXPECT_NEAR(newest.x_m, 1.0, 1e-3);
}

TEST_F(LocalizerFaultTest, WheelOdometryThatJumpsWhileMovingLosesThePose) {
  drive(0.5, 0.0, 1.0);
  wheels.x_m += 5.0;
  EXPECT_FALSE(drive(0.5, 0.0, 0.1).valid);
  EXPECT_NE(newest.message.text.find("jumped by 5.01 m"), std::string::npos) << newest.message.text;
  EXPECT_NEAR(newest.x_m, 0.5, 1e-3);
}

TEST_F(LocalizerFaultTest, WheelOdometryThatIsStampedLateOnABusyMachineIsNoJump) {
  drive(0.7, 0.0, 1.0);
  for (const std::int64_t late_ns : {15'000'000, -19'000'000}) {
    advance_truth(0.7, 0.0);
    wheels.stamp_ns += late_ns;
    send_imu();
    send_wheels();
  }
  EXPECT_TRUE(drive(0.7, 0.0, 0.5).valid) << newest.message.text;
  EXPECT_NEAR(newest.x_m, 0.7 * 1.54, 2e-3);
}

TEST_F(LocalizerFaultTest, OdometryThatIsSetBackByAFewCentimetresAtStandstillIsAJump) {
  drive(0.0, 0.0, 1.0);
  wheels.x_m += 0.08;
  EXPECT_FALSE(drive(0.0, 0.0, 0.1).valid);
}

TEST_F(LocalizerFaultTest, TimeThatGoesBackwardsWhileMovingLosesThePose) {
  drive(0.5, 0.0, 1.0);
  wheels.stamp_ns = 500'000'000;
  EXPECT_FALSE(drive(0.5, 0.0, 1.0).valid);
  EXPECT_NE(newest.message.text.find("went backwards"), std::string::npos) << newest.message.text;
  EXPECT_NEAR(newest.x_m, 0.5, 1e-3);
}

TEST_F(LocalizerFaultTest, RestartOfADriverAtStandstillKeepsThePose) {
  drive(0.5, 0.0, 1.0);
  drive(0.0, 0.0, 1.0);
  wheels.stamp_ns = 500'000'000;
  EXPECT_FALSE(drive(0.0, 0.0, 0.2).valid);
  EXPECT_TRUE(drive(0.0, 0.0, 2.0).valid);
  EXPECT_NEAR(newest.x_m, 0.5, 1e-3);
}

TEST_F(LocalizerFaultTest, SilentOdometryGivesInvalidEstimatesAtTheClocksSteps) {
  EXPECT_TRUE(localizer.check_silence(wheels.stamp_ns + 200'000'000).empty());
  const auto estimates = localizer.check_silence(wheels.stamp_ns + 220'000'000);
  ASSERT_EQ(estimates.size(), 1u);
  EXPECT_FALSE(estimates[0].valid);
  EXPECT_EQ(estimates[0].stamp_ns, wheels.stamp_ns + 220'000'000);
  EXPECT_NE(estimates[0].message.text, "");
}

TEST_F(LocalizerFaultTest, DataThatComesLateButCompleteIsCountedAndNotSentWithOldStamps) {
  const std::int64_t silent_until = wheels.stamp_ns + 300'000'000;
  ASSERT_EQ(localizer.check_silence(silent_until).size(), 1u);
  const int before = estimates_received;
  drive(0.5, 0.0, 0.4);
  EXPECT_EQ(estimates_received - before, 5);
  EXPECT_TRUE(newest.valid) << newest.message.text;
  EXPECT_NEAR(newest.x_m, 0.2, 1e-3);
}

TEST(LocalizerWithoutData, SaysThatItWaitsForWheelOdometry) {
  Localizer localizer{Parameters{}};
  EXPECT_EQ(localizer.check_silence(1'000'000'000).at(0).message.text, "Waiting for wheel odometry.");
}

TEST(LocalizerWithoutData, OdometryBeforeTheFirstImuSampleIsNotValid) {
  Localizer localizer{Parameters{}};
  localizer.add_wheels({1'000'000'000, 0.0, 0.0, 0.0, 0.0, 0.0});
  const auto estimates = localizer.add_imu({1'040'000'000, 0.0});
  ASSERT_EQ(estimates.size(), 1u);
  EXPECT_EQ(estimates[0].message.text, "Waiting for the IMU.");
}

}  // namespace
}  // namespace mtr_localization
