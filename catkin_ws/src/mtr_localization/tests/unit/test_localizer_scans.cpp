/// @file
/// Mapping and localization with scans of synthetic scenes.
// SPDX-License-Identifier: Apache-2.0
#include "external_pose.hpp"
#include "scene_drive.hpp"

namespace mtr_localization {
namespace {

TEST(LocalizerScans, WayRoundTheCarGivesAMapAndAPoseToACentimetre) {
  SceneDrive robot(scenes::lot(), Parameters{});
  const MapResult result = robot.map(7);
  ASSERT_TRUE(result.map.valid) << result.map.message.text;
  EXPECT_EQ(result.map_car_id, 7u);
  EXPECT_EQ(result.revision, 1u);
  for (int leg = 0; leg < 4; ++leg) {
    robot.drive(-0.5, 0.1, 3.0);
    EXPECT_LT(robot.position_error_m(), 0.02);
    robot.drive(0.5, -0.1, 3.0);
    EXPECT_LT(robot.position_error_m(), 0.02);
  }
  robot.drive(0.0, 0.0, 1.0);
  EXPECT_LT(robot.position_error_m(), 0.012);
  EXPECT_LT(std::abs(robot.error().z()), 0.003);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLocalized);
  EXPECT_EQ(robot.newest.map_revision, 1u);
  EXPECT_FALSE(robot.newest.degenerate);
  EXPECT_TRUE(robot.newest.valid);
}

TEST(LocalizerScans, ErrorsAgreeWithTheCovarianceOverManyDrives) {
  double squares = 0.0;
  int samples = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SceneDrive robot(seed % 2 ? scenes::lot() : scenes::open(), Parameters{}, seed);
    ASSERT_TRUE(robot.map().map.valid);
    for (int leg = 0; leg < 3; ++leg) {
      robot.drive(-0.5, 0.1, 2.0);
      const Eigen::Matrix2d covariance =
          Eigen::Map<const Eigen::Matrix3d>(robot.newest.covariance.data()).topLeftCorner<2, 2>();
      const Eigen::Vector2d error = robot.error().head<2>();
      squares += error.dot(covariance.inverse() * error) / 2.0;
      ++samples;
    }
  }
  // The map of each drive is one sample: 8 maps, 16 degrees of freedom, 95 % of chi squared per degree: 0.43 to 1.80.
  // The error may be smaller, because the adjustment includes uneven ground, which is not simulated here.
  EXPECT_LT(squares / samples, 1.8);
  EXPECT_GT(squares / samples, 0.05);
}

TEST(LocalizerScans, ConstantRangeErrorCostsMillimetres) {
  SceneDrive robot(scenes::lot(), Parameters{});
  robot.range_bias_m = 0.02;
  ASSERT_TRUE(robot.map().map.valid);
  robot.drive(-0.5, 0.0, 4.0);
  robot.drive(0.0, 0.0, 1.0);
  EXPECT_LT(robot.position_error_m(), 0.017);
}

TEST(LocalizerScans, PersonsRoundTheRobotDoNotMoveThePose) {
  SceneDrive robot(scenes::lot(), Parameters{});
  ASSERT_TRUE(robot.map().map.valid);
  const Eigen::Vector2d here = robot.truth.head<2>();
  robot.persons = {here + Eigen::Vector2d(-1.5, 0.5), here + Eigen::Vector2d(-1.0, -1.2),
                   here + Eigen::Vector2d(0.3, 1.4)};
  for (int step = 0; step < 200; ++step) {
    robot.persons[0].x() += 0.02;
    robot.tick(0.0, 0.0);
  }
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 0.012);
}

TEST(LocalizerScans, RainDoesNotHinderMappingNorLocalization) {
  SceneDrive robot(scenes::lot(), Parameters{});
  robot.rain = 0.05;
  ASSERT_TRUE(robot.map().map.valid);
  robot.drive(-0.5, 0.0, 2.0);
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 0.02);
}

TEST(LocalizerScans, OtherCarThatLeavesDoesNotMoveThePose) {
  SceneDrive robot(scenes::lot(), Parameters{});
  ASSERT_TRUE(robot.map().map.valid);
  robot.world.resize(robot.world.size() - 4);
  robot.drive(-0.5, 0.0, 3.0);
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 0.02);
}

TEST(LocalizerScans, CarBehindTheRobotIsDegenerateAndInTheEndLost) {
  Parameters parameters;
  parameters.tracking.lost_sigma_m = 0.03;
  SceneDrive robot(scenes::open(), parameters);
  ASSERT_TRUE(robot.map().map.valid);
  robot.drive(0.0, -0.8, 2.7);
  robot.drive(1.0, 0.0, 1.0);
  EXPECT_TRUE(robot.newest.degenerate);
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  const double soon = robot.position_sigma_m();
  robot.drive(1.0, 0.0, 10.0);
  EXPECT_GT(robot.position_sigma_m(), soon);
  robot.drive(1.0, 0.0, 90.0);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
  EXPECT_FALSE(robot.newest.valid);
}

