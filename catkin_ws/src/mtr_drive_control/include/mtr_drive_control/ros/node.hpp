/// @file
/// Drive control as a ROS node.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/MotionLock.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mtr_core/parameter_reader.hpp"
#include "mtr_core/tick_input.hpp"
#include "mtr_core/ticker.hpp"
#include "mtr_drive_control/drive_control.hpp"
#include "mtr_drive_control/ros/area_input.hpp"
#include "mtr_drive_control/ros/base_parameters.hpp"
#include "mtr_drive_control/ros/base_watch.hpp"
#include "mtr_drive_control/ros/conversions.hpp"
#include "mtr_drive_control/ros/map_input.hpp"
#include "mtr_drive_control/ros/publisher_watch.hpp"
#include "mtr_drive_control/ros/zone_markers.hpp"

namespace mtr_drive_control {

/// Parameters from the parameter server and requirements on the inputs.
struct NodeParameters {
  Parameters limits;
  CollisionParameters collision;
  AreaParameters area;
  /// Owners whose silence forbids motion.
  std::vector<std::string> lock_owners{"dispatcher", "state_machine"};
  /// std_msgs/Bool topics of emergency stops, true: stop; their silence forbids motion too. Drive control republishes
  /// them to other nodes as locks of owners with these names.
  std::vector<std::string> e_stop_topics;
  bool rear_lidar = true;
  /// Namespace of the parameters of the base's controller, which are checked at the start.
  std::string base_controller = kShippedController;
  /// Commands go to the base guard in front of the base, and its parameters are checked instead.
  bool base_guard = false;
  /// In simulation: a manual controller takes part, so each tick waits for its command.
  bool manual_expected = false;
};

/// Newest sweep of a LiDAR at a tick.
class LidarInput {
 public:
  LidarInput(ros::NodeHandle& node, const std::string& topic, const std::string& frame);

  std::shared_ptr<const Sweep> at(std::int64_t tick_ns) { return reader_.read(scans_.at(tick_ns)); }

 private:
  mtr_core::TickInput<sensor_msgs::LaserScan> scans_;
  SweepReader reader_;
};

/// Publishes the wheel command and the status at each tick.
class Node {
 public:
  /// Throws mtr_core::ConfigurationError.
  static NodeParameters read(mtr_core::ParameterReader& reader);

  Node(ros::NodeHandle& node, const NodeParameters& parameters);

  /// Returns at shutdown, after braking the robot and publishing zero velocity.
  void spin();

 private:
  void watch_base(const NodeParameters& parameters);
  void listen_to_locks(ros::NodeHandle& node);
  void listen_to_e_stop(ros::NodeHandle& node, const std::string& topic);
  bool is_e_stop(const std::string& owner) const;
  void take(const std::string& owner, const Lock& lock);
  void tick(const mtr_core::Instant& tick);
  void publish(const mtr_core::Instant& tick, const Decision& decision);
  std::vector<EngagedLock> own_locks() const;
  void log(std::int64_t now_ns, const Decision& decision);

  DriveControl drive_control_;
  MotionLocks locks_;
  std::vector<std::string> e_stop_topics_;
  mtr_core::Ticker ticker_;
  mtr_core::TickInput<mtr_msgs::VelocityCommand> manual_;
  mtr_core::TickInput<mtr_msgs::VelocityCommand> planner_;
  mtr_core::TickInput<mtr_msgs::RobotMode> mode_;
  mtr_core::TickInput<nav_msgs::Odometry> odometry_;
  mtr_core::TickInput<sensor_msgs::Imu> imu_;
  mtr_core::TickInput<mtr_msgs::PeripheralsState> peripherals_;
  LidarInput front_;
  std::optional<LidarInput> rear_;
  MapInput map_;
  AreaInput area_;
  ZoneMarkers markers_;
  InterventionCounter interventions_;
  std::int64_t lock_age_ns_ = 0;
  std::vector<ros::Subscriber> lock_subscribers_;
  /// Locks of the emergency stops; advertised if there are any.
  ros::Publisher e_stops_;
  ros::Publisher wheels_;
  ros::Publisher status_;
  PublisherWatch publishers_;
  std::optional<BaseWatch> base_;
  std::string logged_kind_;
  bool logged_warning_ = false;
  std::optional<std::int64_t> begun_ns_;
  bool was_free_ = false;
  /// Consecutive zero commands since the shutdown request.
  int zeros_sent_ = 0;
};

}  // namespace mtr_drive_control
