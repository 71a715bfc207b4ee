/// @file
/// Events during the drive round the Car: silent sensors and contradicting views.
// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "scene_drive.hpp"

namespace mtr_localization {
namespace {

/// Time and duration of a silence during the drive.
struct Gap {
  double in_side_s;
  double in_turn_s;
};

/// Maps like SceneDrive::map, with the gap.
MapResult map_with(SceneDrive& robot, const Gap& gap) {
  const auto unheard = [&robot](double linear_mps, double angular_radps, double duration_s) {
    robot.hears = false;
    robot.drive(linear_mps, angular_radps, duration_s);
    robot.hears = true;
  };
  robot.drive(0.0, 0.0, 2.0);
  robot.order(1, MapOrder::Phase::kCollect);
  robot.drive(0.6, 0.0, 6.0);
  unheard(0.6, 0.0, gap.in_side_s);
  robot.drive(0.6, 0.0, 5.6 / 0.6 - 6.0 - gap.in_side_s);
  robot.drive(0.0, M_PI_2 / 2.0, 1.0);
  unheard(0.0, M_PI_2 / 2.0, gap.in_turn_s);
  robot.drive(0.0, M_PI_2 / 2.0, 1.0 - gap.in_turn_s);
  for (const double side_m : {8.4, 5.6, 8.4}) {
    robot.drive(0.6, 0.0, side_m / 0.6);
    robot.drive(0.0, M_PI_2 / 2.0, 2.0);
  }
  robot.drive(0.6, 0.0, 1.5);
  robot.drive(0.0, 0.0, 0.5);
  robot.order(1, MapOrder::Phase::kFreeze);
  robot.result.reset();
  robot.drive(0.0, 0.0, 3.0);
  return robot.result ? *robot.result : MapResult{};
}

class InterruptedMapTest : public testing::TestWithParam<Gap> {};

TEST_P(InterruptedMapTest, IsAsGoodAsOneThatWasNot) {
  SceneDrive robot(scenes::lot(), Parameters{});
  const MapResult made = map_with(robot, GetParam());
  EXPECT_GT(robot.lost_ticks, 0);
  ASSERT_TRUE(made.map.valid) << made.map.message.text;
  EXPECT_LT(robot.position_error_m(), 0.005);
  EXPECT_LT(robot.position_sigma_m(), 0.005);
}

// The wheels turn 1.4 times as far as the robot, so they are wrong by 0.1 rad over 0.3 s.
INSTANTIATE_TEST_SUITE_P(Gaps, InterruptedMapTest, testing::Values(Gap{0.8, 0.0}, Gap{0.0, 0.3}, Gap{0.8, 0.3}));

/// Robot with a map of the Car alone, then many unmapped objects and a short silence.
class SilenceAmongNewThingsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    robot.drive(0.0, 0.0, 2.0);
    robot.order(1, MapOrder::Phase::kCollect);
    robot.drive(0.6, 0.0, 1.5);
    robot.world = scenes::lot();
    robot.hears = false;
    robot.drive(0.6, 0.0, 0.8);
  }

  void hear_again() {
    robot.hears = true;
    robot.drive(0.0, 0.0, 0.5);
    ASSERT_EQ(robot.newest.mode, PoseMode::kLost);
    robot.drive(0.0, 0.0, 2.5);
  }

  SceneDrive robot{scenes::open(), Parameters{}};
};

TEST_F(SilenceAmongNewThingsTest, PlaceIsProvedByWhatTheGrowingMapHas) {
  hear_again();
  EXPECT_TRUE(robot.newest.valid) << robot.newest.message.text;
  EXPECT_EQ(robot.newest.mode, PoseMode::kMapping);
  EXPECT_LT(robot.position_error_m(), 0.05);
}

TEST_F(SilenceAmongNewThingsTest, RobotThatWasCarriedMeanwhileStaysLost) {
  robot.carry(-0.5, 0.5, 0.2);
  hear_again();
  EXPECT_FALSE(robot.newest.valid);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
}

class LocalizerLostWhileMappingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    robot.drive(0.0, 0.0, 2.0);
    robot.order(1, MapOrder::Phase::kCollect);
    robot.drive(0.6, 0.0, 4.0);
    ASSERT_EQ(robot.newest.mode, PoseMode::kMapping);
  }

  /// Drives while the LiDAR sees nothing of the previous scene.
  void drive_blind(double duration_s) {
    const synthetic::World scene = std::exchange(robot.world, {});
    robot.drive(0.6, 0.0, duration_s);
    robot.world = scene;
  }

  SceneDrive robot{scenes::lot(), Parameters{}};
};

TEST_F(LocalizerLostWhileMappingTest, WheelsAndGyroLeadOverAShortStretchThatDoesNotAgree) {
  drive_blind(2.5);
  EXPECT_EQ(robot.lost_ticks, 0);
  EXPECT_TRUE(robot.newest.degenerate);
  robot.drive(0.6, 0.0, 1.0);
  EXPECT_FALSE(robot.newest.degenerate);
  EXPECT_LT(robot.position_error_m(), 0.03);
}

