/// @file
/// Input of one LiDAR: selection of usable scans, and waiting for the scan that is due.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "mtr_core/parameter.hpp"
#include "mtr_core/samples.hpp"
#include "ros/conversions.hpp"
#include "ros/robot_frames.hpp"

namespace mtr_localization {

/// Returns the limits of waiting in lock-step; shorter than the limits of nodes that wait for localization.
std::optional<mtr_core::Waiting> input_waiting();

/// Scan properties that some drivers do not report.
struct ScanParameters {
  /// Time between beams for scans that do not state it; 0: all beams are simultaneous.
  double time_increment_s = 0.0;
};

/// Name, range and unit of each parameter.
inline constexpr std::array<mtr_core::ParameterRow<ScanParameters>, 1> kScanRows{
    {{"time_increment_s", &ScanParameters::time_increment_s, 0.0, 0.001, "s"}}};

/// Subscription to one LiDAR. The frame of its scans defines the mount.
class ScanInput {
 public:
  /// @param take receives each sweep with a known mount, within the callback
  ScanInput(ros::NodeHandle& node, Lidar lidar, RobotFrames& frames, const ScanParameters& parameters,
            std::function<void(Sweep)> take);
  ScanInput(const ScanInput&) = delete;
  ScanInput& operator=(const ScanInput&) = delete;

  /// In simulation: returns when the sweep that is due at a wheel sample has arrived, or the LiDAR is silent.
  void wait_until_due(std::int64_t stamp_ns);

 private:
  void receive(const sensor_msgs::LaserScan& message);

  Lidar lidar_;
  RobotFrames& frames_;
  ScanParameters parameters_;
  std::function<void(Sweep)> take_;
  mtr_core::Samples<std::int64_t> received_;
  ros::Subscriber subscriber_;
};

}  // namespace mtr_localization
