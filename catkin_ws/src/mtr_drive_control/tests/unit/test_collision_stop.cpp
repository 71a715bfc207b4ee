/// @file
/// The collision stop at walls, things, the Car's side and persons.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "scene.hpp"

namespace mtr_drive_control {
namespace {

Wall wall_ahead(double x_m) { return {{x_m, -3.0}, {x_m, 3.0}}; }

TEST(CollisionStop, OpenGroundIsDrivenAtTheWantedSpeed) {
  TestRobot robot;
  robot.settle();
  const Decision decision = robot.drive({0.8, 0.0}, 2.5);
  EXPECT_DOUBLE_EQ(decision.velocity.linear_mps, 0.8);
  EXPECT_EQ(decision.zone, Zone::kClear);
  EXPECT_FALSE(decision.hindrance);
}

TEST(CollisionStop, WallAheadIsSlowedForAndNotTouched) {
  TestRobot robot;
  robot.scene.noise_m = 0.02;
  robot.scene.walls = {wall_ahead(3.0)};
  bool slowed = false;
  robot.settle();
  for (int tick = 0; tick < 300; ++tick) {
    slowed = robot.step({1.2, 0.0}).zone == Zone::kSlowed || slowed;
    ASSERT_GT(robot.clearance(), 0.0);
  }
  EXPECT_TRUE(slowed);
  const Decision decision = robot.step({1.2, 0.0});
  EXPECT_EQ(decision.zone, Zone::kBlocked);
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
  EXPECT_LT(robot.clearance(), 0.12);
  EXPECT_NEAR(decision.hindrance->distance_m, robot.clearance(), 0.03);
  EXPECT_NEAR(decision.hindrance->bearing_rad, 0.0, 0.8);
  EXPECT_EQ(decision.message.text, "Blocked by an obstacle 0.1 m ahead.");
}

TEST(CollisionStop, WallBehindStopsABackingRobotAndIsSaidToBeBehind) {
  TestRobot robot;
  robot.scene.walls = {wall_ahead(-2.0)};
  robot.settle();
  const Decision decision = robot.drive({-0.8, 0.0}, 6.0);
  EXPECT_EQ(decision.zone, Zone::kBlocked);
  EXPECT_GT(robot.clearance(), 0.0);
  EXPECT_NE(decision.message.text.find("behind"), std::string::npos);
}

TEST(CollisionStop, WallInACornersWayStopsATurnOnTheSpot) {
  TestRobot robot;
  // Clear of the robot at rest (0.215 m), in the path of its turning corner (0.345 m).
  robot.scene.walls = {{{-3.0, 0.28}, {3.0, 0.28}}};
  robot.settle();
  EXPECT_EQ(robot.drive({0.0, 1.0}, 4.0).zone, Zone::kBlocked);
  EXPECT_GT(robot.clearance(), 0.0);
}

TEST(CollisionStop, WallThatIsNearerThanTheGapMayBeLeftButNotApproached) {
  TestRobot robot;
  robot.scene.walls = {wall_ahead(0.30)};
  robot.settle();
  EXPECT_EQ(robot.drive({0.3, 0.0}, 2.0).velocity.linear_mps, 0.0);
  EXPECT_LT(robot.drive({-0.3, 0.0}, 2.0).velocity.linear_mps, -0.2);
}

TEST(CollisionStop, RunBesideTheCarAtThreeTenthsOfAMetreIsNotSlowed) {
  TestRobot robot;
  robot.scene.noise_m = 0.02;
  robot.scene.walls = {{{-2.0, 0.515}, {2.5, 0.515}}, {{2.5, 0.515}, {2.5, 2.3}}, {{-2.0, 0.515}, {-2.0, 2.3}}};
  robot.settle();
  for (int tick = 0; tick < 300; ++tick) {
    ASSERT_EQ(robot.step({1.0, 0.0}).zone, Zone::kClear) << robot.world_from_base.position().x_m;
  }
  EXPECT_GT(robot.world_from_base.position().x_m, 4.0);
}

TEST(CollisionStop, RunBesideTheCarWithoutRearLidarIsNotSlowedWhereOnlyItsEndIsSeen) {
  TestRobot robot(false);
  robot.scene.walls = {{{-2.0, 0.515}, {1.5, 0.515}}, {{1.5, 0.515}, {1.5, 2.3}}};
  robot.settle();
  for (int tick = 0; tick < 250; ++tick) {
    ASSERT_NE(robot.step({0.8, 0.0}).zone, Zone::kBlocked);
  }
  EXPECT_GT(robot.world_from_base.position().x_m, 3.0);
}

TEST(CollisionStop, ApproachToTheCarEndsThreeTenthsOfAMetreBeforeItWithoutAStop) {
  TestRobot robot;
  robot.scene.walls = {wall_ahead(2.0)};
  robot.settle();
  while (robot.clearance() > 0.3) {
    ASSERT_NE(robot.step({0.4, 0.0}).zone, Zone::kBlocked);
  }
}

TEST(CollisionStop, LegBesideTheWaySlowsTheRobotAsItMayWalk) {
  TestRobot robot;
  robot.scene.discs = {{{3.0, 1.2}, 0.07}};
  double slowest = 1.0;
  robot.settle();
  robot.drive({1.0, 0.0}, 1.2);
  for (int tick = 0; tick < 250; ++tick) {
    slowest = std::min(slowest, robot.step({1.0, 0.0}).velocity.linear_mps);
  }
  EXPECT_LT(slowest, 0.8);
  EXPECT_GT(slowest, 0.2);
  EXPECT_GT(robot.world_from_base.position().x_m, 3.0);
}

TEST(CollisionStop, LegWithinReachStopsTheRobotAndThePostThatItTurnsOutToBeMayBeLeft) {
  TestRobot robot;
  robot.scene.discs = {{{0.6, 0.0}, 0.07}};
  robot.scene.noise_m = 0.005;
  robot.settle();
  EXPECT_EQ(robot.drive({-0.5, 0.0}, 1.0).velocity.linear_mps, 0.0);
  EXPECT_EQ(robot.drive({0.5, 0.0}, 3.0).velocity.linear_mps, 0.0);
  EXPECT_NEAR(robot.drive({-0.5, 0.0}, 2.0).velocity.linear_mps, -0.1, 0.02);
}

TEST(CollisionStop, PersonWhoWalksInFromTheSideNeverTouchesTheMovingRobot) {
  for (const double speed_mps : {0.3, 0.6, 1.0, 1.4}) {
    TestRobot robot;
    robot.settle();
    robot.drive({speed_mps, 0.0}, 2.0);
    const double meeting_x = robot.world_from_base.position().x_m + 1.2;
    for (double y = 3.0; y > -3.0; y -= 1.5 * 0.02) {
      robot.scene.discs = {{{meeting_x, y}, 0.15}};
      robot.step({speed_mps, 0.0});
      if (robot.clearance() <= 0.0) {
        EXPECT_EQ(robot.velocity.linear_mps, 0.0) << speed_mps;
      }
    }
  }
}

TEST(CollisionStop, AfterAStopItWaitsForThePauseAndGoesOn) {
  TestRobot robot;
  robot.scene.discs = {{{1.2, 0.0}, 0.07}, {{1.2, 0.2}, 0.07}};
  robot.settle();
  ASSERT_EQ(robot.drive({0.5, 0.0}, 5.0).zone, Zone::kBlocked);
  // A wall is visible behind the place of the legs; invisible legs alone would prove nothing.
  robot.scene.discs.clear();
  robot.scene.walls = {{{8.0, -9.0}, {8.0, 9.0}}};
  EXPECT_EQ(robot.drive({0.5, 0.0}, 0.9).velocity.linear_mps, 0.0);
  EXPECT_GT(robot.drive({0.5, 0.0}, 0.5).velocity.linear_mps, 0.1);
}

TEST(CollisionStop, PlannerThatStopsForTheObstacleDoesNotMakeTheWayFree) {
  TestRobot robot;
  robot.scene.walls = {wall_ahead(0.32)};
  robot.settle();
  ASSERT_EQ(robot.drive({0.5, 0.0}, 1.0).zone, Zone::kBlocked);
  EXPECT_EQ(robot.drive({0.0, 0.0}, 3.0).zone, Zone::kBlocked);
  robot.scene.walls = {
      {{6.0, -9.0}, {6.0, 9.0}}, {{-6.0, -9.0}, {-6.0, 9.0}}, {{-6.0, 9.0}, {6.0, 9.0}}, {{-6.0, -9.0}, {6.0, -9.0}}};
  EXPECT_EQ(robot.drive({0.0, 0.0}, 1.2).zone, Zone::kClear);
}

TEST(CollisionStop, RaindropsDoNotStopIt) {
  TestRobot robot;
  std::mt19937 random(4);
  std::uniform_int_distribution<std::size_t> beam(0, 719);
  std::uniform_real_distribution<double> range(0.3, 3.0);
  robot.settle();
  robot.drive({0.8, 0.0}, 1.0);
  for (int tick = 0; tick < 500; ++tick) {
    robot.scene.raindrops.clear();
    for (int drop = 0; drop < 8; ++drop) {
      robot.scene.raindrops.emplace_back(beam(random), range(random));
    }
    ASSERT_EQ(robot.step({0.8, 0.0}).zone, Zone::kClear);
  }
}

TEST(CollisionStop, ThinPostIsNoRaindrop) {
  TestRobot robot;
  robot.scene.discs = {{{2.5, 0.0}, 0.008}};
  robot.settle();
  EXPECT_EQ(robot.drive({0.5, 0.0}, 12.0).zone, Zone::kBlocked);
  EXPECT_GT(robot.clearance(), 0.0);
}

TEST(CollisionStop, MastInViewIsNoObstacle) {
  TestRobot robot;
  robot.scene.raindrops = {{0, 0.11}, {1, 0.11}, {2, 0.11}, {3, 0.11}, {4, 0.11}, {5, 0.11}};
  robot.settle();
  EXPECT_EQ(robot.drive({0.5, 0.0}, 2.0).zone, Zone::kClear);
}

TEST(CollisionStop, RandomArcsAmongThingsThatStandNeverTouchOne) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int stops = 0;
  for (int run = 0; run < 60; ++run) {
    TestRobot robot;
    robot.scene.beams = 360;
    robot.scene.noise_m = 0.02;
    for (int i = 0; i < 4; ++i) {
      const Point centre{3.0 * unit(random), 3.0 * unit(random)};
      robot.scene.discs.push_back({centre, 0.03 + 0.1 * std::abs(unit(random))});
      const Point start{4.0 * unit(random), 4.0 * unit(random)};
      robot.scene.walls.push_back({start, {start.x_m + unit(random), start.y_m + unit(random)}});
    }
    if (robot.clearance() < 0.1) {
      continue;
    }
    const Velocity desired{1.5 * unit(random), 1.5 * unit(random)};
    robot.settle();
    for (int tick = 0; tick < 250; ++tick) {
      const Decision decision = robot.step(desired);
      stops += decision.zone == Zone::kBlocked ? 1 : 0;
      ASSERT_GT(robot.clearance(), 0.0) << "run " << run << " at " << tick;
    }
  }
  EXPECT_GT(stops, 100);
}

}  // namespace
}  // namespace mtr_drive_control
