/// @file
/// Localization as a ROS node.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/MappingOrder.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <deque>
#include <string>
#include <vector>

#include "mtr_core/parameter_reader.hpp"
#include "mtr_localization/localizer.hpp"
#include "mtr_localization/navsat_input.hpp"
#include "mtr_localization/scan_input.hpp"
#include "mtr_localization/work_load.hpp"

namespace mtr_localization {

/// Parameters from the parameter server.
struct NodeParameters {
  LocalizerParameters localizer;
  /// Publish odom -> base_link; false when the base does so itself.
  bool publish_odom_tf = true;
};

/// Answers each wheel odometry message; needs no tick of its own.
class Node {
 public:
  /// Throws mtr_core::ConfigurationError.
  static NodeParameters read(mtr_core::ParameterReader& reader);

  Node(ros::NodeHandle& node, const NodeParameters& parameters);

  /// Returns at shutdown.
  void spin();

 private:
  void watch_silence(ros::NodeHandle& node);
  void receive_sweep(Sweep sweep);
  void receive_order(const mtr_msgs::MappingOrder& message);
  void answer(const WheelSample& wheels);
  void answer_waiting();
  void hear_other_localization();
  void publish(const std::vector<Estimate>& estimates);
  void publish_map(const MapResult& result);
  void publish_transforms(const Estimate& estimate);
  void publish_each_second(const Estimate& estimate);
  void log(const Estimate& estimate);

  NodeParameters parameters_;
  Localizer localizer_;
  WorkLoad load_;
  ros::Publisher poses_;
  ros::Publisher surfaces_;
  ros::Publisher grids_;
  ros::Publisher markers_;
  ros::Publisher diagnostics_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::Buffer frames_;
  tf2_ros::TransformListener listener_;
  ScanInput front_;
  ScanInput rear_;
  NavsatInput navsat_;
  mtr_core::Samples<std::int64_t> orders_heard_;
  ros::Subscriber orders_;
  ros::Subscriber imu_;
  ros::Subscriber wheels_;
  ros::Subscriber clock_;
  ros::WallTimer timer_;
  std::deque<WheelSample> waiting_;
  std::int64_t told_second_ = -1;
  std::string message_;
  std::string scan_problem_;
};

}  // namespace mtr_localization
