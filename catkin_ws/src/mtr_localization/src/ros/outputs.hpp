/// @file
/// Publishers of localization: poses, transforms, maps, diagnostics, markers and the log.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "pose_source.hpp"
#include "recent_stamps.hpp"
#include "ros/memory_files.hpp"
#include "ros/work_load.hpp"

namespace mtr_localization {

class Outputs {
 public:
  /// @param publish_odom_tf also publish odom -> base_link, if the base does not
  /// @param memory stores the state for a restart; must outlive this object
  Outputs(ros::NodeHandle& node, bool publish_odom_tf, MemoryFiles& memory);

  /// Publishes the map of a previous process.
  void publish_map_of_before(const SavedMap& saved);

  /// Publishes a new map before the first pose in it, then the estimates.
  void publish(PoseSource& source, const std::vector<Estimate>& estimates, const WorkLoad& load);
  /// Publishes the pose of odom after a scan corrected it between two estimates.
  void publish_map_from_odom(std::int64_t stamp_ns, const Estimate& corrected);

 private:
  /// Pose of base_link in the odom frame of tf: x, y (m), heading (rad).
  const std::array<double, 3>& odom_of(const Estimate& estimate) const;
  void publish_map(const MapResult& result, bool with_grid);
  void publish_transforms(const Estimate& estimate, bool with_map);
  void publish_each_second(const PoseSource& source, const Estimate& estimate, const WorkLoad& load);
  void log(const PoseSource& source, const Estimate& estimate);

  bool publish_odom_tf_;
  MemoryFiles& memory_;
  ros::Publisher poses_;
  ros::Publisher surfaces_;
  ros::Publisher grids_;
  ros::Publisher markers_;
  ros::Publisher diagnostics_;
  tf2_ros::TransformBroadcaster transforms_;
  std::int64_t published_second_ = -1;
  RecentStamps map_stamps_;
  std::string logged_kind_;
};

}  // namespace mtr_localization
