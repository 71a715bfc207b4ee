/// @file
/// The robot's geometry as the parameter robot_description of the ROS master has it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

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

}  // namespace mtr_description
