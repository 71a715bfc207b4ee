/// @file
/// ROS node of localization.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/MappingOrder.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "external_pose.hpp"
#include "motion/silence_turn.hpp"
#include "mtr_core/clock.hpp"
#include "mtr_core/parameter_reader.hpp"
#include "mtr_core/samples.hpp"
#include "pose_source.hpp"
#include "ros/gnss_input.hpp"
#include "ros/memory_files.hpp"
#include "ros/outputs.hpp"
#include "ros/poll_barrier.hpp"
#include "ros/robot_frames.hpp"
#include "ros/scan_input.hpp"
#include "ros/work_load.hpp"

namespace mtr_localization {

/// Parameters of the node from the parameter server.
struct NodeParameters {
  Parameters localization;
  /// Source of the pose: own, or external.
  std::string pose_source = "own";
  ExternalParameters external;
  ScanParameters scans;
  /// False if the robot and its description have no rear LiDAR.
  bool rear_lidar = true;
  /// True to publish odom -> base_link, false if the base publishes it.
  bool publish_odom_tf = true;
  /// Folder of the files for a restart within the same run; empty to store nothing.
  std::string memory_folder;
};

/// Publishes one estimate per wheel odometry message, without a timer.
class Node {
 public:
  /// Throws mtr_core::ConfigurationError.
  static NodeParameters read(mtr_core::ParameterReader& reader);

  /// Throws mtr_core::ConfigurationError if a LiDAR is missing in the robot description or not level.
  Node(ros::NodeHandle& node, const NodeParameters& parameters);

  /// Returns at shutdown.
  void spin();

 private:
  std::unique_ptr<PoseSource> pose_source_of(NodeParameters parameters);
  std::unique_ptr<PoseSource> own_source(const Parameters& parameters);
  void subscribe_to_time(ros::NodeHandle& node);
  void receive_imu(ImuSample sample);
  void receive_sweep(Sweep sweep);
  void receive_order(const mtr_msgs::MappingOrder& message);
  void answer(const WheelSample& wheels);
  void answer_waiting();
  /// True if the newest wheel or IMU message is so old that another one may have arrived unread.
  bool may_have_unread(std::int64_t now_ns) const;
  /// Runs the callbacks of all arrived messages; must not be called from a callback. Wheel samples are then in
  /// waiting_.
  void read_arrived();
  /// Checks after all arrived messages were processed; otherwise a delayed node would report sensors as silent.
  void check_silence();
  void publish(std::vector<Estimate> estimates);
  /// Publishes the estimates of wheels or gyro, whichever arrived later; adds the work to the load.
  void publish_measured(const std::function<std::vector<Estimate>()>& answer);

  /// Age of the last message of each producer, see mtr_core::StampClock::time_of.
  struct Ages {
    std::int64_t imu_ns = 0;
    std::int64_t wheels_ns = 0;
    std::int64_t front_ns = 0;
    std::int64_t rear_ns = 0;
    std::int64_t order_ns = 0;
    std::int64_t fix_ns = 0;
  };

  Ages ages_;
  RobotFrames frames_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  MemoryFiles memory_;
  Outputs outputs_;
  std::unique_ptr<PoseSource> source_;
  WorkLoad load_;
  ScanInput front_;
  ScanInput rear_;
  GnssInput gnss_;
  mtr_core::Samples<std::int64_t> orders_received_;
  ros::Subscriber orders_;
  ros::Subscriber imu_;
  ros::Subscriber wheels_;
  ros::Subscriber clock_;
  ros::SteadyTimer timer_;
  std::deque<WheelSample> waiting_;
  std::optional<std::int64_t> silence_due_ns_;
  PollBarrier barrier_;
  // Stamps on the steady clock; 0 before the first message.
  std::int64_t newest_imu_ns_ = 0;
  std::int64_t newest_wheels_ns_ = 0;
  SilenceTurn silence_turn_{mtr_core::kLocalization.period_ns};
  std::string scan_problem_;
};

}  // namespace mtr_localization
