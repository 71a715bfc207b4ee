/// @file
/// Geometry of the robot from the ROS parameter robot_description.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <map>
#include <string>

#include "mtr_core/names.hpp"
#include "mtr_core/parameter.hpp"
#include "mtr_description/robot_geometry.hpp"

namespace mtr_description {

/// Returns the geometry; throws mtr_core::ConfigurationError if the parameter is unset or not a URDF.
inline RobotGeometry described_robot() {
  std::string text;
  if (!ros::param::get(mtr_core::names::kRobotDescription, text) || text.empty()) {
    throw mtr_core::ConfigurationError(
        "Parameter robot_description is not set; allowed is the robot's URDF, which robot.launch loads from "
        "mtr_description.");
  }
  return RobotGeometry(text);
}

/// Returns the frame of a sensor's messages, if robot.launch overrides the name of the sensor's link.
inline std::string message_frame(const std::string& link) {
  return ros::param::param<std::string>(std::string(mtr_core::names::kRobotFrames) + "/" + link, link);
}

/// Returns the links of the LiDARs by their message frames; throws mtr_core::ConfigurationError for equal frames.
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