TEST(LocalizerScans, SilentLidarLeavesDeadReckoningWithGrowingUncertainty) {
  SceneDrive robot(scenes::lot(), Parameters{});
  ASSERT_TRUE(robot.map().map.valid);
  const double before = robot.position_sigma_m();
  robot.lidar_works = false;
  robot.drive(-0.5, 0.0, 4.0);
  EXPECT_TRUE(robot.newest.valid);
  EXPECT_TRUE(robot.newest.degenerate);
  EXPECT_GT(robot.position_sigma_m(), before);
  EXPECT_LT(robot.position_error_m(), 0.03);
}

TEST(LocalizerScans, FreezeWithoutAWayRoundGivesNeitherMapNorPose) {
  SceneDrive robot(scenes::lot(), Parameters{});
  robot.drive(0.0, 0.0, 2.0);
  robot.order(1, MapOrder::Phase::kCollect);
  robot.drive(0.5, 0.0, 2.0);
  robot.order(1, MapOrder::Phase::kFreeze);
  robot.drive(0.0, 0.0, 2.5);
  ASSERT_TRUE(robot.result.has_value());
  EXPECT_FALSE(robot.result->map.valid);
  EXPECT_NE(robot.result->map.message.text, "");
  EXPECT_FALSE(robot.newest.valid);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
  EXPECT_EQ(robot.newest.map_revision, 0u);
}

TEST(LocalizerScans, MapTakesEffectAtTheOrdersTimeAndTheDelay) {
  SceneDrive robot(scenes::lot(), Parameters{});
  const MapResult result = robot.map();
  // Frozen 3 s before the end of mapping; it takes effect 2 s later.
  EXPECT_EQ(result.stamp_ns, robot.now_ns - 1'000'000'000);
}

TEST(LocalizerScans, PausedMappingTakesNoKeyFramesAndGoesOn) {
  SceneDrive robot(scenes::lot(), Parameters{});
  robot.drive(0.0, 0.0, 2.0);
  robot.order(1, MapOrder::Phase::kCollect);
  robot.drive(0.5, 0.0, 2.0);
  robot.order(1, MapOrder::Phase::kIdle);
  robot.drive(0.5, 0.0, 0.2);
  const std::size_t paused = robot.localizer().key_frames().size();
  robot.drive(0.5, 0.0, 1.8);
  EXPECT_EQ(robot.localizer().key_frames().size(), paused);
  robot.order(1, MapOrder::Phase::kCollect);
  robot.drive(0.5, 0.0, 1.0);
  EXPECT_GT(robot.localizer().key_frames().size(), paused);
}

TEST(LocalizerScans, SecondMappingGivesTheNextRevision) {
  SceneDrive robot(scenes::lot(), Parameters{});
  ASSERT_TRUE(robot.map(1).map.valid);
  const MapResult second = robot.map(2);
  ASSERT_TRUE(second.map.valid) << second.map.message.text;
  EXPECT_EQ(second.revision, 2u);
  EXPECT_EQ(robot.newest.map_revision, 2u);
}

TEST(ExternalPose, MapFromPosesFromElsewhereIsNotAdjusted) {
  std::optional<StampedPose> map_from_odom;
  SceneDrive robot(scenes::lot(), std::make_unique<ExternalPose>(SceneDrive::in_lockstep({}), ExternalParameters{},
                                                                 [&] { return map_from_odom; }));
  robot.drive(0.0, 0.0, 2.0);
  EXPECT_FALSE(robot.newest.valid);
  EXPECT_EQ(robot.newest.message.text, "Waiting for map to odom from the other localization.");
  robot.order(1, MapOrder::Phase::kCollect);
  for (int step = 0; step < 500; ++step) {
    map_from_odom = StampedPose{robot.now_ns, {1.0, 2.0, 0.0}};
    robot.tick(0.5, 0.0);
  }
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_NEAR(robot.newest.x_m, 1.0 + robot.map_truth().x(), 0.05);
  EXPECT_NEAR(robot.newest.y_m, 2.0 + robot.map_truth().y(), 0.05);
  robot.order(1, MapOrder::Phase::kFreeze);
  robot.drive(0.0, 0.0, 2.5);
  ASSERT_TRUE(robot.result.has_value());
  EXPECT_TRUE(robot.result->map.valid);
  EXPECT_FALSE(robot.newest.valid);
}

TEST(ExternalPose, PoseThatIsNoNumberIsNeverValid) {
  PoseVector pose(1.0, 2.0, 0.0);
  SceneDrive* drive = nullptr;
  SceneDrive robot(scenes::lot(),
                   std::make_unique<ExternalPose>(SceneDrive::in_lockstep({}), ExternalParameters{}, [&] {
                     return std::optional(StampedPose{drive->now_ns, pose});
                   }));
  drive = &robot;
  ASSERT_TRUE(robot.drive(0.0, 0.0, 2.0).valid);
  pose.z() = std::numeric_limits<double>::quiet_NaN();
  robot.tick(0.0, 0.0);
  EXPECT_FALSE(robot.newest.valid);
  EXPECT_EQ(robot.newest.message.code, "localization.not_a_number");
}

}  // namespace
}  // namespace mtr_localization
