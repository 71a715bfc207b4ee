/// @file
/// Wide movers, possible persons and the slow zone around them.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kSlowMps = 0.3;

/// Returns side and front of an object 0.7 m wide and 1.1 m long, centred at this place, along y.
std::vector<Wall> wheelchair_at(double x_m, double y_m) {
  const double low_x = x_m - 0.35;
  const double high_x = x_m + 0.35;
  const double low_y = y_m - 0.55;
  const double high_y = y_m + 0.55;
  return {{{low_x, low_y}, {high_x, low_y}},
          {{high_x, low_y}, {high_x, high_y}},
          {{high_x, high_y}, {low_x, high_y}},
          {{low_x, high_y}, {low_x, low_y}}};
}

std::vector<Disc> legs_at(double x_m, double y_m) { return {{{x_m, y_m - 0.1}, 0.07}, {{x_m, y_m + 0.1}, 0.07}}; }

/// Returns a map of free ground around the origin, except for an occupied square around a place.
std::shared_ptr<const SiteMap> map_with(const Point& occupied, double half_side_m) {
  constexpr double kCellM = 0.1;
  constexpr std::size_t kSide = 200;
  auto map = std::make_shared<SiteMap>();
  map->free = {Pose(-10.0, -10.0, 0.0), kCellM, kSide, std::vector<bool>(kSide * kSide, true)};
  for (std::size_t cell = 0; cell < kSide * kSide; ++cell) {
    const Point at = map->free.map_from_grid.apply(
        {(static_cast<double>(cell % kSide) + 0.5) * kCellM, (static_cast<double>(cell / kSide) + 0.5) * kCellM});
    if (std::abs(at.x_m - occupied.x_m) < half_side_m && std::abs(at.y_m - occupied.y_m) < half_side_m) {
      map->free.cells[cell] = false;
      map->occupied.push_back(at);
    }
  }
  return map;
}

/// Rolls a wheelchair from the left across the path of the robot; fails on contact while the robot moves.
void meet_wheelchair(TestRobot& robot, double robot_mps, double mover_mps) {
  robot.scene.walls = wheelchair_at(2.0, 4.5);
  robot.drive({0.0, 0.0}, 0.6);
  for (double y_m = 4.5; y_m > -4.0; y_m -= mover_mps * 0.02) {
    robot.scene.walls = wheelchair_at(2.0, y_m);
    robot.step({robot_mps, 0.0});
    if (robot.clearance() <= 0.0) {
      ASSERT_EQ(robot.velocity.linear_mps, 0.0) << robot_mps << " m/s, met at " << mover_mps << " m/s, y " << y_m;
      return;
    }
  }
}

TEST(WideMover, ThatRollsInFromTheSideIsNotTouchedByTheMovingRobot) {
  for (const double robot_mps : {0.3, 0.45, 0.8}) {
    for (const double mover_mps : {0.6, 1.5}) {
      TestRobot robot;
      meet_wheelchair(robot, robot_mps, mover_mps);
    }
  }
}

TEST(WideMover, ThatWasSeenToComeIsPassedLikeAPersonWhenItStands) {
  for (const bool has_come : {true, false}) {
    TestRobot robot;
    robot.settle();
    robot.drive({0.0, 0.0}, 1.0);
    for (double y_m = has_come ? 4.0 : 1.5; y_m > 1.5; y_m -= 0.02) {
      robot.scene.walls = wheelchair_at(2.0, y_m);
      robot.step({0.0, 0.0});
    }
    robot.scene.walls = wheelchair_at(2.0, 1.5);
    if (!has_come) {
      // It has always been there, because the process starts with it.
      robot.control = DriveControl(Parameters{}, CollisionParameters{}, test_shape(true), 0.02);
      robot.now_ns += 10 * kTestPeriodNs;
    }
    robot.drive({0.0, 0.0}, 1.5);
    double fastest_mps = 0.0;
    while (robot.world_from_base.position().x_m < 2.0 && robot.now_ns < 60'000'000'000) {
      fastest_mps = std::max(fastest_mps, robot.step({0.8, 0.0}).velocity.linear_mps);
    }
    EXPECT_GE(robot.world_from_base.position().x_m, 2.0);
    if (has_come) {
      EXPECT_LE(fastest_mps, kSlowMps + 1e-9);
    } else {
      EXPECT_DOUBLE_EQ(fastest_mps, 0.8);
    }
  }
}

