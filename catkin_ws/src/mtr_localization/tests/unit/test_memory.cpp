/// @file
/// Restart of localization with a stored map.
// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <utility>

#include "scene_drive.hpp"

namespace mtr_localization {
namespace {

class MemoryTest : public ::testing::Test {
 protected:
  void SetUp() override {
    map = robot.map();
    ASSERT_TRUE(map.map.valid);
    robot.drive(0.3, 0.1, 2.0);
  }

  /// Brakes while localization does not run.
  void brake_unheard(double distance_m) {
    Memory memory = robot.memory(map);
    robot.drive(0.3, 0.0, distance_m / 0.3);
    robot.start_anew(std::move(memory));
  }

  SceneDrive robot{scenes::lot(), Parameters{}};
  MapResult map;
};

TEST_F(MemoryTest, GoesOnInTheSameMapWhenTheViewIsTheExpectedOne) {
  brake_unheard(0.4);
  robot.drive(0.0, 0.0, 4.5);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLocalized) << robot.newest.message.text;
  EXPECT_TRUE(robot.newest.valid);
  EXPECT_EQ(robot.newest.map_revision, map.revision);
  EXPECT_LT(robot.position_error_m(), 0.02);
  EXPECT_LT(robot.position_sigma_m(), 0.03);
}

TEST_F(MemoryTest, IsInTheMapOfBeforeFromTheFirstAnswerOnButNotValidBeforeItHasLooked) {
  brake_unheard(0.2);
  for (int tick = 0; tick < 100; ++tick) {
    robot.tick(0.0, 0.0);
    ASSERT_FALSE(robot.newest.valid) << tick;
    ASSERT_EQ(robot.newest.map_revision, map.revision);
  }
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
  EXPECT_NE(robot.newest.message.text.find("started anew"), std::string::npos) << robot.newest.message.text;
}

TEST_F(MemoryTest, OriginOfTheMapOutlivesARestartWithItsMemoryAlone) {
  const std::uint64_t before = robot.newest.origin_id;
  EXPECT_NE(before, 0U);
  brake_unheard(0.2);
  robot.drive(0.0, 0.0, 4.5);
  EXPECT_EQ(robot.newest.origin_id, before);
  Memory without_pose = robot.memory(map);
  without_pose.pose.reset();
  robot.start_anew(std::move(without_pose));
  robot.drive(0.0, 0.0, 4.5);
  EXPECT_GT(robot.newest.origin_id, before);
}

TEST_F(MemoryTest, MapThatBeginsAtAKnownPoseKeepsTheOriginAndOneThatBeginsLostHasAnother) {
  const std::uint64_t before = robot.newest.origin_id;
  robot.order(2, MapOrder::Phase::kCollect);
  robot.drive(0.2, 0.0, 2.0);
  ASSERT_EQ(robot.newest.mode, PoseMode::kMapping);
  EXPECT_EQ(robot.newest.origin_id, before);
  const synthetic::World scene = std::exchange(robot.world, {});
  robot.drive(0.5, 0.5, 8.0);
  ASSERT_EQ(robot.newest.mode, PoseMode::kLost);
  EXPECT_EQ(robot.newest.origin_id, before);
  robot.world = scene;
  robot.order(3, MapOrder::Phase::kCollect);
  robot.drive(0.0, 0.0, 2.0);
  ASSERT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_GT(robot.newest.origin_id, before);
}

TEST_F(MemoryTest, RobotThatWasCarriedMeanwhileStaysLostUntilItIsDriven) {
  Memory memory = robot.memory(map);
  robot.carry(-1.0, -1.0, 0.5);
  robot.start_anew(std::move(memory));
  robot.drive(0.0, 0.0, 6.0);
  EXPECT_FALSE(robot.newest.valid);
  robot.drive(-0.3, 0.2, 5.0);
  robot.drive(0.0, 0.5, 6.0);
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 0.02);
}

TEST_F(MemoryTest, WithoutAPoseItIsFoundOnItsWay) {
  Memory memory = robot.memory(map);
  memory.pose.reset();
  robot.start_anew(std::move(memory));
  robot.drive(0.0, 0.0, 4.0);
  EXPECT_FALSE(robot.newest.valid);
  robot.drive(-0.3, 0.2, 5.0);
  robot.drive(0.0, 0.5, 6.0);
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 0.02);
}

