/// @file
/// Long silence of the LiDARs: the robot may have been carried, so the pose is not valid.
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Eigenvalues>

#include "scene_drive.hpp"

namespace mtr_localization {
namespace {

/// The LiDAR is silent, repeats its sweep, or reports no numbers.
enum class Blindness { kSilent, kFrozen, kCovered };

void set_blind(SceneDrive& robot, Blindness blindness, bool is_blind) {
  robot.lidar_works = !(is_blind && blindness == Blindness::kSilent);
  robot.lidar_is_frozen = is_blind && blindness == Blindness::kFrozen;
  robot.lidar_is_covered = is_blind && blindness == Blindness::kCovered;
}

class LocalizerBlindTest : public ::testing::TestWithParam<Blindness> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(robot.map().map.valid);
    robot.drive(0.0, 0.0, 1.0);
  }

  SceneDrive robot{scenes::lot(), Parameters{}};
};

INSTANTIATE_TEST_SUITE_P(Kinds, LocalizerBlindTest,
                         ::testing::Values(Blindness::kSilent, Blindness::kFrozen, Blindness::kCovered));

TEST_P(LocalizerBlindTest, RobotThatIsCarriedMeanwhileIsNotValidUntilItHasFoundItself) {
  set_blind(robot, GetParam(), true);
  robot.carry(-1.0, -1.7, 0.6);
  robot.drive(0.0, 0.0, 6.0);
  for (int second = 0; second < 60; ++second) {
    robot.drive(0.0, 0.0, 1.0);
    EXPECT_FALSE(robot.newest.valid);
  }
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
  EXPECT_NE(robot.newest.message.text.find("silent, frozen or covered"), std::string::npos)
      << robot.newest.message.text;
  set_blind(robot, GetParam(), false);
  robot.drive(0.0, 0.0, 3.0);
  EXPECT_FALSE(robot.newest.valid);
  robot.drive(-0.4, 0.0, 3.0);
  robot.drive(0.0, 0.5, 7.0);
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 0.02);
}

TEST_P(LocalizerBlindTest, RobotThatStoodIsTakenUpWhenItHasSeenWhereItIs) {
  set_blind(robot, GetParam(), true);
  ASSERT_FALSE(robot.drive(0.0, 0.0, 6.0).valid);
  set_blind(robot, GetParam(), false);
  robot.drive(0.0, 0.0, 1.5);
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 0.012);
}

TEST_P(LocalizerBlindTest, TwoSecondsCostNothing) {
  set_blind(robot, GetParam(), true);
  robot.drive(-0.3, 0.0, 2.0);
  set_blind(robot, GetParam(), false);
  robot.drive(-0.3, 0.0, 1.0);
  EXPECT_EQ(robot.lost_ticks, 0);
}

TEST(LocalizerBlind, PoseThatBecomesTooUncertainIsLostAtOnce) {
  Parameters parameters;
  parameters.sensors.slip_m_per_sqrt_m = 0.1;
  parameters.tracking.lost_sigma_m = 0.1;
  SceneDrive robot(scenes::lot(), parameters);
  ASSERT_TRUE(robot.map().map.valid);
  robot.lidar_works = false;
  for (int tick = 0; tick < 150; ++tick) {
    robot.tick(-0.8, 0.0);
    EXPECT_FALSE(robot.newest.valid && robot.position_sigma_m() > M_SQRT2 * 0.1) << "tick " << tick;
  }
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
}

TEST(LocalizerBlind, GrowingMapGoesOnWhenTheLidarSeesAgain) {
  SceneDrive robot(scenes::lot(), Parameters{});
  robot.drive(0.0, 0.0, 2.0);
  robot.order(1, MapOrder::Phase::kCollect);
  robot.drive(-0.3, 0.0, 2.0);
  robot.drive(0.3, 0.0, 2.0);
  robot.lidar_works = false;
  EXPECT_FALSE(robot.drive(0.0, 0.0, 6.0).valid);
  robot.lidar_works = true;
  EXPECT_TRUE(robot.drive(0.0, 0.0, 1.5).valid) << robot.newest.message.text;
  robot.drive_round();
  robot.order(1, MapOrder::Phase::kFreeze);
  robot.drive(0.0, 0.0, 3.0);
  ASSERT_TRUE(robot.result.has_value());
  EXPECT_TRUE(robot.result->map.valid) << robot.result->map.message.text;
}

TEST(LocalizerBlind, NoPoseIsKnownExactlyWhereAMapBegins) {
  SceneDrive robot(scenes::lot(), Parameters{});
  robot.drive(0.0, 0.0, 2.0);
  robot.order(1, MapOrder::Phase::kCollect);
  for (int tick = 0; tick < 50; ++tick) {
    robot.tick(0.0, 0.0);
    const Eigen::Map<const Eigen::Matrix3d> covariance(robot.newest.covariance.data());
    EXPECT_GT(covariance.eigenvalues().real().minCoeff(), 1e-7) << "tick " << tick;
  }
}

TEST(LocalizerBlind, MapThatBeganWithoutALidarBeginsWithTheFirstScan) {
  SceneDrive robot(scenes::lot(), Parameters{});
  robot.lidar_works = false;
  robot.drive(0.0, 0.0, 2.0);
  robot.order(1, MapOrder::Phase::kCollect);
  EXPECT_TRUE(robot.drive(0.0, 0.0, 4.0).valid);
  EXPECT_FALSE(robot.drive(0.0, 0.0, 2.0).valid);
  EXPECT_EQ(robot.newest.message.code, "localization.blind");
  robot.lidar_works = true;
  robot.drive(0.0, 0.0, 1.0);
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_FALSE(robot.localizer().key_frames().empty());
}

}  // namespace
}  // namespace mtr_localization
