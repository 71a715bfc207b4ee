/// @file
/// Maps of the site and localized poses, as they come.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/ros/map_input.hpp"

#include <cmath>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "mtr_drive_control/ros/conversions.hpp"

namespace mtr_drive_control {
namespace {

namespace names = mtr_core::names;

// The wheels have propagated an older pose for too long.
constexpr double kPoseTimeoutS = 0.2;

}  // namespace

MapInput::MapInput(ros::NodeHandle& node)
    : grids_(node.subscribe<nav_msgs::OccupancyGrid>(
          names::kMapGrid, 1, [this](const nav_msgs::OccupancyGrid::ConstPtr& message) { take(*message); })),
      poses_(node.subscribe<mtr_msgs::LocalizedPose>(
          names::kLocalizedPose, 10, [this](const mtr_msgs::LocalizedPose::ConstPtr& message) { take(*message); },
          ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay())) {}

std::optional<LocalizedMap> MapInput::at(const std::optional<Motion>& motion) const {
  if (!located_ || !motion || !mtr_core::is_fresh(located_->time_ns, motion->stamp_ns, kPoseTimeoutS)) {
    return std::nullopt;
  }
  const Pose odom_from_base = motion->at(located_->time_ns);
  const Point odom_in_base = odom_from_base.undo({0.0, 0.0});
  const Point origin = located_->map_from_base.apply(odom_in_base);
  return LocalizedMap{located_->map, Pose(origin.x_m, origin.y_m,
                                          located_->map_from_base.heading_rad() - odom_from_base.heading_rad())};
}

void MapInput::take(const nav_msgs::OccupancyGrid& grid) {
  map_ = site_map_of(grid);
  revision_.reset();
}

void MapInput::take(const mtr_msgs::LocalizedPose& pose) {
  const std::int64_t time_ns = mtr_core::time_of(pose.header.stamp, usual_age_ns_);
  located_.reset();
  if (!pose.valid || !std::isfinite(pose.x + pose.y + pose.heading)) {
    return;
  }
  located_ = Located{time_ns, Pose(pose.x, pose.y, pose.heading), map_of(pose)};
}

std::shared_ptr<const SiteMap> MapInput::map_of(const mtr_msgs::LocalizedPose& pose) {
  // While the robot maps, the grid is older than the poses.
  if (!map_ || pose.mode != mtr_msgs::LocalizedPose::LOCALIZED) {
    return nullptr;
  }
  if (revision_.value_or(pose.map_revision) != pose.map_revision) {
    // A map of another revision has another frame; its grid will follow.
    map_.reset();
    return nullptr;
  }
  revision_ = pose.map_revision;
  return map_;
}

}  // namespace mtr_drive_control
