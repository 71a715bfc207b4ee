/// @file
/// Conversion of the robot description to mounts.
// SPDX-License-Identifier: Apache-2.0
#include "ros/robot_frames.hpp"

#include <ros/console.h>

#include "mtr_core/parameter.hpp"

namespace mtr_localization {

RobotFrames::RobotFrames(const mtr_description::RobotGeometry& geometry,
                         const std::map<std::string, std::string>& lidars)
    : geometry_(geometry) {
  for (const auto& [frame, link] : lidars) {
    lidars_[frame] = level_mount(link);
  }
}

const Mount* RobotFrames::lidar(const std::string& frame) {
  const auto [entry, is_new] = lidars_.try_emplace(frame);
  if (is_new) {
    try {
      entry->second = level_mount(frame);
    } catch (const mtr_core::ConfigurationError& error) {
      ROS_WARN("Scans of frame '%s' are not used. %s", frame.c_str(), error.what());
    }
  }
  return entry->second ? &*entry->second : nullptr;
}

PoseVector RobotFrames::antenna(const std::string& frame) const {
  const mtr_description::Mount mount = geometry_.mount(frame);
  return {mount.x_m, mount.y_m, mount.yaw_rad};
}

Mount RobotFrames::level_mount(const std::string& frame) const {
  const mtr_description::Mount mount = geometry_.mount(frame);
  mtr_description::check_level(mount);
  return {{mount.x_m, mount.y_m, mount.yaw_rad}, mount.z_m, false};
}

}  // namespace mtr_localization
