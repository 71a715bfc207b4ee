/// @file
/// Where the robot gets when it is stopped from a velocity.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mtr_drive_control/geometry.hpp"

namespace mtr_drive_control {

struct Deceleration {
  double linear_mps2;
  double angular_radps2;
};

/// Pose in the present base_link, and how long from now the robot is there.
struct PathPoint {
  Pose pose;
  double time_s;
};

/// No corner of the robot moves more from one pose of a stopping path to the next; it bulges by 4 mm at most between.
inline constexpr double kPathStepM = 0.1;

/// Poses from now to standstill: the velocity is kept for the reaction, then reduced evenly along its own circle.
std::vector<PathPoint> stopping_path(const Velocity& velocity, const Deceleration& deceleration, double reaction_s,
                                     double radius_m);

}  // namespace mtr_drive_control
