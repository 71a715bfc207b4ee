/// @file
/// Test areas and localized poses, as they arrive.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/ros/area_input.hpp"

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "mtr_drive_control/ros/conversions.hpp"

namespace mtr_drive_control {

namespace names = mtr_core::names;

AreaInput::AreaInput(ros::NodeHandle& node)
    : areas_(node.subscribe<mtr_msgs::TestArea>(
          names::kTestArea, 1,
          [this](const mtr_msgs::TestArea::ConstPtr& message) { area_ = test_area_of(*message); })),
      poses_(node.subscribe<mtr_msgs::LocalizedPose>(
          names::kLocalizedPose, 10, [this](const mtr_msgs::LocalizedPose::ConstPtr& message) { take(*message); },
          ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay())) {}

void AreaInput::take(const mtr_msgs::LocalizedPose& pose) {
  pose_ = area_pose_of(pose, mtr_core::time_of(pose.header.stamp, usual_age_ns_));
}

}  // namespace mtr_drive_control
