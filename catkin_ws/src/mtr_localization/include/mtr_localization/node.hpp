/// @file
/// Localization as a ROS node.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>
#include <vector>

#include "mtr_localization/localizer.hpp"
#include "mtr_lockstep/parameter_reader.hpp"

namespace mtr_localization {

/// Parameters from the parameter server.
struct NodeParameters {
  Parameters sensors;
  /// Publish odom -> base_link; false when the base does so itself.
  bool publish_odom_tf = true;
};

/// Answers each wheel odometry message; needs no tick of its own.
class Node {
 public:
  /// Throws mtr_lockstep::ConfigurationError.
  static NodeParameters read(mtr_lockstep::ParameterReader& reader);

  Node(ros::NodeHandle& node, const NodeParameters& parameters);

  /// Returns at shutdown.
  void spin();

 private:
  void watch_silence(ros::NodeHandle& node);
  void publish(const std::vector<Estimate>& estimates);
  void publish_transforms(const Estimate& estimate);
  void publish_diagnostics(const Estimate& estimate);
  void log(const Estimate& estimate);

  Localizer localizer_;
  bool publish_odom_tf_;
  ros::Publisher poses_;
  ros::Publisher diagnostics_;
  tf2_ros::TransformBroadcaster transforms_;
  ros::Subscriber imu_;
  ros::Subscriber wheels_;
  ros::Subscriber clock_;
  ros::WallTimer timer_;
  std::int64_t diagnosed_second_ = -1;
  std::string message_;
};

}  // namespace mtr_localization
