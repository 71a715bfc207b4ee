/// @file
/// Missing echoes: covered, dirty and dazzled LiDARs, targets below the measuring range, and objects that really left.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "spoilt_scans.hpp"

namespace mtr_drive_control {
namespace {

struct Spoilt {
  double direction_deg;
  double half_deg;
  float said_m;
};

class SpoiltAhead : public ::testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltAhead, WallIsNotTouchedAndTheLidarIsNamed) {
  const auto [direction_deg, half_deg, said_m] = GetParam();
  for (const double wall_m : {2.5, 4.0, 8.0}) {
    TestRobot robot;
    robot.scene.walls = wall_at(wall_m);
    robot.settle();
    robot.drive({0.7, 0.0}, 1.0);
    spoil(robot, false, direction_deg * kDegree, half_deg * kDegree, said_m);
    bool is_named = false;
    for (int tick = 0; tick < 700; ++tick) {
      const Decision decision = robot.step({0.7, 0.0});
      is_named = is_named || (decision.zone == Zone::kBlind && is_said(decision, "front LiDAR"));
      ASSERT_GT(robot.clearance(), 0.0);
    }
    EXPECT_TRUE(is_named) << wall_m;
    EXPECT_EQ(robot.velocity.linear_mps, 0.0);
  }
}

TEST_P(SpoiltAhead, PoleIsNotTouched) {
  const auto [direction_deg, half_deg, said_m] = GetParam();
  for (const bool is_open : {true, false}) {
    TestRobot robot;
    robot.scene.walls = is_open ? std::vector<Wall>{} : lot();
    robot.scene.discs = {{{3.5, 0.0}, 0.05}};
    robot.settle();
    robot.drive({0.7, 0.0}, 1.0);
    spoil(robot, false, direction_deg * kDegree, half_deg * kDegree, said_m);
    robot.drive({0.7, 0.0}, 12.0);
    EXPECT_GT(robot.clearance(), 0.0) << is_open;
    EXPECT_EQ(robot.velocity.linear_mps, 0.0) << is_open;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SpoiltAhead,
                         ::testing::Values(Spoilt{0.0, 180.0, kInf}, Spoilt{0.0, 60.0, kInf}, Spoilt{0.0, 45.0, kInf},
                                           Spoilt{0.0, 20.0, kInf}, Spoilt{10.0, 20.0, kInf}, Spoilt{0.0, 180.0, kNan},
                                           Spoilt{0.0, 45.0, kNan}, Spoilt{0.0, 180.0, 0.0F}, Spoilt{0.0, 60.0, 0.0F},
                                           Spoilt{0.0, 180.0, 0.001F}, Spoilt{0.0, 60.0, 0.001F},
                                           Spoilt{0.0, 180.0, 0.05F}, Spoilt{0.0, 45.0, 0.1F},
                                           Spoilt{0.0, 180.0, 65.5F}, Spoilt{0.0, 45.0, 31.0F}));

TEST(MissingEchoes, NarrowSectorOverAPoleLeavesItAnObstacle) {
  for (const double half_deg : {1.0, 3.0, 4.5}) {
    for (const float said_m : {kInf, kNan, 0.0F}) {
      TestRobot robot;
      robot.scene.discs = {{{3.5, 0.0}, 0.05}};
      robot.settle();
      robot.drive({0.7, 0.0}, 1.0);
      spoil(robot, false, 0.0, half_deg * kDegree, said_m);
      robot.drive({0.7, 0.0}, 12.0);
      EXPECT_GT(robot.clearance(), 0.0) << half_deg << " " << said_m;
    }
  }
}

TEST(MissingEchoes, MessageNamesTheSectorInTheRobotsFrame) {
  TestRobot robot;
  robot.scene.walls = lot(3.0);
  robot.drive({}, 1.0);
  spoil(robot, false, 45.0 * kDegree, 15.0 * kDegree, kInf);
  Decision decision = robot.drive({0.3, 0.0}, 1.0);
  EXPECT_TRUE(is_said(decision, "front LiDAR sees nothing from 30 to 60 degrees")) << decision.message.text;
  spoil(robot, true, 30.0 * kDegree, 15.0 * kDegree, kInf);
  decision = robot.drive({0.3, 0.0}, 1.0);
  EXPECT_TRUE(is_said(decision, "rear LiDAR sees nothing from -165 to -135 degrees")) << decision.message.text;
  spoil(robot, true, 30.0 * kDegree, 15.0 * kDegree, kNan);
  EXPECT_TRUE(is_said(robot.drive({0.3, 0.0}, 1.0), "rear LiDAR is covered or dirty from -165 to -135 degrees"));
}

TEST(MissingEchoes, RearLidarThatSeesNothingStopsBacking) {
  for (const double half_deg : {180.0, 45.0, 15.0}) {
    TestRobot robot;
    robot.scene.walls = wall_at(-4.0);
    robot.settle();
    robot.drive({-0.6, 0.0}, 1.0);
    spoil(robot, true, 0.0, half_deg * kDegree, kInf);
    const Decision decision = robot.drive({-0.6, 0.0}, 8.0);
    EXPECT_GT(robot.clearance(), 0.0) << half_deg;
    EXPECT_TRUE(is_said(decision, "rear LiDAR")) << decision.message.text;
  }
}

TEST(MissingEchoes, FlickeringPoleIsStoppedBefore) {
  std::mt19937 random(5);
  for (const double share : {0.3, 0.7, 0.95}) {
    TestRobot robot;
    robot.scene.discs = {{{4.0, 0.05}, 0.06}};
    robot.settle();
    robot.drive({0.6, 0.0}, 1.0);
    robot.spoil = [&](Sweep& sweep, bool) {
      const bool is_dark = std::bernoulli_distribution(share)(random);
      for (float& range_m : sweep.ranges_m) {
        range_m = is_dark || std::bernoulli_distribution(share)(random) ? kInf : range_m;
      }
    };
    robot.drive({0.6, 0.0}, 15.0);
    EXPECT_GT(robot.clearance(), 0.0) << share;
    // It may creep until the pole is within a person's reach.
    EXPECT_LE(robot.velocity.linear_mps, 0.1) << share;
  }
}

TEST(MissingEchoes, WhatComesNearerThanTheLeastRangeStaysAnObstacle) {
  for (const float said_m : {kInf, 0.0F, kNan, -kInf}) {
    for (const double radius_m : {0.04, 0.1}) {
      TestRobot robot;
      robot.scene.discs = {{{2.5, 0.0}, radius_m}};
      robot.spoil = [said_m](Sweep& sweep, bool) {
        for (float& range_m : sweep.ranges_m) {
          range_m = range_m < 0.5F ? said_m : range_m;
        }
      };
      robot.settle();
      robot.drive({0.5, 0.0}, 8.0);
      EXPECT_GT(robot.clearance(), 0.0) << said_m << " " << radius_m;
    }
  }
}

TEST(MissingEchoes, LidarThatNeverSawIsNotTrustedWhenTheOtherOneSees) {
  TestRobot robot;
  robot.scene.walls = {{{-2.0, -1.0}, {-2.0, 1.0}}, {{5.0, -1.0}, {5.0, 1.0}}};
  spoil(robot, false, 0.0, kTestPi, kInf);
  const Decision decision = robot.drive({0.5, 0.0}, 3.0);
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
  EXPECT_EQ(decision.zone, Zone::kBlind);
  EXPECT_TRUE(is_said(decision, "front LiDAR")) << decision.message.text;
}

TEST(MissingEchoes, OtherLidarContradictsAnEmptySide) {
  TestRobot robot;
  robot.scene.walls = {{{-3.0, 1.5}, {3.0, 1.5}}, {{2.5, -3.0}, {2.5, -1.0}}};
  spoil(robot, false, 90.0 * kDegree, 45.0 * kDegree, kInf);
  const Decision decision = robot.drive({0.5, 0.0}, 1.0);
  EXPECT_EQ(decision.zone, Zone::kBlind);
  EXPECT_TRUE(is_said(decision, "front LiDAR")) << decision.message.text;
}

LocalizedMap map_of(const std::vector<Wall>& walls) {
  auto map = std::make_shared<SiteMap>();
  for (const Wall& wall : walls) {
    const double length_m = distance_m(wall.start, wall.end);
    for (double at_m = 0.0; at_m <= length_m; at_m += 0.05) {
      const double share = at_m / length_m;
      map->occupied.push_back({wall.start.x_m + share * (wall.end.x_m - wall.start.x_m),
                               wall.start.y_m + share * (wall.end.y_m - wall.start.y_m)});
    }
  }
  return {map, Pose()};
}

TEST(MissingEchoes, MapContradictsALidarThatIsCoveredFromTheStart) {
  for (const double half_deg : {180.0, 45.0, 12.0}) {
    TestRobot robot(false);
    robot.scene.walls = lot();
    robot.map = map_of(lot());
    robot.world_from_base = robot.odom_from_base = Pose(2.0, 1.0, 0.3);
    spoil(robot, false, 0.0, half_deg * kDegree, kInf);
    const Decision decision = robot.drive({0.5, 0.0}, 20.0);
    EXPECT_GT(robot.clearance(), 0.0);
    EXPECT_EQ(decision.zone, Zone::kBlind) << half_deg;
  }
}

TEST(MissingEchoes, MapOfWhatHasLeftDoesNotStopTheRobotThatSeesBehindIt) {
  TestRobot robot;
  robot.scene.walls = lot();
  std::vector<Wall> before = lot();
  before.push_back({{3.0, -2.0}, {3.0, 2.0}});
  robot.map = map_of(before);
  robot.settle();
  drive_without_a_stop(robot, {0.5, 0.0}, 8.0);
}

TEST(MissingEchoes, CoveredSectorIsRememberedWhenThePositionIsLostBecauseOfIt) {
  for (const double half_deg : {20.0, 45.0, 180.0}) {
    TestRobot robot;
    robot.scene.walls = lot(5.0);
    robot.map = LocalizedMap{nullptr, Pose()};
    robot.drive({0.3, 0.0}, 1.0);
    spoil(robot, false, 0.0, half_deg * kDegree, kInf);
    robot.drive({0.3, 0.0}, 3.0);
    robot.map.reset();
    const Decision decision = robot.drive({0.5, 0.0}, 10.0, true);
    EXPECT_EQ(decision.zone, Zone::kBlind) << half_deg;
    EXPECT_GT(robot.clearance(), 3.0) << half_deg;
  }
}

TEST(CutView, SweepsWithoutAPartOfTheViewAreCovered) {
  for (const bool is_first : {true, false}) {
    TestRobot robot;
    robot.scene.walls = lot();
    robot.settle();
    robot.spoil = [is_first](Sweep& sweep, bool is_rear) {
      if (is_rear) {
        return;
      }
      auto& ranges = sweep.ranges_m;
      const auto half = static_cast<std::ptrdiff_t>(ranges.size() / 2);
      sweep.angle_min_rad = is_first ? 0.0 : sweep.angle_min_rad;
      is_first ? ranges.erase(ranges.begin(), ranges.begin() + half)
               : ranges.erase(ranges.begin() + half, ranges.end());
    };
    const Decision decision = robot.drive({0.4, 0.0}, 1.0);
    EXPECT_EQ(decision.velocity.linear_mps, 0.0);
    EXPECT_TRUE(is_said(decision, is_first ? "from -115 to 0 degrees" : "from 0 to 115 degrees"))
        << decision.message.text;
  }
}

TEST(CutView, SweepsOfFewBeamsAreRefused) {
  for (const std::size_t beams : {std::size_t{20}, std::size_t{72}, std::size_t{130}}) {
    TestRobot robot;
    robot.scene.walls = lot();
    robot.scene.beams = beams;
    const Decision decision = robot.drive({0.4, 0.0}, 1.0);
    EXPECT_EQ(decision.velocity.linear_mps, 0.0);
    EXPECT_TRUE(is_said(decision, "beam each")) << decision.message.text;
  }
}

}  // namespace
}  // namespace mtr_drive_control
