/// @file
/// Fixes of a satellite receiver: frame, and effect on the pose.
// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "gnss/gnss_frame.hpp"
#include "scene_drive.hpp"

namespace mtr_localization {
namespace {

constexpr double kLatitudeRad = 0.875;
constexpr double kLongitudeRad = 0.252;
// Pose of the scene in east and north.
const PoseVector kLevelFromScene(120.0, -40.0, 0.7);
const Eigen::Vector2d kAntenna(-0.18, 0.126);

/// Radii of curvature in m of WGS-84 at that latitude, by the formulae of Torge, Geodesy, 4.1.
constexpr double kMeridianM = 6'373'103.6;
constexpr double kTransverseM = 6'390'751.4;

GnssFix fix_at(const Eigen::Vector2d& level, double sigma_m, std::int64_t stamp_ns = 0) {
  return {stamp_ns, kLatitudeRad + level.y() / kMeridianM,
          kLongitudeRad + level.x() / (kTransverseM * std::cos(kLatitudeRad)), sigma_m, kAntenna};
}

/// Returns a frame learned on a circle of 4 m.
GnssFrame learned(double sigma_m, double radius_m = 4.0) {
  GnssFrame frame;
  for (int i = 0; i < 16; ++i) {
    const Eigen::Vector2d place(radius_m * std::cos(0.4 * i), radius_m * std::sin(0.4 * i));
    frame.learn(fix_at(transformed(kLevelFromScene, place), sigma_m), place);
  }
  return frame;
}

TEST(GnssFrame, FixesAreTurnedIntoMapToAMillimetrePerFiftyMetres) {
  const Eigen::Vector2d place(30.0, -40.0);
  const auto seen = learned(0.02).in_map(fix_at(transformed(kLevelFromScene, place), 0.02));
  ASSERT_TRUE(seen);
  EXPECT_LT((seen->position - place).norm(), 0.001);
}

TEST(GnssFrame, UncertaintyHoldsTheFramesToo) {
  const auto near = learned(0.02).in_map(fix_at(transformed(kLevelFromScene, {0.0, 0.0}), 0.02));
  const auto far = learned(0.02).in_map(fix_at(transformed(kLevelFromScene, {40.0, 0.0}), 0.02));
  ASSERT_TRUE(near && far);
  EXPECT_NEAR(near->sigma_m, 0.02 * M_SQRT2, 0.001);
  EXPECT_NEAR(far->sigma_m, std::hypot(0.02 * M_SQRT2, 0.2), 0.01);
}

TEST(GnssFrame, PathNotMuchWiderThanTheFixesErrorsGivesNoFrame) {
  EXPECT_FALSE(learned(1.5).in_map(fix_at({0.0, 0.0}, 1.5)));
  EXPECT_FALSE(GnssFrame().in_map(fix_at({0.0, 0.0}, 0.02)));
}

/// Robot with a map and a receiver that works from the start.
class GnssTest : public ::testing::Test {
 protected:
  void SetUp() override {
    // As SceneDrive::map(), with a receiver.
    drive(0.0, 0.0, 2.0);
    robot.order(1, MapOrder::Phase::kCollect);
    for (const double side_m : {5.6, 8.4, 5.6, 8.4}) {
      drive(0.6, 0.0, side_m / 0.6);
      drive(0.0, M_PI_2 / 2.0, 2.0);
    }
    drive(0.6, 0.0, 2.0);
    robot.order(1, MapOrder::Phase::kFreeze);
    drive(0.0, 0.0, 3.0);
    ASSERT_TRUE(robot.result && robot.result->map.valid);
  }

  void drive(double linear_mps, double angular_radps, double duration_s) {
    for (long tick = 0; tick < std::lround(duration_s / kTickS); ++tick) {
      robot.tick(linear_mps, angular_radps);
      if (receiver_works && tick % 5 == 0) {
        const Eigen::Vector2d antenna = transformed(robot.truth, kAntenna) + error;
        EXPECT_TRUE(robot.localizer().add_fix(fix_at(transformed(kLevelFromScene, antenna), sigma_m, robot.now_ns)));
      }
    }
  }

