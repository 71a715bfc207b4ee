/// @file
/// Received ROS messages and parameters in core types.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/ActiveFaults.h>
#include <mtr_msgs/CarCheck.h>
#include <mtr_msgs/CarEstimate.h>
#include <mtr_msgs/DriveStatus.h>
#include <mtr_msgs/LocalizedPose.h>
#include <mtr_msgs/MotionLock.h>
#include <mtr_msgs/MotionStatus.h>
#include <mtr_msgs/PeripheralsState.h>
#include <mtr_msgs/RobotMode.h>
#include <ros/ros.h>

#include <vector>

#include "core/fault_order.hpp"
#include "core/robot.hpp"

namespace mtr_rviz {

/// Subscribes in the constructor. rviz calls back in the window's thread, which also uses this object.
class Listener {
 public:
  Listener();

  /// Returns all received data; parameters of the master are as of the last look().
  Robot robot() const;

  /// Reads the parameters of the master; takes some ms.
  void look();

  /// Empty if the robot was started without fault injection.
  const FaultCatalogue& catalogue() const { return catalogue_; }

  /// Returns the clock of the arrivals in s.
  static double now_s();

 private:
  void take_lock(const mtr_msgs::MotionLock& message);
  void take_faults(const mtr_msgs::ActiveFaults& message);
  template <typename Message>
  void listen(const char* topic, void (Listener::*take)(const Message&));
  void take_mode(const mtr_msgs::RobotMode& message);
  void take_pose(const mtr_msgs::LocalizedPose& message);
  void take_car(const mtr_msgs::CarEstimate& message);
  void take_check(const mtr_msgs::CarCheck& message);
  void take_motion(const mtr_msgs::MotionStatus& message);
  void take_drive(const mtr_msgs::DriveStatus& message);
  void take_parts(const mtr_msgs::PeripheralsState& message);

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  Robot robot_;
  FaultCatalogue catalogue_;
  std::optional<mtr_msgs::ActiveFaults> faults_;
};

}  // namespace mtr_rviz
