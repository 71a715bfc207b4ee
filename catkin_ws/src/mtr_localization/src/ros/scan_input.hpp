/// @file
/// A LiDAR's topic: which of its scans can be used, and waiting for the one that is due.
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

/// Waiting for inputs in lock-step; less patient than those that wait for localization, lest they give up on it.
std::optional<mtr_core::Waiting> input_waiting();

/// What the LiDARs' drivers leave out.
struct ScanParameters {
  /// From beam to beam, where the scans do not say it; 0: all are measured at once.
  double time_increment_s = 0.0;
};

/// Range and unit of each parameter.
inline constexpr std::array<mtr_core::ParameterRow<ScanParameters>, 1> kScanRows{
    {{"time_increment_s", &ScanParameters::time_increment_s, 0.0, 0.001, "s"}}};

/// Subscription to one LiDAR. Its mount is that of the frame that its scans name.
class ScanInput {
 public:
  /// @param take gets each sweep whose mount is known, in the callback
  ScanInput(ros::NodeHandle& node, Lidar lidar, RobotFrames& frames, const ScanParameters& parameters,
            std::function<void(Sweep)> take);
  ScanInput(const ScanInput&) = delete;
  ScanInput& operator=(const ScanInput&) = delete;

  /// In simulation: returns when the sweep that is due at a wheel sample has come, or the LiDAR is silent.
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
