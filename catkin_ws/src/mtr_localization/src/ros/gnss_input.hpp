/// @file
/// Fixes of a satellite receiver, where there is one.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/NavSatFix.h>

#include <functional>
#include <string>

#include "ros/robot_frames.hpp"
#include "samples.hpp"

namespace mtr_localization {

/// Subscription that gives fixes whose antenna is in the robot's description; says in one sentence why others are not
/// used.
class GnssInput {
 public:
  /// @param take gets each fix; false: it is refused
  GnssInput(ros::NodeHandle& node, const RobotFrames& frames, std::function<bool(const GnssFix&)> take);

 private:
  void receive(const sensor_msgs::NavSatFix& message);
  /// Empty when the fix was taken.
  std::string problem_of(const sensor_msgs::NavSatFix& message) const;

  const RobotFrames& frames_;
  std::function<bool(const GnssFix&)> take_;
  std::string problem_;
  ros::Subscriber subscriber_;
};

}  // namespace mtr_localization
