/// @file
/// Names of topics and frames that C++ nodes use, mirrored from mtr_core/names.py; a unit test compares the two.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_core::names {

inline constexpr char kMap[] = "map";
inline constexpr char kOdom[] = "odom";
inline constexpr char kBase[] = "base_link";

inline constexpr char kCar[] = "car";
inline constexpr char kFrontLidar[] = "front_lidar";
inline constexpr char kRearLidar[] = "rear_lidar";
inline constexpr char kKey[] = "key";
inline constexpr char kImu[] = "imu";

inline constexpr char kRobotDescription[] = "/robot_description";

inline constexpr char kFrontScan[] = "/front/scan";
inline constexpr char kRearScan[] = "/rear/scan";
inline constexpr char kImuData[] = "/imu/data";
inline constexpr char kNavsatFix[] = "/navsat/fix";
inline constexpr char kWheelOdometry[] = "/jackal_velocity_controller/odom";
inline constexpr char kWheelCommand[] = "/jackal_velocity_controller/cmd_vel";

inline constexpr char kLocalizedPose[] = "/localization/pose";
inline constexpr char kSurfaceMap[] = "/localization/surfaces";
inline constexpr char kMapGrid[] = "/map";
inline constexpr char kLocalizationMarkers[] = "/localization/markers";
inline constexpr char kMappingOrder[] = "/car_locator/mapping_order";
inline constexpr char kPeripheralsState[] = "/peripherals/state";
inline constexpr char kPlannerVelocity[] = "/drive/command/planner";
inline constexpr char kManualVelocity[] = "/drive/command/manual";
inline constexpr char kMotionLock[] = "/drive/lock";
inline constexpr char kDriveStatus[] = "/drive/status";
inline constexpr char kDriveMarkers[] = "/drive/markers";

inline constexpr char kSimHold[] = "/sim/hold";

}  // namespace mtr_core::names
