/// @file
/// LiDARs that see nothing, odometry that is silent, and ground that nobody watches.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene.hpp"

namespace mtr_drive_control {
namespace {

Scene lot() {
  Scene scene;
  scene.noise_m = 0.01;
  scene.walls = {{{-9.0, -9.0}, {9.0, -9.0}}, {{-9.0, 9.0}, {9.0, 9.0}}};
  return scene;
}

LidarWatch watch() { return {"front LiDAR", 0.14}; }

std::shared_ptr<Sweep> sweep_at(std::int64_t stamp_ns) { return lot().sweep(Pose(), stamp_ns); }

TEST(LidarWatch, LiveLidarHasNoProblem) {
  LidarWatch lidar = watch();
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(lidar.take(sweep_at(i * kTestSweepNs)));
  }
  EXPECT_EQ(lidar.problem_at(4 * kTestSweepNs + 60 * kTestMs).text, "");
}

TEST(LidarWatch, LidarNeverHeardIsWaitedFor) { EXPECT_EQ(watch().problem_at(0).text, "Waiting for the front LiDAR."); }

TEST(LidarWatch, SilentLidarIsNamedAfterTheTimeout) {
  LidarWatch lidar = watch();
  lidar.take(sweep_at(0));
  EXPECT_EQ(lidar.problem_at(140 * kTestMs).text, "");
  EXPECT_EQ(lidar.problem_at(160 * kTestMs).text, "The front LiDAR is silent.");
}

TEST(LidarWatch, SameSweepTwiceIsNoNews) {
  LidarWatch lidar = watch();
  const auto sweep = sweep_at(0);
  EXPECT_TRUE(lidar.take(sweep));
  EXPECT_FALSE(lidar.take(sweep));
}

TEST(LidarWatch, FrozenLidarIsFoundByItsThirdEqualSweep) {
  LidarWatch lidar = watch();
  for (int i = 0; i < 3; ++i) {
    auto frozen = std::make_shared<Sweep>(*sweep_at(0));
    frozen->stamp_ns = i * kTestSweepNs;
    EXPECT_EQ(lidar.take(frozen), i < 2);
  }
  EXPECT_EQ(lidar.problem_at(2 * kTestSweepNs).text, "The front LiDAR is frozen: it repeats the same sweep.");
}

TEST(LidarWatch, OpenFieldWithoutEchoesIsNotFrozen) {
  LidarWatch lidar = watch();
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(lidar.take(Scene().sweep(Pose(), i * kTestSweepNs)));
  }
  EXPECT_EQ(lidar.problem_at(9 * kTestSweepNs).text, "");
}

