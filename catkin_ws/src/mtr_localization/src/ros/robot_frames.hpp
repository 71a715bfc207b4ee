/// @file
/// Sensor mounts from the robot description.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "mtr_description/robot_geometry.hpp"
#include "ros/conversions.hpp"

namespace mtr_localization {

/// Mounts by frame of the messages, each looked up once.
class RobotFrames {
 public:
  /// Throws mtr_core::ConfigurationError if a LiDAR is not upright and level on the robot.
  /// @param lidars links of the LiDARs, by the frames of their messages
  RobotFrames(const mtr_description::RobotGeometry& geometry, const std::map<std::string, std::string>& lidars);

  /// Returns the mount of an upright and level LiDAR; otherwise null, with a warning once per frame.
  const Mount* lidar(const std::string& frame);
  /// Returns the position of an antenna; throws mtr_core::ConfigurationError.
  PoseVector antenna(const std::string& frame) const;

 private:
  Mount level_mount(const std::string& frame) const;

  mtr_description::RobotGeometry geometry_;
  std::map<std::string, std::optional<Mount>> lidars_;
};

}  // namespace mtr_localization