TEST_F(MemoryTest, AnOrderForAnotherCarBeginsAnotherMap) {
  brake_unheard(0.2);
  robot.drive(0.0, 0.0, 1.0);
  robot.order(2, MapOrder::Phase::kCollect);
  robot.drive(0.0, 0.0, 2.0);
  EXPECT_EQ(robot.newest.mode, PoseMode::kMapping);
  EXPECT_EQ(robot.newest.map_revision, 0U);
}

TEST_F(MemoryTest, AnOrderOfTheSameSurveyChangesNothing) {
  brake_unheard(0.2);
  robot.order(1, MapOrder::Phase::kFreeze);
  robot.drive(0.0, 0.0, 4.5);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLocalized) << robot.newest.message.text;
}

TEST(LedByWheels, AddsTheWayAndItsUncertainty) {
  RememberedPose from;
  from.pose << 1.0, 2.0, M_PI_2;
  from.wheel_odom = {5.0, 5.0, 0.0};
  const auto led = led_by_wheels(from, {5.4, 5.0, 0.1});
  ASSERT_TRUE(led);
  EXPECT_NEAR(led->pose.x(), 1.0, 1e-12);
  EXPECT_NEAR(led->pose.y(), 2.4, 1e-12);
  EXPECT_NEAR(led->pose.z(), M_PI_2 + 0.1, 1e-12);
  EXPECT_NEAR(std::sqrt(led->covariance(0, 0)), 0.06, 1e-9);
  EXPECT_NEAR(std::sqrt(led->covariance(2, 2)), 0.06, 1e-9);
}

TEST(LedByWheels, AsFarAsARobotTurnsUntilItStands) {
  const auto led = led_by_wheels(RememberedPose{}, {0.2, 0.1, 0.9});
  ASSERT_TRUE(led);
  EXPECT_NEAR(std::sqrt(led->covariance(2, 2)), 0.46, 1e-9);
}

TEST(LedByWheels, TurnsAsTheGyroSawItWhereItDid) {
  RememberedPose from;
  from.pose << 1.0, 2.0, 0.0;
  // On an arc of 1.2 rad, the wheels report 1.0 rad: half of the difference changes the direction of the chord.
  const std::array<double, 3> wheels{0.4 * std::cos(0.5), 0.4 * std::sin(0.5), 1.0};
  const auto led = led_by_wheels(from, wheels, 1.2);
  ASSERT_TRUE(led);
  EXPECT_NEAR(led->pose.x(), 1.0 + 0.4 * std::cos(0.6), 1e-12);
  EXPECT_NEAR(led->pose.y(), 2.0 + 0.4 * std::sin(0.6), 1e-12);
  EXPECT_NEAR(led->pose.z(), 1.2, 1e-12);
  EXPECT_NEAR(std::sqrt(led->covariance(0, 0)), std::hypot(0.06, 0.04), 1e-9);
  EXPECT_NEAR(std::sqrt(led->covariance(2, 2)), 0.01, 1e-9);
  EXPECT_FALSE(led_by_wheels(from, wheels, 1.6));
}

TEST(LedByWheels, NowhereWhenTheirOdometryBeganAnewOrTheyWentFar) {
  RememberedPose from;
  from.wheel_odom = {5.0, 5.0, 0.0};
  EXPECT_FALSE(led_by_wheels(from, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(led_by_wheels(from, {5.0, 5.0, 1.1}));
  EXPECT_FALSE(led_by_wheels(from, {std::numeric_limits<double>::quiet_NaN(), 5.0, 0.0}));
}

TEST(KeptPose, IsKeptEveryHalfSecondWhateverIsDoneToTheClock) {
  constexpr std::int64_t kSecondNs = 1'000'000'000;
  EXPECT_FALSE(is_due(100 * kSecondNs + kSecondNs / 4, 100 * kSecondNs));
  EXPECT_TRUE(is_due(100 * kSecondNs + kSecondNs / 2, 100 * kSecondNs));
  EXPECT_TRUE(is_due(100 * kSecondNs, 3700 * kSecondNs));
}

}  // namespace
}  // namespace mtr_localization
