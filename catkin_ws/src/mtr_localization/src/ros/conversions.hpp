/// @file
/// Conversions between ROS messages and core types.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <mtr_msgs/LocalizedPose.h>
#include <mtr_msgs/MappingOrder.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/NavSatFix.h>

#include <array>
#include <optional>
#include <string>

#include "mapping/mapper.hpp"
#include "samples.hpp"
#include "scans/sweep.hpp"

namespace mtr_localization {

ImuSample imu_sample_of(const sensor_msgs::Imu& message);
WheelSample wheel_sample_of(const nav_msgs::Odometry& message);

/// @param antenna in base_link, m
GnssFix gnss_fix_of(const sensor_msgs::NavSatFix& message, const Eigen::Vector2d& antenna);

MapOrder order_of(const mtr_msgs::MappingOrder& message);

/// Mount of a LiDAR on base_link.
struct Mount {
  PoseVector pose = PoseVector::Zero();
  double height_m = 0.0;
  bool upside_down = false;
};

Sweep sweep_of(const sensor_msgs::LaserScan& message, Lidar lidar, const Mount& mount);

/// Returns the mount from the transform of base_link to the LiDAR frame, or nothing if the LiDAR is not level.
std::optional<Mount> mount_from(const geometry_msgs::TransformStamped& base_from_lidar);
PoseVector pose_of(const geometry_msgs::Transform& transform);

mtr_msgs::LocalizedPose message_of(const Estimate& estimate);

/// Planar transform parent_from_child; stamp in ns, translation in m, rotation in rad.
struct Transform2 {
  std::string parent;
  std::string child;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};

/// @param stamp_ns of the transform
/// @param odom base_link in the frame odom that is published: x, y (m), heading (rad)
geometry_msgs::TransformStamped map_from_odom_message(std::int64_t stamp_ns, const Estimate& estimate,
                                                      const std::array<double, 3>& odom);
geometry_msgs::TransformStamped transform_message(std::int64_t stamp_ns, const Transform2& parent_from_child);

}  // namespace mtr_localization
