/// @file
/// Start-up, time alignment of sensors, and dead reckoning.
// SPDX-License-Identifier: Apache-2.0
#include "localizer_fixture.hpp"

namespace mtr_localization {
namespace {

using LocalizerTest = LocalizerFixture;

TEST_F(LocalizerTest, PoseIsNotValidBeforeTheBiasIsKnownAndSaysWhy) {
  const Estimate estimate = drive(0.0, 0.0, 1.4);
  EXPECT_FALSE(estimate.valid);
  EXPECT_EQ(estimate.message.text, "Stand still: measuring the gyro's bias.");
}

TEST_F(LocalizerTest, OneSecondOfStandstillAfterSettlingMakesThePoseValidAtTheOrigin) {
  const Estimate estimate = drive(0.0, 0.0, 1.54);
  EXPECT_TRUE(estimate.valid) << estimate.message.text;
  EXPECT_EQ(estimate.message.text, "");
  EXPECT_EQ(estimate.x_m, 0.0);
  EXPECT_EQ(estimate.heading_rad, 0.0);
}

TEST_F(LocalizerTest, GyroBiasLargerThanTheStandstillRateIsLearntAtTheStart) {
  gyro_bias_radps = -0.08;
  EXPECT_TRUE(drive(0.0, 0.0, 2.0).valid);
  EXPECT_NEAR(localizer.filter().gyro_bias_radps(), -0.08, 1e-3);
}

TEST_F(LocalizerTest, RobotThatIsPushedAtTheStartBecomesValidAfterItRests) {
  EXPECT_FALSE(drive(0.3, 0.0, 3.0).valid);
  EXPECT_TRUE(drive(0.0, 0.0, 1.6).valid);
}

TEST_F(LocalizerTest, SquareOfFourMetresEndsWhereItBegan) {
  drive(0.0, 0.0, 5.0);
  for (int side = 0; side < 4; ++side) {
    drive(0.5, 0.0, 2.0);
    drive(0.0, M_PI_2, 1.0);
  }
  EXPECT_NEAR(newest.x_m, 0.0, 0.02);
  EXPECT_NEAR(newest.y_m, 0.0, 0.02);
  EXPECT_NEAR(newest.heading_rad, 0.0, 0.01);
}

TEST_F(LocalizerTest, BackwardDriveIsNegative) {
  drive(0.0, 0.0, 3.0);
  const Estimate estimate = drive(-0.5, 0.0, 2.0);
  EXPECT_NEAR(estimate.x_m, -1.0, 1e-3);
  EXPECT_NEAR(estimate.speed_mps, -0.5, 1e-9);
}

TEST_F(LocalizerTest, HeadingFollowsTheGyroAndNotTheSlippingWheels) {
  drive(0.0, 0.0, 3.0);
  for (int step = 0; step < 50; ++step) {
    advance_truth(0.0, 1.5);
    take(localizer.add_imu({wheels.stamp_ns, 1.0 + gyro_bias_radps}));
    send_wheels();
  }
  EXPECT_NEAR(newest.heading_rad, 1.0, 0.02);
  EXPECT_NEAR(newest.yaw_rate_radps, 1.0, 1e-3);
}

TEST_F(LocalizerTest, OrderOfArrivalDoesNotMatter) {
  drive(0.0, 0.0, 2.0);
  Localizer other{Parameters{}};
  WheelSample still{1'000'000'000, 0.0, 0.0, 0.0, 0.0, 0.0};
  Estimate other_newest;
  for (int step = 0; step < 100; ++step) {
    still.stamp_ns += kStepNs;
    EXPECT_TRUE(other.add_wheels(still).empty());
    other_newest = other.add_imu({still.stamp_ns, gyro_bias_radps}).at(0);
  }
  EXPECT_EQ(other_newest.stamp_ns, newest.stamp_ns);
  EXPECT_EQ(other_newest.covariance, newest.covariance);
  EXPECT_EQ(other_newest.valid, newest.valid);
}

TEST_F(LocalizerTest, ImuAheadOfTheWheelsDoesNotChangeTheEstimate) {
  Localizer other{Parameters{}};
  std::vector<WheelSample> sent;
  for (int step = 0; step < 120; ++step) {
    step_once(0.0, 0.0);
    sent.push_back(wheels);
    other.add_imu({wheels.stamp_ns, gyro_bias_radps});
  }
  Estimate other_newest;
  for (const WheelSample& sample : sent) {
    other_newest = other.add_wheels(sample).at(0);
  }
  EXPECT_EQ(other_newest.covariance, newest.covariance);
}

TEST_F(LocalizerTest, StampsThatDifferAreJoined) {
  for (int step = 0; step < 200; ++step) {
    advance_truth(step < 100 ? 0.0 : 0.5, 0.0);
    send_wheels();
    take(localizer.add_imu({wheels.stamp_ns + 7'000'000, gyro_bias_radps}));
  }
  EXPECT_TRUE(newest.valid) << newest.message.text;
  EXPECT_EQ(newest.stamp_ns, wheels.stamp_ns);
  EXPECT_NEAR(newest.x_m, 1.0, 1e-3);
}

TEST_F(LocalizerTest, EachWheelSampleGetsOneEstimate) {
  drive(0.0, 0.0, 2.0);
  EXPECT_EQ(estimates_received, 100);
}

TEST_F(LocalizerTest, BiasThatDriftsIsFollowedAtStandstill) {
  drive(0.0, 0.0, 10.0);
  for (int step = 0; step < 3000; ++step) {
    gyro_bias_radps += 1e-7;
    step_once(0.0, 0.0);
  }
  EXPECT_NEAR(localizer.filter().gyro_bias_radps(), gyro_bias_radps, 1.5e-4);
  EXPECT_EQ(newest.heading_rad, 0.0);
}

}  // namespace
}  // namespace mtr_localization
