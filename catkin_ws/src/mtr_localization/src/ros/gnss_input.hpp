/// @file
/// Optional satellite receiver.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/NavSatFix.h>

#include <functional>
#include <string>

#include "ros/robot_frames.hpp"
#include "samples.hpp"

namespace mtr_localization {

/// Subscription to fixes whose antenna is in the robot description; logs one sentence about rejected fixes.
class GnssInput {
 public:
  /// @param take receives each fix and returns false if it is rejected
  GnssInput(ros::NodeHandle& node, const RobotFrames& frames, std::function<bool(const GnssFix&)> take);

 private:
  void receive(const sensor_msgs::NavSatFix& message);
  /// Returns the reason of a rejection, or an empty text.
  std::string problem_of(const sensor_msgs::NavSatFix& message) const;

  const RobotFrames& frames_;
  std::function<bool(const GnssFix&)> take_;
  std::string problem_;
  ros::Subscriber subscriber_;
};

}  // namespace mtr_localization
