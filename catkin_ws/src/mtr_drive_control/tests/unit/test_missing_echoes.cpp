/// @file
/// Echoes that are missing: covered, dirty and dazzled LiDARs, targets too near to be measured, and what really left.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "scene.hpp"

namespace mtr_drive_control {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kDegree = kTestPi / 180.0;

std::vector<Wall> lot() {
  return {
      {{-9.0, -9.0}, {9.0, -9.0}}, {{9.0, -9.0}, {9.0, 9.0}}, {{9.0, 9.0}, {-9.0, 9.0}}, {{-9.0, 9.0}, {-9.0, -9.0}}};
}

std::vector<Wall> wall_at(double x_m) { return {{{x_m, -3.0}, {x_m, 3.0}}}; }

/// A LiDAR returns this within so much of a direction in its frame.
void spoil(TestRobot& robot, bool is_rear, double direction_rad, double half_rad, float said_m) {
  robot.spoil = [=](Sweep& sweep, bool rear) {
    for (std::size_t beam = 0; rear == is_rear && beam < sweep.ranges_m.size(); ++beam) {
      if (std::abs(sweep.angle_of(beam) - direction_rad) <= half_rad) {
        sweep.ranges_m[beam] = said_m;
      }
    }
  };
}

bool is_said(const Decision& decision, const std::string& what) {
  return decision.message.text.find(what) != std::string::npos;
}

/// Drives for a while; fails when it touches something, or is blind.
void drive_without_a_stop(TestRobot& robot, const Velocity& desired, double duration_s) {
  for (int tick = 0; tick < std::lround(duration_s / 0.02); ++tick) {
    const Decision decision = robot.step(desired);
    ASSERT_NE(decision.zone, Zone::kBlind) << decision.message.text << " after " << tick;
    ASSERT_GT(robot.clearance(), 0.0) << tick;
  }
}

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
  robot.scene.walls = lot();
  robot.settle();
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

TEST(MissingEchoes, OpenFieldIsDrivenWithoutAnEcho) {
  TestRobot robot;
  robot.settle();
  drive_without_a_stop(robot, {0.6, 0.2}, 10.0);
}

TEST(MissingEchoes, PersonWhoWalksAwayInAnOpenFieldLeavesAFreeWay) {
  for (const double heading_deg : {0.0, 45.0, 90.0, -90.0}) {
    for (const double speed_mps : {0.4, 1.0, 1.8}) {
      TestRobot robot;
      const auto stand_at = [&](double x_m, double y_m) {
        robot.scene.discs = {{{x_m, y_m - 0.12}, 0.06}, {{x_m, y_m + 0.12}, 0.06}};
      };
      stand_at(1.1, 0.0);
      robot.settle();
      robot.drive({0.5, 0.0}, 4.0);
      for (int tick = 0; tick < 300; ++tick) {
        const double way_m = speed_mps * 0.02 * tick;
        stand_at(1.1 + way_m * std::cos(heading_deg * kDegree), way_m * std::sin(heading_deg * kDegree));
        const Decision decision = robot.step({heading_deg == 0.0 ? 0.0 : 0.5, 0.0});
        ASSERT_NE(decision.zone, Zone::kBlind) << decision.message.text << " " << heading_deg << " " << speed_mps;
      }
      if (heading_deg != 0.0 && speed_mps > 0.5) {
        EXPECT_GT(robot.velocity.linear_mps, 0.1) << heading_deg << " " << speed_mps;
      }
    }
  }
}

TEST(MissingEchoes, PersonsWhoCrossAnOpenFieldLeaveNothingBehind) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const bool has_rear : {true, false}) {
    for (int run = 0; run < 15; ++run) {
      TestRobot robot(has_rear);
      const double speed_mps = 1.4 + 0.6 * unit(random);
      const double heading_rad = kTestPi * unit(random);
      const Point middle{2.0 * unit(random), 2.0 * unit(random)};
      const Velocity wanted{0.4 + 0.3 * unit(random), 0.5 * unit(random)};
      robot.settle();
      for (int tick = 0; tick < 500; ++tick) {
        const double way_m = speed_mps * 0.02 * (tick - 150);
        const double stride_m = 0.3 * std::sin(5.0 * speed_mps * 0.02 * tick);
        const double c = std::cos(heading_rad);
        const double s = std::sin(heading_rad);
        robot.scene.discs = {
            {{middle.x_m + (way_m + stride_m) * c - 0.1 * s, middle.y_m + (way_m + stride_m) * s + 0.1 * c}, 0.06},
            {{middle.x_m + (way_m - stride_m) * c + 0.1 * s, middle.y_m + (way_m - stride_m) * s - 0.1 * c}, 0.06}};
        if (robot.clearance() < 0.2) {
          break;
        }
        const Decision decision = robot.step(wanted);
        ASSERT_NE(decision.zone, Zone::kBlind) << decision.message.text << " run " << run << " at " << tick;
      }
      if (robot.clearance() < 3.0) {
        continue;
      }
      robot.scene.discs = {};
      EXPECT_EQ(robot.drive(wanted, 0.1).zone, Zone::kClear) << "run " << run << " " << robot.step(wanted).message.text;
    }
  }
}

