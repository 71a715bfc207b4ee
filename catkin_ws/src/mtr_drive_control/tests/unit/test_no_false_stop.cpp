/// @file
/// Objects that leave, turn out of view or never existed do not stop the robot.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "spoilt_scans.hpp"

namespace mtr_drive_control {
namespace {

TEST(NoFalseStop, OpenFieldIsDrivenWithoutAnEcho) {
  TestRobot robot;
  robot.settle();
  drive_without_a_stop(robot, {0.6, 0.2}, 10.0);
}

TEST(NoFalseStop, PersonWhoWalksAwayInAnOpenFieldLeavesAFreeWay) {
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

TEST(NoFalseStop, PersonsWhoCrossAnOpenFieldLeaveNothingBehind) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const bool has_rear : {true, false}) {
    for (int run = 0; run < 20; ++run) {
      TestRobot robot(has_rear);
      const double speed_mps = 1.4 + 0.6 * unit(random);
      const double heading_rad = kTestPi * unit(random);
      const Point middle{2.0 * unit(random), 2.0 * unit(random)};
      // Without a rear LiDAR a curve needs ground that was seen.
      const double turn_radps = 0.5 * unit(random);
      const Velocity wanted{0.4 + 0.3 * unit(random), has_rear ? turn_radps : 0.0};
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
      if (robot.clearance() < 4.0) {
        continue;
      }
      robot.scene.discs = {};
      EXPECT_EQ(robot.drive(wanted, 0.1).zone, Zone::kClear) << "run " << run << " " << robot.step(wanted).message.text;
    }
  }
}

TEST(NoFalseStop, CarThatDrivesAwayInAnOpenFieldLeavesAFreeWay) {
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

TEST(NoFalseStop, SlippingTurnBesideAWallInAnOpenFieldIsNoFault) {
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

TEST(NoFalseStop, CarIsDrivenRoundWithoutAStop) {
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

TEST(NoFalseStop, SomethingThatPassesInFrontShowsThatTheLidarWorks) {
  TestRobot robot;
  lose_wall_ahead(robot);
  for (double y = 4.0; y > -4.0; y -= 0.02) {
    robot.scene.discs = {{{1.3, y}, 0.1}};
    robot.step({0.0, 0.0});
  }
  robot.scene.discs.clear();
  EXPECT_EQ(robot.drive({0.0, 0.0}, 1.5).zone, Zone::kClear);
}

TEST(NoFalseStop, ThingThatVanishedIsGivenUpAfterARest) {
  TestRobot robot;
  robot.scene.discs = {{{1.5, 0.0}, 0.025}};
  robot.settle();
  robot.drive({0.4, 0.0}, 4.0);
  robot.scene.discs.clear();
  EXPECT_EQ(robot.drive({0.4, 0.0}, 25.0).velocity.linear_mps, 0.0);
  robot.drive({0.0, 0.0}, 21.0);
  EXPECT_GT(robot.drive({0.4, 0.0}, 2.0).velocity.linear_mps, 0.1);
}

TEST(NoFalseStop, SurfaceThatVanishedIsGivenUpAfterARest) {
  TestRobot robot;
  lose_wall_ahead(robot);
  ASSERT_EQ(robot.drive({0.0, 0.0}, 14.0).zone, Zone::kBlind);
  robot.drive({0.0, 0.0}, 3.0);
  EXPECT_GT(robot.drive({0.2, 0.0}, 1.0).velocity.linear_mps, 0.1);
}

TEST(NoFalseStop, WhatMovedWhileTheProcessWasStoppedIsForgotten) {
  for (const bool is_carried : {true, false}) {
    TestRobot robot;
    robot.scene.walls = wall_at(2.5);
    robot.settle();
    robot.drive({0.2, 0.0}, 1.0);
    (is_carried ? robot.world_from_base : robot.odom_from_base) = Pose(-40.0, 0.0, 2.0);
    robot.now_ns += 2'000'000'000;
    robot.drive({0.0, 0.0}, 1.0);
    drive_without_a_stop(robot, {0.2, 0.0}, 5.0);
  }
}

TEST(NoFalseStop, RobotThatWasCarriedGoesOnWhenItHasLostItsPosition) {
  TestRobot robot;
  robot.scene.walls = lot(5.0);
  robot.map = LocalizedMap{nullptr, Pose()};
  robot.drive({0.3, 0.0}, 2.0);
  robot.scene.walls = {{{-3.0, 1.2}, {-3.0, 9.0}}, {{-2.0, -3.0}, {6.0, -3.0}}};
  robot.drive({0.0, 0.0}, 0.3);
  robot.map.reset();
  robot.drive({0.0, 0.0}, 0.2);
  drive_without_a_stop(robot, {0.3, 0.0}, 3.0);
}

TEST(NoFalseStop, GroundThatTheLidarsMeetWhileTheRobotNodsIsNoSurface) {
  TestRobot robot;
  robot.settle();
  robot.drive({0.5, 0.0}, 2.0);
  for (int nod = 0; nod < 20; ++nod) {
    for (int tick = 0; tick < 24; ++tick) {
      const double at_m = robot.world_from_base.position().x_m + 2.0 + 0.3 * std::abs(tick - 12);
      robot.scene.walls = {{{at_m, -2.0}, {at_m, 2.0}}};
      ASSERT_NE(robot.step({0.5, 0.0}).zone, Zone::kBlind);
    }
    robot.scene.walls.clear();
    drive_without_a_stop(robot, {0.5, 0.0}, 2.0);
  }
}

TEST(NoFalseStop, SurfaceThatLeavesTheReachOfTheLidarIsNoFault) {
  for (const double range_max_m : {6.0, 10.0, 20.0}) {
    TestRobot robot;
    robot.scene.range_max_m = range_max_m;
    robot.scene.walls = {{{range_max_m - 0.6, -8.0}, {range_max_m - 0.6, 8.0}}, {{-4.0, 4.0}, {4.0, 4.0}}};
    robot.settle();
    drive_without_a_stop(robot, {-0.3, 0.0}, 10.0);
    drive_without_a_stop(robot, {0.3, 0.1}, 10.0);
  }
}

}  // namespace
}  // namespace mtr_drive_control
