/// @file
/// The base guard as a ROS node.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

#include <cstdint>

#include "mtr_core/parameter_reader.hpp"
#include "mtr_drive_control/base_guard.hpp"

namespace mtr_drive_control {

/// Relays the wheels' commands 50 times a second, by the machine's steady clock; it has no other input.
class BaseGuardNode {
 public:
  /// Reads limits from the node's private parameters, which have the names of a diff_drive_controller's.
  static BaseLimits read(mtr_core::ParameterReader& reader);

  BaseGuardNode(ros::NodeHandle& node, const BaseLimits& limits);

  /// Returns at shutdown, after braking the base.
  void spin();

 private:
  void step();

  BaseGuard guard_;
  ros::Publisher wheels_;
  ros::Subscriber commands_;
  int zeros_sent_ = 0;
};

}  // namespace mtr_drive_control
