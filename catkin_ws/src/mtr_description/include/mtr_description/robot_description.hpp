/// @file
/// The robot's geometry as the parameter robot_description of the ROS master has it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <map>
#include <string>

#include "mtr_core/names.hpp"
#include "mtr_core/parameter.hpp"
#include "mtr_description/robot_geometry.hpp"

namespace mtr_description {

/// Geometry from the parameter; throws mtr_core::ConfigurationError when it is not set or is no URDF.
inline RobotGeometry described_robot() {
  std::string text;
  if (!ros::param::get(mtr_core::names::kRobotDescription, text) || text.empty()) {
    throw mtr_core::ConfigurationError(
        "Parameter robot_description is not set; allowed is the robot's URDF, which robot.launch loads from "
        "mtr_description.");
  }
  return RobotGeometry(text);
}

/// Frame in which the driver of a sensor speaks, where robot.launch says that it is not named as the sensor's link.
inline std::string message_frame(const std::string& link) {
  return ros::param::param<std::string>(std::string(mtr_core::names::kRobotFrames) + "/" + link, link);
}

/// Links of the LiDARs that the robot has, by the frames in which they speak; throws mtr_core::ConfigurationError when
/// these are the same.
inline std::map<std::string, std::string> lidars_by_frame(bool has_rear_lidar) {
  const std::string front = message_frame(mtr_core::names::kFrontLidar);
  const std::string rear = message_frame(mtr_core::names::kRearLidar);
  if (!has_rear_lidar) {
    return {{front, mtr_core::names::kFrontLidar}};
  }
  if (front == rear) {
    throw mtr_core::ConfigurationError("Both LiDARs are said to speak in the frame " + front +
                                       "; give each its own (front_frame and rear_frame of robot.launch).");
  }
  return {{front, mtr_core::names::kFrontLidar}, {rear, mtr_core::names::kRearLidar}};
}

}  // namespace mtr_description
