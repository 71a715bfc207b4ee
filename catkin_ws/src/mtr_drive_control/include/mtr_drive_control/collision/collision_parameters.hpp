/// @file
/// Parameters of the collision stop: what a person can do, and what the robot leaves between; SI units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"

namespace mtr_drive_control {

/// Margins and time-outs; the robot's outline and its LiDARs are in its URDF (robot_shape.hpp).
struct CollisionParameters {
  /// A thing that may be a person may walk at this speed at any moment; walking speed of ISO 13855.
  double person_speed_mps = 1.6;
  /// A foot swings so far ahead of the walking body (0.28 m at 1.5 m/s), and the body overhangs the legs that are seen.
  double person_reach_m = 0.30;
  /// Left between the footprint and what does not walk; three times the noise of a range, and slip.
  double gap_m = 0.05;
  /// From a decision to braking wheels: one period, and the wheels' response (0.06 s in simulation).
  double reaction_s = 0.08;
  /// Age of a sweep's first beam at which its LiDAR is blind; 0.06 s in health.
  double lidar_timeout_s = 0.14;
  double odometry_timeout_s = 0.10;
  /// The way must be free for so long before the robot goes on.
  double resume_pause_s = 1.0;
  /// Away from a thing within a person's reach that has stood still, no faster than this.
  double creep_mps = 0.1;
  /// Within this distance of a possible person no point of the outline moves faster than this speed.
  double near_person_m = 2.0;
  double near_person_mps = 0.3;
  /// Without a LiDAR at the rear: backwards no faster than this, into ground seen free within this time.
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