TEST(LidarWatch, BrokenSweepsAreRefusedWithASentence) {
  const auto broken = [](auto change) {
    Sweep sweep = *sweep_at(0);
    change(sweep);
    return defect_of(sweep, "front LiDAR").text;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(defect_of(*sweep_at(0), "front LiDAR").text, "");
  EXPECT_NE(broken([](Sweep& sweep) { sweep.ranges_m.clear(); }), "");
  EXPECT_NE(broken([nan](Sweep& sweep) { sweep.angle_min_rad = nan; }), "");
  EXPECT_NE(broken([](Sweep& sweep) { sweep.angle_increment_rad = 0.0; }), "");
  EXPECT_NE(broken([nan](Sweep& sweep) { sweep.range_max_m = nan; }), "");
  EXPECT_EQ(broken([](Sweep& sweep) { sweep.frame_id = "map"; }),
            "The front LiDAR speaks of frame 'map' and not of ''.");
  EXPECT_EQ(broken([nan](Sweep& sweep) { sweep.ranges_m.assign(720, static_cast<float>(nan)); }),
            "The front LiDAR is covered.");
}

TEST(LidarWatch, SweepFromTheFutureIsRefused) {
  LidarWatch lidar = watch();
  lidar.take(sweep_at(1000 * kTestMs));
  EXPECT_EQ(lidar.problem_at(500 * kTestMs).text, "The front LiDAR sends sweeps from the future.");
}

TEST(Blindness, SilentLidarStopsTheMovingRobotWithinHalfASecond) {
  TestRobot robot;
  robot.scene = lot();
  robot.settle();
  ASSERT_DOUBLE_EQ(robot.drive({0.7, 0.0}, 3.0).velocity.linear_mps, 0.7);
  robot.lidars_are_silent = true;
  const Decision decision = robot.drive({0.7, 0.0}, 0.5);
  EXPECT_EQ(decision.zone, Zone::kBlind);
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
  EXPECT_EQ(decision.message.text, "The front LiDAR is silent.");
}

TEST(Blindness, MissingRearLidarKeepsARobotThatShouldHaveOneStanding) {
  DriveControl control(Parameters{}, CollisionParameters{}, test_shape(true), 0.02);
  Inputs inputs;
  inputs.planner = SourceCommand{1000 * kTestMs, {0.5, 0.0}, true};
  inputs.sensors = {sweep_at(960 * kTestMs), nullptr, Motion{1000 * kTestMs, Pose(), {}}};
  EXPECT_EQ(control.step(1000 * kTestMs, inputs).message.text, "Waiting for the rear LiDAR.");
}

TEST(Blindness, SilentOdometryStopsTheRobot) {
  DriveControl control(Parameters{}, CollisionParameters{}, test_shape(false), 0.02);
  Inputs inputs;
  inputs.planner = SourceCommand{1000 * kTestMs, {0.5, 0.0}, true};
  inputs.sensors = {sweep_at(960 * kTestMs), nullptr, Motion{880 * kTestMs, Pose(), {}}};
  const Decision decision = control.step(1000 * kTestMs, inputs);
  EXPECT_EQ(decision.zone, Zone::kBlind);
  EXPECT_EQ(decision.message.text, "The wheels' odometry is silent.");
}

/// Of the front LiDAR, or the rear one: what it says within so much of a direction.
void hide(TestRobot& robot, bool is_rear, double direction_rad, double half_rad, float range_m) {
  robot.spoil = [=](Sweep& sweep, bool rear) {
    for (std::size_t beam = 0; rear == is_rear && beam < sweep.ranges_m.size(); ++beam) {
      if (std::abs(sweep.angle_of(beam) - direction_rad) < half_rad) {
        const bool is_odd = (static_cast<std::int64_t>(beam) + sweep.stamp_ns / kTestSweepNs) % 2 != 0;
        sweep.ranges_m[beam] = range_m + (is_odd && range_m > 0.0F ? 0.003F : 0.0F);
      }
    }
  };
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kDegree = kTestPi / 180.0;

TEST(CoveredLidar, CapOverItThatLiesWithinTheFootprintStopsTheRobot) {
  for (const float cap_m : {0.06F, 0.11F, 0.14F}) {
    TestRobot robot;
    robot.scene = lot();
    robot.scene.range_min_m = 0.05;
    robot.settle();
    robot.drive({0.5, 0.0}, 1.0);
    hide(robot, false, 0.0, kTestPi, cap_m);
    const Decision decision = robot.drive({0.5, 0.0}, 0.6);
    EXPECT_EQ(decision.velocity.linear_mps, 0.0) << cap_m;
    EXPECT_EQ(decision.message.text, "The front LiDAR is covered.") << cap_m;
  }
}

TEST(CoveredLidar, SectorThatMayHideALegStopsTheRobotAndANarrowOneDoesNot) {
  for (const float said_m : {kNan, 0.0F, 0.11F}) {
    for (const double direction_rad : {0.0, 60.0 * kDegree, -100.0 * kDegree}) {
      TestRobot robot;
      robot.scene = lot();
      hide(robot, false, direction_rad, 4.0 * kDegree, said_m);
      robot.settle();
      EXPECT_EQ(robot.drive({0.5, 0.0}, 0.5).zone, Zone::kClear) << said_m << " at " << direction_rad;
      hide(robot, false, direction_rad, 6.0 * kDegree, said_m);
      EXPECT_EQ(robot.drive({0.5, 0.0}, 0.6).message.text, "The front LiDAR is covered.") << said_m;
    }
  }
}

TEST(CoveredLidar, PersonInASectorThatItDoesNotSeeIsNotTouched) {
  for (const double half_deg : {8.0, 20.0, 40.0, 60.0}) {
    TestRobot robot;
    robot.scene = lot();
    robot.settle();
    hide(robot, false, 0.0, half_deg * kDegree, kNan);
    robot.scene.discs = {{{1.5, 0.0}, 0.1}};
    robot.drive({0.7, 0.0}, 4.0);
    EXPECT_GT(robot.clearance(), 0.2) << half_deg;
  }
}

TEST(CoveredLidar, WhatTheOtherOneWatchesMayBeHidden) {
  for (const bool has_rear : {true, false}) {
    TestRobot robot(has_rear);
    robot.scene = lot();
    hide(robot, false, 126.0 * kDegree, 8.0 * kDegree, kNan);
    robot.settle();
    EXPECT_EQ(robot.drive({0.5, 0.0}, 0.5).zone, has_rear ? Zone::kClear : Zone::kBlind);
  }
}

TEST(TooNearToMeasure, LegAtTheBumperIsNotBackedInto) {
  for (const double range_min_m : {0.1, 0.15, 0.2, 0.5}) {
    for (const double radius_m : {0.035, 0.05}) {
      TestRobot robot;
      robot.scene = lot();
      robot.scene.range_min_m = range_min_m;
      const auto step_up_to = [&](double gap_m) {
        const double rear_m = robot.world_from_base.position().x_m - robot.control.footprint().rear_m;
        robot.scene.discs = {{{rear_m - gap_m - radius_m, 0.0}, radius_m}};
      };
      robot.settle();
      step_up_to(0.6);
      robot.drive({-0.3, 0.0}, 1.0);
      for (int tick = 0; tick < 40; ++tick) {
        step_up_to(0.6 - 0.585 * (tick + 1) / 40.0);
        robot.step({-0.3, 0.0});
      }
      robot.drive({-0.3, 0.0}, 3.0);
      EXPECT_GT(robot.clearance(), 0.005) << range_min_m << " " << radius_m;
    }
  }
}

TEST(TooNearToMeasure, WallAtTheBumperMayBeLeft) {
  TestRobot robot;
  robot.scene.walls = {{{-0.29, -3.0}, {-0.29, 3.0}}};
  robot.settle();
  EXPECT_EQ(robot.drive({-0.3, 0.0}, 1.0).velocity.linear_mps, 0.0);
  robot.drive({0.3, 0.0}, 4.0);
  EXPECT_GT(robot.clearance(), 0.1);
}

TEST(UnwatchedRear, GroundNeverSeenIsNotBackedInto) {
  TestRobot robot(false);
  robot.settle();
  const Decision decision = robot.drive({-0.5, 0.0}, 1.0);
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
  EXPECT_EQ(decision.message.text,
            "Blocked: the ground behind was not seen free lately; turn the robot once on the spot with the manual "
            "controller, so that its LiDAR sees it.");
}

TEST(UnwatchedRear, RobotThatHasTurnedOnceOnTheSpotBacksAgain) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 4.0);
  robot.drive({0.0, 0.0}, 25.0);
  ASSERT_EQ(robot.drive({-0.5, 0.0}, 1.0).velocity.linear_mps, 0.0);
  robot.drive({0.0, 0.6}, 10.5, true);
  robot.drive({0.0, 0.0}, 1.0);
  EXPECT_NEAR(robot.drive({-0.5, 0.0}, 2.0).velocity.linear_mps, -0.3, 1e-9);
}

