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

/// Poses from now to standstill: the velocity is kept for the reaction, then reduced evenly along its own circle.
///
/// No corner of a robot of this radius moves more than 0.1 m from one pose to the next.
std::vector<PathPoint> stopping_path(const Velocity& velocity, const Deceleration& deceleration, double reaction_s,
                                     double radius_m);

}  // namespace mtr_drive_control
