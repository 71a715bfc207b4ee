/// @file
/// Converts messages of the topics to plain types, and back.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/DriveStatus.h>
#include <mtr_msgs/LocalizedPose.h>
#include <mtr_msgs/MotionLock.h>
#include <mtr_msgs/PeripheralsState.h>
#include <mtr_msgs/RobotMode.h>
#include <mtr_msgs/TestArea.h>
#include <mtr_msgs/VelocityCommand.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mtr_core/tick_input.hpp"
#include "mtr_drive_control/drive_control.hpp"
#include "mtr_drive_control/interventions.hpp"

namespace mtr_drive_control {

using mtr_core::Received;

// Without a message, before the first of a topic, the result is empty.
std::optional<SourceCommand> command_of(const Received<mtr_msgs::VelocityCommand>& received);

/// Limit of the state machine's newest mode; its stamp is kNeverNs before the first.
SpeedLimit speed_limit_of(const Received<mtr_msgs::RobotMode>& received);
std::optional<Motion> motion_of(const Received<nav_msgs::Odometry>& received);
std::optional<ImuReading> imu_reading_of(const Received<sensor_msgs::Imu>& received);
std::optional<KeyHeight> key_height_of(const Received<mtr_msgs::PeripheralsState>& received);
mtr_msgs::DriveStatus status_message(std::int64_t stamp_ns, const Decision& decision, const Interventions& counted);

/// State of an emergency stop with its own topic, as the lock of an owner with the topic's name.
mtr_msgs::MotionLock e_stop_message(std::int64_t stamp_ns, const std::string& topic,
                                    const std::vector<EngagedLock>& engaged);

/// Area to be enforced. Corners without a valid area count as an area without room, in which all motion is forbidden.
std::shared_ptr<const TestArea> test_area_of(const mtr_msgs::TestArea& message);
/// Pose in the area; empty unless it is valid and finite.
std::optional<AreaPose> area_pose_of(const mtr_msgs::LocalizedPose& message, std::int64_t time_ns);

/// Occupied cells of a map; null for inconsistent dimensions.
std::shared_ptr<const SiteMap> site_map_of(const nav_msgs::OccupancyGrid& message);

/// Converter of one LiDAR's sweeps; each message is converted once.
class SweepReader {
 public:
  explicit SweepReader(std::string frame) : frame_(std::move(frame)) {}

  std::shared_ptr<const Sweep> read(const Received<sensor_msgs::LaserScan>& received);

 private:
  std::string frame_;
  sensor_msgs::LaserScan::ConstPtr message_;
  std::shared_ptr<const Sweep> sweep_;
};

}  // namespace mtr_drive_control