TEST(UnwatchedRear, OwnTrackIsBackedIntoSlowlyUntilItEnds) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 5.0);
  robot.drive({0.0, 0.0}, 1.0);
  EXPECT_NEAR(robot.drive({-0.8, 0.0}, 2.0).velocity.linear_mps, -0.3, 1e-9);
  EXPECT_EQ(robot.drive({-0.8, 0.0}, 12.0).velocity.linear_mps, 0.0);
  EXPECT_NEAR(robot.world_from_base.position().x_m, 0.0, 0.15);
}

TEST(UnwatchedRear, GroundSeenTooLongAgoIsNotBackedInto) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 4.0);
  robot.drive({0.0, 0.0}, 25.0);
  EXPECT_EQ(robot.drive({-0.5, 0.0}, 1.0).velocity.linear_mps, 0.0);
}

TEST(UnwatchedRear, PersonWhoWalkedOutOfViewBehindStopsBacking) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 4.0);
  const double behind_x = robot.world_from_base.position().x_m - 1.0;
  for (double y = 3.0; y > 0.8; y -= 0.03) {
    robot.scene.discs = {{{behind_x, y}, 0.1}};
    robot.step({0.0, 0.0});
  }
  robot.scene.discs.clear();
  robot.scene.discs = {{{behind_x, 0.0}, 0.1}};
  EXPECT_EQ(robot.drive({-0.3, 0.0}, 1.0).velocity.linear_mps, 0.0);
}

TEST(UnwatchedRear, ThingThatVanishesBehindTheCarBesideTheRobotDoesNotStopBacking) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 4.0);
  const double x = robot.world_from_base.position().x_m;
  robot.scene.discs = {{{x + 0.2, 1.7}, 0.1}};
  robot.drive({0.0, 0.0}, 0.2);
  robot.scene.walls = {{{x - 1.0, 1.2}, {x + 2.0, 1.2}}};
  EXPECT_NEAR(robot.drive({-0.3, 0.0}, 1.5).velocity.linear_mps, -0.3, 1e-9);
}

TEST(UnwatchedRear, PersonAtTheManualControllerMayBackSlowly) {
  TestRobot robot(false);
  robot.settle();
  EXPECT_NEAR(robot.drive({-0.5, 0.0}, 1.0, true).velocity.linear_mps, -0.3, 1e-9);
}

}  // namespace
}  // namespace mtr_drive_control
