/// @file
/// Parameters of the collision stop: assumptions on persons, and distances; SI units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"

namespace mtr_drive_control {

/// Margins and time-outs; the URDF defines the robot's outline and LiDARs (robot_shape.hpp).
struct CollisionParameters {
  /// Speed at which a possible person may start to walk at any moment; walking speed of ISO 13855.
  double person_speed_mps = 1.6;
  /// Reach of a swinging foot ahead of the body (0.28 m at 1.5 m/s), and overhang of the body over the visible legs.
  double person_reach_m = 0.30;
  /// Distance between the footprint and static surfaces; three times the noise of a range, and slip.
  double gap_m = 0.05;
  /// Time from a decision to braking wheels: one period, and the wheels' response (0.06 s in simulation).
  double reaction_s = 0.08;
  /// Age of a sweep's first beam at which its LiDAR counts as blind; 0.06 s in normal operation.
  double lidar_timeout_s = 0.14;
  double odometry_timeout_s = 0.10;
  /// Time for which the path must be free before the robot resumes.
  double resume_pause_s = 1.0;
  /// Maximum speed away from a stationary thing within a person's reach.
  double creep_mps = 0.1;
  /// Maximum speed of any point of the outline within this distance of a possible person.
  double near_person_m = 2.0;
  double near_person_mps = 0.3;
  /// Without a rear LiDAR: maximum speed backwards, into ground that was seen free within this time.
  double unwatched_reverse_mps = 0.3;
  double ground_memory_s = 20.0;
  /// The base has a contact skirt that stops it on touch; without one the speed near a possible person is limited.
  bool contact_skirt = false;
};

using CollisionRow = mtr_core::ParameterRow<CollisionParameters>;

inline constexpr std::array<CollisionRow, 12> kCollisionRows{{
    {"person_speed_mps", &CollisionParameters::person_speed_mps, 0.5, 3.0, "m/s"},
    {"person_reach_m", &CollisionParameters::person_reach_m, 0.0, 1.0, "m"},
    {"gap_m", &CollisionParameters::gap_m, 0.02, 0.5, "m"},
    {"reaction_s", &CollisionParameters::reaction_s, 0.02, 0.5, "s"},
    {"lidar_timeout_s", &CollisionParameters::lidar_timeout_s, 0.08, 0.5, "s"},
    {"odometry_timeout_s", &CollisionParameters::odometry_timeout_s, 0.04, 0.5, "s"},
    {"resume_pause_s", &CollisionParameters::resume_pause_s, 0.0, 10.0, "s"},
    {"creep_mps", &CollisionParameters::creep_mps, 0.02, 0.2, "m/s"},
    {"near_person_m", &CollisionParameters::near_person_m, 0.5, 3.0, "m"},
    {"near_person_mps", &CollisionParameters::near_person_mps, 0.05, 0.3, "m/s"},
    {"unwatched_reverse_mps", &CollisionParameters::unwatched_reverse_mps, 0.05, 0.5, "m/s"},
    {"ground_memory_s", &CollisionParameters::ground_memory_s, 0.0, 60.0, "s"},
}};

/// Throws ConfigurationError unless each value is in its range.
void check(const CollisionParameters& parameters);

}  // namespace mtr_drive_control
