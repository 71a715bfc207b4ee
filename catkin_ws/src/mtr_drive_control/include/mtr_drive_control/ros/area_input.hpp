/// @file
/// The test area and the localized pose.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/LocalizedPose.h>
#include <mtr_msgs/TestArea.h>
#include <ros/ros.h>

#include <memory>
#include <optional>

#include "mtr_drive_control/area/area_guard.hpp"

namespace mtr_drive_control {

/// Subscription to both; a silent dispatcher is a motion lock, and the last area remains in force.
class AreaInput {
 public:
  explicit AreaInput(ros::NodeHandle& node);

  AreaInputs at() const { return {area_, pose_}; }

 private:
  void take(const mtr_msgs::LocalizedPose& pose);

  std::shared_ptr<const TestArea> area_;
  std::optional<AreaPose> pose_;
  std::int64_t usual_age_ns_ = 0;
  ros::Subscriber areas_;
  ros::Subscriber poses_;
};

}  // namespace mtr_drive_control
