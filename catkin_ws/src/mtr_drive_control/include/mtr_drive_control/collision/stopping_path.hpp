/// @file
/// Path of the robot during a stop.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mtr_drive_control/geometry.hpp"

namespace mtr_drive_control {

struct Deceleration {
  double linear_mps2;
  double angular_radps2;
};

/// Pose in the current base_link, and the time from now until the robot is there.
struct PathPoint {
  Pose pose;
  double time_s;
};

/// Maximum motion of a corner of the robot between consecutive poses of a stopping path; the arc in between deviates by
/// at most 4 mm.
inline constexpr double kPathStepM = 0.1;

/// Returns the poses from now to standstill: constant velocity during the reaction, then uniform braking along its
/// circle.
std::vector<PathPoint> stopping_path(const Velocity& velocity, const Deceleration& deceleration, double reaction_s,
                                     double radius_m);

}  // namespace mtr_drive_control
