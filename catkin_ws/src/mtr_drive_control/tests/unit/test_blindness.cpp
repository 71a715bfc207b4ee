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
