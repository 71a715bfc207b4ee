/// @file
/// Names of topics and frames that C++ nodes use, mirrored from mtr_core/names.py; a unit test compares the two.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_lockstep::names {

inline constexpr char kMap[] = "map";
inline constexpr char kOdom[] = "odom";
inline constexpr char kBase[] = "base_link";

inline constexpr char kImuData[] = "/imu/data";
inline constexpr char kWheelOdometry[] = "/jackal_velocity_controller/odom";
inline constexpr char kWheelCommand[] = "/jackal_velocity_controller/cmd_vel";

inline constexpr char kLocalizedPose[] = "/localization/pose";
inline constexpr char kPlannerVelocity[] = "/drive/command/planner";
inline constexpr char kManualVelocity[] = "/drive/command/manual";
inline constexpr char kMotionLock[] = "/drive/lock";
inline constexpr char kDriveStatus[] = "/drive/status";

inline constexpr char kSimHold[] = "/sim/hold";

}  // namespace mtr_lockstep::names
