/// @file
/// The stopping zone as a marker for rviz.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <cstdint>

#include "mtr_core/steady_time.hpp"
#include "mtr_drive_control/drive_control.hpp"

namespace mtr_drive_control {

/// Draws the footprint's outlines along the path of a stop, coloured by the zone's state, five times a second while the
/// topic has subscribers.
class ZoneMarkers {
 public:
  explicit ZoneMarkers(ros::NodeHandle& node);

  void publish(const mtr_core::Instant& tick, const Decision& decision, const DriveControl& drive_control);

 private:
  ros::Publisher publisher_;
  std::int64_t published_ns_ = 0;
};

}  // namespace mtr_drive_control
