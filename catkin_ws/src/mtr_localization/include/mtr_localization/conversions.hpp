/// @file
/// ROS messages to the core's types and back.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <mtr_msgs/LocalizedPose.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <string>

#include "mtr_localization/samples.hpp"

namespace mtr_localization {

ImuSample imu_sample_of(const sensor_msgs::Imu& message);
WheelSample wheel_sample_of(const nav_msgs::Odometry& message);

mtr_msgs::LocalizedPose message_of(const Estimate& estimate);

/// Transform parent_from_child, in the plane; stamp in ns, translation in m, rotation in rad.
struct Transform2 {
  std::string parent;
  std::string child;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};

geometry_msgs::TransformStamped transform_message(std::int64_t stamp_ns, const Transform2& parent_from_child);

}  // namespace mtr_localization
