/// @file
/// Localization as a ROS node.
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

/// Parameters from the parameter server.
struct NodeParameters {
  Parameters localization;
  /// Where the pose comes from: own, or another program.
  std::string pose_source = "own";
  ExternalParameters external;
  ScanParameters scans;
  /// False: the robot has none, and its description need not either.
  bool rear_lidar = true;
  /// Publish odom -> base_link; false when the base does so itself.
  bool publish_odom_tf = true;
  /// Of the files with which a process that is started again in the same run goes on; empty: none.
  std::string memory_folder;
};

/// Answers each wheel odometry message; needs no tick of its own.
class Node {
 public:
  /// Throws mtr_core::ConfigurationError.
  static NodeParameters read(mtr_core::ParameterReader& reader);

  /// Throws mtr_core::ConfigurationError when the robot's description lacks a LiDAR, or has it where it cannot serve.
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
  /// True when the newest message of wheels or IMU is so old at a time that one more may have arrived unread.
  bool may_have_unread(std::int64_t now_ns) const;
  /// Runs the callbacks of all that has arrived; not from within one. What the wheels said is waiting_ then.
  void read_arrived();
  /// After all that has come was taken: a node that was woken late would else call silent what has spoken meanwhile.
  void check_silence();
  void publish(std::vector<Estimate> estimates);
  /// Publishes what came of the wheels or the gyro, whichever was the later; its work counts as load.
  void publish_measured(const std::function<std::vector<Estimate>()>& answer);

  /// Of the message of each producer that came last, see mtr_core::StampClock::time_of.
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
