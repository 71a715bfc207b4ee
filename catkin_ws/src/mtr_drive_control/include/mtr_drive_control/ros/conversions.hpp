/// @file
/// Messages of the topics as plain types, and back.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/DriveStatus.h>
#include <mtr_msgs/PeripheralsState.h>
#include <mtr_msgs/VelocityCommand.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>

#include <memory>
#include <optional>
#include <string>

#include "mtr_drive_control/drive_control.hpp"

namespace mtr_drive_control {

// Null messages, before the first of a topic, give nothing.
std::optional<SourceCommand> command_of(const mtr_msgs::VelocityCommand::ConstPtr& message);
std::optional<Motion> motion_of(const nav_msgs::Odometry::ConstPtr& message);
std::optional<KeyHeight> key_height_of(const mtr_msgs::PeripheralsState::ConstPtr& message);
mtr_msgs::DriveStatus status_message(std::int64_t tick_ns, const Decision& decision);

/// Sweeps of one LiDAR; a message is converted once.
class SweepReader {
 public:
  explicit SweepReader(std::string frame) : frame_(std::move(frame)) {}

  std::shared_ptr<const Sweep> read(const sensor_msgs::LaserScan::ConstPtr& message);

 private:
  std::string frame_;
  sensor_msgs::LaserScan::ConstPtr message_;
  std::shared_ptr<const Sweep> sweep_;
};

}  // namespace mtr_drive_control