TEST_F(LocalizerLostWhileMappingTest, LongStretchIsLostAndGoesOnWhereTheViewAgreesAgain) {
  drive_blind(4.5);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
  EXPECT_FALSE(robot.newest.valid);
  robot.drive(0.0, M_PI_2 / 2.0, 2.0);
  robot.drive(0.6, 0.0, 1.0);
  EXPECT_EQ(robot.newest.mode, PoseMode::kMapping) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 0.05);
}

TEST_F(LocalizerLostWhileMappingTest, WheelsThatRepeatAPlaceAtASpeedDoNotLeadItOnTwice) {
  robot.wheels_are_frozen = true;
  robot.drive(0.4, 0.0, 0.7);
  robot.drive(0.0, 0.0, 0.8);
  robot.wheels_are_frozen = false;
  robot.drive(0.0, 0.0, 3.0);
  EXPECT_EQ(robot.newest.mode, PoseMode::kMapping) << robot.newest.message.text;
  EXPECT_LT(robot.position_error_m(), 0.03);
}

TEST_F(LocalizerLostWhileMappingTest, CarriedRobotStaysLostAndGuessesNothing) {
  robot.drive(0.0, 0.0, 1.0);
  robot.carry(-1.0, -1.7, 0.6);
  robot.drive(0.0, 0.0, 2.0);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
  robot.drive(0.0, 0.0, 4.0);
  EXPECT_FALSE(robot.newest.valid);
  EXPECT_NE(robot.newest.message.text.find("map the Car again"), std::string::npos) << robot.newest.message.text;
}

TEST_F(LocalizerLostWhileMappingTest, WayRoundThatEndsLostGivesNoMap) {
  robot.world.clear();
  robot.drive(0.6, 0.0, 6.0);
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
  robot.order(1, MapOrder::Phase::kFreeze);
  robot.drive(0.0, 0.0, 3.0);
  ASSERT_TRUE(robot.result);
  EXPECT_FALSE(robot.result->map.valid);
  EXPECT_NE(robot.result->map.message.text.find("lost on the way round"), std::string::npos)
      << robot.result->map.message.text;
}

/// Robot that drives half the way round, so that its map is rejected.
class RefusedMapTest : public ::testing::Test {
 protected:
  void SetUp() override {
    robot.drive(0.0, 0.0, 2.0);
    robot.order(1, MapOrder::Phase::kCollect);
    robot.drive(0.6, 0.0, 6.0);
    robot.drive(0.0, M_PI_2 / 2.0, 2.0);
    robot.drive(0.6, 0.0, 6.0);
    ASSERT_TRUE(robot.newest.valid);
    robot.order(1, MapOrder::Phase::kFreeze);
    robot.drive(0.0, 0.0, 3.0);
    ASSERT_TRUE(robot.result);
    ASSERT_FALSE(robot.result->map.valid);
  }

  SceneDrive robot{scenes::lot(), Parameters{}};
};

TEST_F(RefusedMapTest, NoPoseInItIsValidAnyMore) {
  EXPECT_EQ(robot.newest.mode, PoseMode::kLost);
  for (int tick = 0; tick < 300; ++tick) {
    robot.tick(tick < 150 ? 0.3 : 0.0, tick < 150 ? 0.2 : 0.0);
    ASSERT_FALSE(robot.newest.valid);
  }
  EXPECT_NE(robot.newest.message.text.find("was not closed"), std::string::npos) << robot.newest.message.text;
  EXPECT_NE(robot.newest.message.text.find("map again"), std::string::npos) << robot.newest.message.text;
}

TEST_F(RefusedMapTest, SensorThatIsSilentForAMomentDoesNotMakeItValid) {
  robot.hears = false;
  robot.drive(0.3, 0.0, 1.0);
  robot.hears = true;
  EXPECT_FALSE(robot.drive(0.0, 0.0, 4.0).valid);
}

TEST_F(RefusedMapTest, NextMapBeginsWhereTheRobotStandsAndIsAsGoodAsAnyOther) {
  robot.order(2, MapOrder::Phase::kCollect);
  robot.drive(0.0, 0.0, 0.2);
  EXPECT_EQ(robot.newest.mode, PoseMode::kMapping) << robot.newest.message.text;
  EXPECT_LT(robot.position_sigma_m(), 0.002);
  const PoseVector begin_truth = robot.truth;
  const PoseVector begin(robot.newest.x_m, robot.newest.y_m, robot.newest.heading_rad);
  robot.drive(0.6, 0.0, 4.0);
  robot.drive(0.0, M_PI_2 / 2.0, 2.0);
  for (const double side_m : {5.6, 8.4, 5.6, 6.0}) {
    robot.drive(0.6, 0.0, side_m / 0.6);
    robot.drive(0.0, M_PI_2 / 2.0, 2.0);
  }
  robot.drive(0.0, 0.0, 0.5);
  robot.order(2, MapOrder::Phase::kFreeze);
  robot.drive(0.0, 0.0, 3.0);
  ASSERT_TRUE(robot.result->map.valid) << robot.result->map.message.text;
  EXPECT_EQ(robot.newest.mode, PoseMode::kLocalized);
  const PoseVector here(robot.newest.x_m, robot.newest.y_m, robot.newest.heading_rad);
  EXPECT_LT((relative(begin, here) - relative(begin_truth, robot.truth)).head<2>().norm(), 0.01);
}

}  // namespace
}  // namespace mtr_localization