  /// Drives laps to remain in the scene, with many turns, in which wheels slip most.
  void go_on_for_long() {
    for (int lap = 0; lap < 150; ++lap) {
      drive(0.5, 0.0, 4.0);
      drive(0.0, M_PI / 2.0, 6.0);
    }
  }

  SceneDrive robot{scenes::lot(), Parameters{}};
  bool receiver_works = true;
  double sigma_m = 0.03;
  Eigen::Vector2d error = Eigen::Vector2d::Zero();
};

TEST_F(GnssTest, LidarsThatHoldThePoseAreNotCorrected) {
  error = {0.03, -0.03};
  drive(0.5, 0.0, 4.0);
  EXPECT_EQ(robot.localizer().figures().gnss.used, 0);
  EXPECT_LT(robot.position_error_m(), 0.02);
}

TEST_F(GnssTest, WithoutLidarsTheReceiverKeepsThePose) {
  robot.lidar_works = false;
  go_on_for_long();
  EXPECT_GT(robot.localizer().figures().gnss.used, 0);
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 3.0 * robot.position_sigma_m());
  EXPECT_LT(robot.position_sigma_m(), 0.15);
}

TEST_F(GnssTest, WithoutLidarsAReceiverThatIsAsideDoesNotVouchForThePose) {
  robot.lidar_works = false;
  error = {0.0, 0.5};
  drive(0.0, 0.0, 6.0);
  EXPECT_FALSE(robot.newest.valid);
}

TEST_F(GnssTest, WithoutLidarsAndReceiverItDrifts) {
  robot.lidar_works = receiver_works = false;
  go_on_for_long();
  EXPECT_GT(robot.position_sigma_m(), 0.3);
}

TEST_F(GnssTest, ManyFixesWithOneErrorMakeThePoseNoSurerThanOneFix) {
  robot.lidar_works = false;
  error = {0.03, 0.0};
  go_on_for_long();
  drive(0.0, 0.0, 60.0);
  EXPECT_GT(robot.localizer().figures().gnss.used, 0);
  EXPECT_GT(robot.position_sigma_m(), 0.8 * sigma_m * M_SQRT2);
}

TEST_F(GnssTest, ReceiverFarFromThePoseMeansThatItIsLost) {
  error = {0.0, 2.5};
  drive(0.0, 0.0, 1.0);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
  EXPECT_NE(robot.newest.message.text.find("by satellites the robot is 2.5 m from there"), std::string::npos)
      << robot.newest.message.text;
}

TEST_F(GnssTest, ShortReflectionsAndReceiversWithoutCorrectionsLoseNothing) {
  error = {0.0, 2.5};
  drive(0.0, 0.0, 0.3);
  error.setZero();
  drive(0.0, 0.0, 1.0);
  sigma_m = 2.0;
  error = {0.0, 4.0};
  drive(0.0, 0.0, 3.0);
  EXPECT_EQ(robot.lost_ticks, 0);
}

TEST(GnssInput, WhatIsNoPositionIsRefused) {
  Localizer localizer{Parameters{}};
  GnssFix good = fix_at({0.0, 0.0}, 1.0, 1'000'000'000);
  EXPECT_TRUE(localizer.add_fix(good));
  good.stamp_ns += 100'000'000;
  GnssFix bad = good;
  bad.latitude_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(localizer.add_fix(bad));
  bad = good;
  bad.sigma_m = 0.0;
  EXPECT_FALSE(localizer.add_fix(bad));
  bad.sigma_m = 7.0;
  EXPECT_FALSE(localizer.add_fix(bad));
  bad.sigma_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(localizer.add_fix(bad));
  bad = good;
  bad.stamp_ns -= 200'000'000;
  EXPECT_FALSE(localizer.add_fix(bad));
  EXPECT_EQ(localizer.figures().gnss.refused, 5);
}

}  // namespace
}  // namespace mtr_localization
