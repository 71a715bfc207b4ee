/// @file
/// Drive control as a ROS node.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Twist.h>
#include <mtr_msgs/DriveStatus.h>
#include <mtr_msgs/MotionLock.h>
#include <mtr_msgs/VelocityCommand.h>
#include <ros/ros.h>

#include <cstdint>
#include <string>
#include <vector>

#include "mtr_drive_control/drive_control.hpp"
#include "mtr_lockstep/parameter_reader.hpp"
#include "mtr_lockstep/tick_input.hpp"
#include "mtr_lockstep/ticker.hpp"

namespace mtr_drive_control {

/// Parameters from the parameter server and wishes about the inputs.
struct NodeParameters {
  Parameters limits;
  /// Owners whose silence forbids motion.
  std::vector<std::string> lock_owners{"dispatcher", "state_machine"};
  /// In simulation: a manual controller takes part, so each tick waits for its command.
  bool manual_expected = false;
};

/// Publishes the wheel command and the status at each tick.
class Node {
 public:
  /// Throws mtr_lockstep::ConfigurationError.
  static NodeParameters read(mtr_lockstep::ParameterReader& reader);

  Node(ros::NodeHandle& node, const NodeParameters& parameters);

  /// Returns at shutdown.
  void spin();

 private:
  void tick(std::int64_t tick_ns);
  void publish(std::int64_t tick_ns, const Decision& decision);

  DriveControl drive_control_;
  MotionLocks locks_;
  mtr_lockstep::Ticker ticker_;
  mtr_lockstep::TickInput<mtr_msgs::VelocityCommand> manual_;
  mtr_lockstep::TickInput<mtr_msgs::VelocityCommand> planner_;
  ros::Subscriber lock_subscriber_;
  ros::Publisher wheels_;
  ros::Publisher status_;
  std::string message_;
};

}  // namespace mtr_drive_control
