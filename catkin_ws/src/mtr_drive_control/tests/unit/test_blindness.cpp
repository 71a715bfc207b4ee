/// @file
/// Blind LiDARs and silent odometry.
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

/// Replaces the ranges of the front or rear LiDAR around a direction.
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
      const Decision decision = robot.drive({0.5, 0.0}, 0.6);
      EXPECT_EQ(decision.velocity.linear_mps, 0.0) << said_m;
      const long from_deg = std::lround(direction_rad / kDegree - 6.0);
      EXPECT_NE(decision.message.text.find("The front LiDAR is covered or dirty from " + std::to_string(from_deg)),
                std::string::npos)
          << decision.message.text;
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

TEST(LidarWatch, TimesThatNoSweepHasAreRefusedBeforeTheyMakeItLookSilent) {
  const auto problem_of = [](double increment_s, double scan_time_s, std::int64_t age_ns) {
    auto sweep = std::make_shared<Sweep>(*sweep_at(0));
    sweep->time_increment_s = increment_s;
    sweep->scan_time_s = scan_time_s;
    LidarWatch lidar = watch();
    lidar.take(sweep);
    return lidar.problem_at(age_ns).code;
  };
  for (const double increment_s : {1e30, -1e30, 1.0, 0.4 / 719, -1e-6, std::numeric_limits<double>::max()}) {
    EXPECT_EQ(problem_of(increment_s, 0.0, 1000 * kTestMs), "drive_control.lidar_sweep_time") << increment_s;
  }
  EXPECT_EQ(problem_of(0.2 / 719, 0.0, 60 * kTestMs), "");
  // Turn of a 15 Hz LiDAR, and firmware that states three times the time between beams.
  EXPECT_EQ(problem_of(3.0 * 0.05 / 719, 1.0 / 15.0, 150 * kTestMs), "drive_control.lidar_time_increment");
  EXPECT_EQ(problem_of(0.05 / 719, 1.0 / 15.0, 60 * kTestMs), "");
  EXPECT_EQ(problem_of(0.05 / 719, 1.0 / 15.0, 150 * kTestMs), "drive_control.lidar_silent");
}

}  // namespace
}  // namespace mtr_drive_control
