/// @file
/// Scans of LiDARs that are covered or dazzled, for tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "scene.hpp"

namespace mtr_drive_control {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kDegree = kTestPi / 180.0;

/// Four walls at this distance from the centre.
inline std::vector<Wall> lot(double half_m = 9.0) {
  return {{{-half_m, -half_m}, {half_m, -half_m}},
          {{half_m, -half_m}, {half_m, half_m}},
          {{half_m, half_m}, {-half_m, half_m}},
          {{-half_m, half_m}, {-half_m, -half_m}}};
}

inline std::vector<Wall> wall_at(double x_m) { return {{{x_m, -3.0}, {x_m, 3.0}}}; }

/// Makes a LiDAR return this range around a direction in its frame.
inline void spoil(TestRobot& robot, bool is_rear, double direction_rad, double half_rad, float said_m) {
  robot.spoil = [=](Sweep& sweep, bool rear) {
    for (std::size_t beam = 0; rear == is_rear && beam < sweep.ranges_m.size(); ++beam) {
      if (std::abs(sweep.angle_of(beam) - direction_rad) <= half_rad) {
        sweep.ranges_m[beam] = said_m;
      }
    }
  };
}

/// Removes a wall 2.5 m ahead while the robot drives toward it, without other evidence.
inline void lose_wall_ahead(TestRobot& robot) {
  robot.scene.walls = wall_at(2.5);
  robot.settle();
  robot.drive({0.2, 0.0}, 1.0);
  robot.scene.walls.clear();
  ASSERT_EQ(robot.drive({0.2, 0.0}, 5.0).zone, Zone::kBlind);
}

inline bool is_said(const Decision& decision, const std::string& what) {
  return decision.message.text.find(what) != std::string::npos;
}

/// Drives for some time; fails if the robot touches something, or is blind.
inline void drive_without_a_stop(TestRobot& robot, const Velocity& desired, double duration_s) {
  for (int tick = 0; tick < std::lround(duration_s / 0.02); ++tick) {
    const Decision decision = robot.step(desired);
    ASSERT_NE(decision.zone, Zone::kBlind) << decision.message.text << " after " << tick;
    ASSERT_GT(robot.clearance(), 0.0) << tick;
  }
}

}  // namespace mtr_drive_control
