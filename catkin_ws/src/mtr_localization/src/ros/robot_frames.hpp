/// @file
/// Where sensors sit on the robot, by its description.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "mtr_description/robot_geometry.hpp"
#include "ros/conversions.hpp"

namespace mtr_localization {

/// Mounts of the frames that messages name, each asked for once.
class RobotFrames {
 public:
  /// Throws mtr_core::ConfigurationError unless the LiDARs sit upright and level on the robot.
  /// @param lidars links of the LiDARs that the robot has, by the frames in which they speak
  RobotFrames(const mtr_description::RobotGeometry& geometry, const std::map<std::string, std::string>& lidars);

  /// Mount of a LiDAR that is upright and level; null after a warning, once for each frame, when it is not.
  const Mount* lidar(const std::string& frame);
  /// Mount of any sensor; throws mtr_core::ConfigurationError.
  PoseVector antenna(const std::string& frame) const;

 private:
  Mount level_mount(const std::string& frame) const;

  mtr_description::RobotGeometry geometry_;
  std::map<std::string, std::optional<Mount>> lidars_;
};

}  // namespace mtr_localization