TEST(WideMover, ThatHasAlwaysBeenThereIsNoneOnlyWhereTheMapShowsIt) {
  for (const bool is_mapped : {true, false}) {
    TestRobot robot;
    robot.scene.walls = wheelchair_at(2.0, 1.2);
    robot.map = LocalizedMap{map_with({2.0, 1.2}, is_mapped ? 0.7 : 0.0), Pose()};
    robot.drive({0.0, 0.0}, 0.5);
    const Decision decision = robot.drive({0.8, 0.0}, 1.0);
    EXPECT_EQ(decision.zone, is_mapped ? Zone::kClear : Zone::kSlowed);
    EXPECT_NEAR(decision.velocity.linear_mps, is_mapped ? 0.8 : kSlowMps, 0.11);
  }
}

TEST(SlowZone, BeginsTwoMetresFromAPersonWhoWasSeenToComeAndEndsBehind) {
  TestRobot robot;
  robot.settle();
  robot.drive({0.0, 0.0}, 1.0);
  for (double y_m = 3.5; y_m > 1.6; y_m -= 0.02) {
    robot.scene.discs = legs_at(4.0, y_m);
    robot.step({0.0, 0.0});
  }
  // The duration of the person's stay does not matter.
  robot.drive({0.0, 0.0}, 12.0);
  bool was_slow = false;
  while (robot.world_from_base.position().x_m < 8.0) {
    ASSERT_LT(robot.now_ns, 120'000'000'000);
    const Decision decision = robot.step({0.8, 0.0});
    if (robot.clearance() < 1.9) {
      was_slow = true;
      ASSERT_LE(robot.velocity.linear_mps, kSlowMps + 1e-9) << robot.clearance();
      ASSERT_EQ(decision.zone, Zone::kSlowed);
      ASSERT_TRUE(decision.hindrance);
    }
  }
  EXPECT_TRUE(was_slow);
  EXPECT_DOUBLE_EQ(robot.velocity.linear_mps, 0.8);
}

TEST(SlowZone, LimitsTheCornersOfATurnOnTheSpot) {
  TestRobot robot;
  robot.settle();
  robot.drive({0.0, 0.0}, 1.0);
  for (double y_m = 3.5; y_m > 1.9; y_m -= 0.02) {
    robot.scene.discs = legs_at(0.0, y_m);
    robot.step({0.0, 0.0});
  }
  robot.drive({0.0, 0.0}, 1.5);
  const double radius_m = robot.control.footprint().radius_m();
  EXPECT_NEAR(robot.drive({0.0, 1.4}, 0.5).velocity.angular_radps, kSlowMps / radius_m, 0.01);
}

TEST(SlowZone, IsNoneAroundAPostThatHasAlwaysBeenThereNorWithAContactSkirt) {
  for (const bool has_skirt : {false, true}) {
    TestRobot robot;
    CollisionParameters collision;
    collision.contact_skirt = has_skirt;
    robot.control = DriveControl(Parameters{}, collision, test_shape(true), 0.02);
    robot.scene.discs = legs_at(3.0, 2.0);
    robot.settle();
    if (has_skirt) {
      for (double y_m = 3.5; y_m > 2.0; y_m -= 0.02) {
        robot.scene.discs = legs_at(3.0, y_m);
        robot.step({0.0, 0.0});
      }
    }
    double slowest_mps = 1.0;
    robot.drive({0.8, 0.0}, 1.0);
    for (int tick = 0; tick < 200; ++tick) {
      slowest_mps = std::min(slowest_mps, robot.step({0.8, 0.0}).velocity.linear_mps);
    }
    EXPECT_GT(slowest_mps, 0.75) << has_skirt;
  }
}

TEST(SlowZone, HoldsWhileAPersonIsHiddenForAMoment) {
  TestRobot robot;
  robot.settle();
  robot.drive({0.0, 0.0}, 1.0);
  for (double y_m = 3.5; y_m > 1.7; y_m -= 0.02) {
    robot.scene.discs = legs_at(0.5, y_m);
    robot.step({0.0, 0.0});
  }
  robot.drive({0.3, 0.0}, 0.5);
  robot.scene.discs.clear();
  EXPECT_LE(robot.drive({0.8, 0.0}, 0.8).velocity.linear_mps, kSlowMps + 1e-9);
  // A wall seen behind the person's place proves that it is free.
  robot.scene.walls = {{{-9.0, 6.0}, {9.0, 6.0}}};
  EXPECT_GT(robot.drive({0.8, 0.0}, 2.5).velocity.linear_mps, 0.7);
}

TEST(SiteMapGround, IsFreeOnlyWhereAllAroundWasSeenFree) {
  const auto map = map_with({2.0, 0.0}, 0.3);
  EXPECT_TRUE(map->is_free_around({0.0, 0.0}, 0.4));
  EXPECT_FALSE(map->is_free_around({2.0, 0.0}, 0.4));
  EXPECT_FALSE(map->is_free_around({2.6, 0.0}, 0.4));
  EXPECT_TRUE(map->is_free_around({2.85, 0.0}, 0.4));
  for (const double outside_m :
       {9.8, 12.0, -9.8, -12.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(map->is_free_around({outside_m, 0.0}, 0.4)) << outside_m;
    EXPECT_FALSE(map->is_free_around({0.0, outside_m}, 0.4)) << outside_m;
  }
  EXPECT_FALSE(SiteMap{}.is_free_around({0.0, 0.0}, 0.4));
}

TEST(SteadyHeading, FollowsTheGyroWhereTheWheelsSlip) {
  SteadyFrame frame;
  constexpr double kRateRadps = 0.5;
  std::int64_t now_ns = 5'000 * kTestMs;
  frame.follow({now_ns, Pose(), {}}, 0.0);
  for (int tick = 1; tick <= 50; ++tick) {
    now_ns += kTestPeriodNs;
    // The wheels show a quarter more.
    const double by_wheels_rad = 1.25 * kRateRadps * 0.02 * tick;
    EXPECT_TRUE(frame.follow({now_ns, Pose(0.0, 0.0, by_wheels_rad), {0.0, 1.25 * kRateRadps}}, kRateRadps));
  }
  EXPECT_NEAR(frame.motion().odom_from_base.heading_rad(), kRateRadps, 1e-9);
}

TEST(SteadyHeading, BeginsAgainWithoutAGyroInATurnAndAfterAGapOrAJump) {
  struct Step {
    std::int64_t pause_ns;
    Pose pose;
    double angular_radps;
    std::optional<double> gyro_radps;
    bool continues;
  };
  for (const auto& [pause_ns, pose, angular_radps, gyro_radps, continues] :
       {Step{kTestPeriodNs, Pose(0.02, 0.0, 0.0), 0.0, std::nullopt, true},
        Step{kTestPeriodNs, Pose(0.0, 0.0, 0.02), 1.0, std::nullopt, false},
        Step{kTestPeriodNs, Pose(0.0, 0.0, 0.02), 1.0, 1.0, true},
        Step{kTestPeriodNs, Pose(2.0, 0.0, 0.0), 0.0, 0.0, false}, Step{500 * kTestMs, Pose(), 0.0, 0.0, false},
        Step{-kTestPeriodNs, Pose(), 0.0, 0.0, false}}) {
    SteadyFrame frame;
    const std::int64_t now_ns = 5'000 * kTestMs;
    frame.follow({now_ns, Pose(), {}}, 0.0);
    EXPECT_EQ(frame.follow({now_ns + pause_ns, pose, {0.0, angular_radps}}, gyro_radps), continues)
        << pause_ns << " " << pose.position().x_m << " " << angular_radps;
  }
}

}  // namespace
}  // namespace mtr_drive_control