TEST(MissingEchoes, CarThatDrivesAwayInAnOpenFieldLeavesAFreeWay) {
  for (const double speed_mps : {0.5, 1.0, 3.0}) {
    TestRobot robot;
    const auto park_at = [&](double y_m) {
      robot.scene.walls = {{{2.0, y_m - 2.2}, {2.0, y_m + 2.2}},
                           {{2.0, y_m - 2.2}, {3.8, y_m - 2.2}},
                           {{2.0, y_m + 2.2}, {3.8, y_m + 2.2}},
                           {{3.8, y_m - 2.2}, {3.8, y_m + 2.2}}};
    };
    park_at(0.0);
    robot.settle();
    robot.drive({0.4, 0.0}, 6.0);
    for (int tick = 0; tick < 300; ++tick) {
      park_at(speed_mps * 0.02 * tick);
      const Decision decision = robot.step({0.4, 0.0});
      ASSERT_NE(decision.zone, Zone::kBlind) << decision.message.text << " " << speed_mps;
    }
    if (speed_mps > 1.0) {
      EXPECT_GT(robot.velocity.linear_mps, 0.1);
    }
  }
}

TEST(MissingEchoes, SlippingTurnBesideAWallInAnOpenFieldIsNoFault) {
  for (const double grip : {0.7, 0.85, 1.0, 1.15}) {
    for (const bool has_rear : {true, false}) {
      TestRobot robot(has_rear);
      robot.grip = grip;
      robot.scene.walls = {{{-2.0, 1.2}, {3.0, 1.2}}, {{3.0, 1.2}, {3.0, 3.0}}, {{-6.0, -9.0}, {6.0, -9.0}}};
      robot.settle();
      robot.drive({0.5, 0.0}, 1.0);
      drive_without_a_stop(robot, {0.0, 0.9}, 8.0);
      drive_without_a_stop(robot, {0.3, -0.9}, 8.0);
    }
  }
}

TEST(MissingEchoes, CarIsDrivenRoundWithoutAStop) {
  for (const bool has_rear : {true, false}) {
    TestRobot robot(has_rear);
    robot.grip = 0.8;
    robot.scene.noise_m = 0.02;
    robot.scene.walls = {
        {{-2.2, -0.9}, {2.2, -0.9}}, {{2.2, -0.9}, {2.2, 0.9}}, {{2.2, 0.9}, {-2.2, 0.9}}, {{-2.2, 0.9}, {-2.2, -0.9}}};
    robot.world_from_base = Pose(0.0, -3.2, 0.0);
    robot.settle();
    drive_without_a_stop(robot, {0.6, 0.6 / 3.2 / 0.8}, 30.0);
  }
}

TEST(MissingEchoes, SomethingThatPassesInFrontShowsThatTheLidarWorks) {
  TestRobot robot;
  robot.scene.walls = wall_at(2.5);
  robot.settle();
  robot.drive({0.2, 0.0}, 1.0);
  robot.scene.walls.clear();
  ASSERT_EQ(robot.drive({0.2, 0.0}, 5.0).zone, Zone::kBlind);
  for (double y = 4.0; y > -4.0; y -= 0.02) {
    robot.scene.discs = {{{1.3, y}, 0.1}};
    robot.step({0.0, 0.0});
  }
  robot.scene.discs.clear();
  EXPECT_EQ(robot.drive({0.0, 0.0}, 1.5).zone, Zone::kClear);
}

TEST(MissingEchoes, ThingThatVanishedIsGivenUpAfterARest) {
  TestRobot robot;
  robot.scene.discs = {{{1.5, 0.0}, 0.025}};
  robot.settle();
  robot.drive({0.4, 0.0}, 4.0);
  robot.scene.discs.clear();
  EXPECT_EQ(robot.drive({0.4, 0.0}, 25.0).velocity.linear_mps, 0.0);
  robot.drive({0.0, 0.0}, 21.0);
  EXPECT_GT(robot.drive({0.4, 0.0}, 2.0).velocity.linear_mps, 0.1);
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
