/// @file
/// Map of the site, and the robot's pose in it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/LocalizedPose.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

#include <memory>
#include <optional>

#include "mtr_drive_control/collision/map_witness.hpp"

namespace mtr_drive_control {

/// Subscription to the map and the localized pose.
///
/// Both only contradict a LiDAR without echoes; drive control also works without them.
class MapInput {
 public:
  explicit MapInput(ros::NodeHandle& node);

  /// Returns the pose of the map in odom, and the map if the pose refers to it; empty without a valid pose.
  std::optional<LocalizedMap> at(const std::optional<Motion>& motion) const;

 private:
  void take(const nav_msgs::OccupancyGrid& grid);
  void take(const mtr_msgs::LocalizedPose& pose);
  /// Returns the map to which this pose refers.
  std::shared_ptr<const SiteMap> map_of(const mtr_msgs::LocalizedPose& pose);

  struct Located {
    std::int64_t time_ns;
    Pose map_from_base;
    std::shared_ptr<const SiteMap> map;
  };

  std::shared_ptr<const SiteMap> map_;
  /// Revision of the poses in this map; empty before the first one after the map arrived.
  std::optional<std::uint32_t> revision_;
  std::optional<Located> located_;
  std::int64_t usual_age_ns_ = 0;
  ros::Subscriber grids_;
  ros::Subscriber poses_;
};

}  // namespace mtr_drive_control
