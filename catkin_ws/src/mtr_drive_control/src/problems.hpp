/// @file
/// Sentences that drive control reports to the Operator; a test reads this table too.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_core/problem.hpp"

namespace mtr_drive_control::problems {

using mtr_core::Sentence;

// Sources of motion, and their locks
constexpr Sentence kWaitingForLock{"drive_control.waiting_for_lock", "Waiting for the motion lock of {owner}."};
constexpr Sentence kLockSilent{"drive_control.lock_silent", "The motion lock of {owner} is silent."};
constexpr Sentence kEmergencyNotReleased{
    "drive_control.emergency_not_released",
    "The emergency stop of {owner} was engaged when it fell silent; engage it and release it again."};
constexpr Sentence kLeaving{"drive_control.leaving", "Drive control is being ended; the robot stops."};
constexpr Sentence kEmergencyStop{"drive_control.emergency_stop", "The emergency stop is pressed."};
constexpr Sentence kWaitingForSource{"drive_control.waiting_for_source", "Waiting for the {source}."};
constexpr Sentence kSourceSilent{"drive_control.source_silent", "The {source} is silent."};
constexpr Sentence kSourceNotFinite{"drive_control.source_not_finite",
                                    "The {source} wants a velocity that is not a finite number."};

// LiDARs and wheels
constexpr Sentence kWaitingForLidar{"drive_control.waiting_for_lidar", "Waiting for the {lidar}."};
constexpr Sentence kLidarSilent{"drive_control.lidar_silent", "The {lidar} is silent."};
constexpr Sentence kLidarInFuture{"drive_control.lidar_in_future", "The {lidar} sends sweeps from the future."};
constexpr Sentence kLidarFrame{"drive_control.lidar_frame",
                               "The {lidar} speaks of frame '{frame}' and not of '{expected}'."};
constexpr Sentence kLidarWithoutBeams{"drive_control.lidar_without_beams", "The {lidar} sends sweeps without beams."};
constexpr Sentence kLidarNotNumbers{"drive_control.lidar_not_numbers",
                                    "The {lidar} sends sweeps whose angles or times are not numbers."};
constexpr Sentence kLidarWithoutRange{"drive_control.lidar_without_range",
                                      "The {lidar} sends sweeps without a range of measurement."};
constexpr Sentence kLidarCovered{"drive_control.lidar_covered", "The {lidar} is covered."};
constexpr Sentence kLidarSectorCovered{
    "drive_control.lidar_sector_covered",
    "The {lidar} is covered or dirty from {from_deg} to {to_deg} degrees (0 is ahead, 90 left): clean or "
    "uncover it."};
constexpr Sentence kLidarSeesNothing{
    "drive_control.lidar_sees_nothing",
    "The {lidar} sees nothing from {from_deg} to {to_deg} degrees (0 is ahead, 90 left), where something was: "
    "clean or uncover it, or walk past in front of it."};
constexpr Sentence kLidarNeverSaw{"drive_control.lidar_never_saw",
                                  "The {lidar} has seen nothing since its start, but the {other} shows a surface: "
                                  "clean or uncover it, or walk past in "
                                  "front of it."};
constexpr Sentence kLidarSweepTime{"drive_control.lidar_sweep_time",
                                   "The {lidar} sends sweeps of {sweep_s:.3g} s; allowed is 0 to {most_s:.2f} s: set "
                                   "time_increment of its driver."};
constexpr Sentence kLidarTimeIncrement{
    "drive_control.lidar_time_increment",
    "The {lidar} states {stated_us:.1f} us from beam to beam, by its turns it is {expected_us:.1f} us: set "
    "time_increment of its driver."};
constexpr Sentence kLidarTooCoarse{"drive_control.lidar_too_coarse",
                                   "The {lidar} sends a beam each {step_deg:.1f} degrees; a leg needs one each 2 "
                                   "degrees at least: set its resolution."};
constexpr Sentence kLidarFrozen{"drive_control.lidar_frozen", "The {lidar} is frozen: it repeats the same sweep."};
constexpr Sentence kWaitingForOdometry{"drive_control.waiting_for_odometry", "Waiting for the wheels' odometry."};
constexpr Sentence kOdometrySilent{"drive_control.odometry_silent", "The wheels' odometry is silent."};
constexpr Sentence kImuSilent{"drive_control.imu_silent", "The IMU is silent."};

// Slopes
constexpr Sentence kTilted{"drive_control.tilted",
                           "The robot is tilted by {tilt_deg:.0f} degrees; it drives up to {most_deg:.0f} only. Lower "
                           "the key, then drive it off the slope with the manual controller."};
constexpr Sentence kTiltedTooFar{"drive_control.tilted_too_far",
                                 "The robot is tilted by {tilt_deg:.0f} degrees, too far to be driven at all. Hold the "
                                 "mast, lower the key, and move the robot to level ground by hand."};
constexpr Sentence kTiltUnknown{"drive_control.tilt_unknown",
                                "The tilt is not known: the IMU shows no gravity. Check its driver."};

// Motion that contradicts what was sent
constexpr Sentence kOdometryFrozen{"drive_control.odometry_frozen",
                                   "The wheels' odometry is frozen: it repeats the same values in motion."};
constexpr Sentence kBaseStands{"drive_control.base_stands",
                               "The base does not obey: its wheels stand although they are told to turn. Look for its "
                               "emergency stop, its motors and its encoders."};
constexpr Sentence kBaseDisobeys{
    "drive_control.base_disobeys",
    "The base does not obey: told {sent_mps:.2f} m/s and {sent_radps:.2f} rad/s, its wheels do {measured_mps:.2f} m/s "
    "and {measured_radps:.2f} rad/s."};
constexpr Sentence kBaseChanged{"drive_control.base_changed",
                                "The limits of the base have changed since the start, so the robot is locked. {why}"};
constexpr Sentence kImuFrozen{"drive_control.imu_frozen", "The IMU is frozen: it repeats the same values in motion."};
constexpr Sentence kWheelsSlip{
    "drive_control.wheels_slip",
    "The wheels spin: by them the robot turns at {wheels_radps:.2f} rad/s, by its gyro at {gyro_radps:.2f} rad/s."};
constexpr Sentence kSecondPublisher{"drive_control.second_publisher",
                                    "The node {node} commands the wheels, too, on {topic}; end it."};

// Collision stop
constexpr Sentence kObstacle{"drive_control.obstacle", "Blocked by an obstacle {distance_m:.1f} m {side}."};
constexpr Sentence kUnseenGround{
    "drive_control.unseen_ground",
    "Blocked: ground behind was not seen free lately; drive the robot ahead for half a metre with the manual "
    "controller, then turn it once on the spot."};
// Test area
constexpr Sentence kOutsideArea{"drive_control.outside_area",
                                "The robot is {distance_m:.2f} m outside the test area; drive it back by hand."};
constexpr Sentence kAreaBorder{
    "drive_control.area_border",
    "Stopped at the border of the test area, {distance_m:.2f} m away; drive back by hand, or "
    "draw the area again."};
constexpr Sentence kAreaPoseUnknown{
    "drive_control.area_position_unknown",
    "The robot's position in the test area is unknown; it can only be driven by hand, at a crawl."};
constexpr Sentence kAreaOfOtherOrigin{
    "drive_control.area_of_other_origin",
    "The robot started a new map elsewhere, so the test area no longer applies; draw it again."};
constexpr Sentence kAreaMissing{"drive_control.area_missing",
                                "No test area is set; a real robot drives by itself only inside one."};

constexpr Sentence kPausing{"drive_control.pausing", "Waits a moment before it goes on."};

}  // namespace mtr_drive_control::problems
