/// @file
/// A LiDAR's topic: which of its scans can be used, and waiting for the one that is due.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "mtr_core/samples.hpp"
#include "ros/conversions.hpp"

namespace mtr_localization {

/// Waiting for inputs in lock-step; less patient than those that wait for localization, lest they give up on it.
std::optional<mtr_core::Waiting> input_waiting();

/// Subscription to one LiDAR. Its mounting comes from tf, once for each frame that its scans name.
class ScanInput {
 public:
  /// @param take gets each sweep whose mounting is known, in the callback
  ScanInput(ros::NodeHandle& node, Lidar lidar, const tf2_ros::Buffer& frames, std::function<void(Sweep)> take);
  ScanInput(const ScanInput&) = delete;
  ScanInput& operator=(const ScanInput&) = delete;

  /// In simulation: returns when the sweep that is due at a wheel sample has come, or the LiDAR is silent.
  void wait_until_due(std::int64_t stamp_ns);

 private:
  void receive(const sensor_msgs::LaserScan& message);
  const Mount* mount_of(const std::string& frame);
  std::optional<Mount> look_up(const std::string& frame) const;

  Lidar lidar_;
  const tf2_ros::Buffer& frames_;
  std::function<void(Sweep)> take_;
  std::map<std::string, Mount> mounts_;
  std::string unknown_frame_;
  mtr_core::Samples<std::int64_t> received_;
  ros::Subscriber subscriber_;
};

}  // namespace mtr_localization
