/// @file
/// ROS messages to the core's types and back.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/conversions.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_lockstep/clock.hpp"
#include "mtr_lockstep/names.hpp"

namespace mtr_localization {

ImuSample imu_sample_of(const sensor_msgs::Imu& message) {
  return {mtr_lockstep::to_ns(message.header.stamp), message.angular_velocity.z};
}

WheelSample wheel_sample_of(const nav_msgs::Odometry& message) {
  const auto& rotation = message.pose.pose.orientation;
  const double heading = std::atan2(2.0 * (rotation.w * rotation.z + rotation.x * rotation.y),
                                    1.0 - 2.0 * (rotation.y * rotation.y + rotation.z * rotation.z));
  return {mtr_lockstep::to_ns(message.header.stamp),
          message.pose.pose.position.x,
          message.pose.pose.position.y,
          heading,
          message.twist.twist.linear.x,
          message.twist.twist.angular.z};
}

mtr_msgs::LocalizedPose message_of(const Estimate& estimate) {
  mtr_msgs::LocalizedPose message;
  message.header.stamp = mtr_lockstep::stamp_of(estimate.stamp_ns);
  message.header.frame_id = mtr_lockstep::names::kMap;
  message.valid = estimate.valid;
  message.x = estimate.x_m;
  message.y = estimate.y_m;
  message.heading = estimate.heading_rad;
  std::copy(estimate.covariance.begin(), estimate.covariance.end(), message.covariance.begin());
  message.speed_mps = estimate.speed_mps;
  message.yaw_rate_radps = estimate.yaw_rate_radps;
  message.message = estimate.message;
  return message;
}

geometry_msgs::TransformStamped transform_message(std::int64_t stamp_ns, const Transform2& parent_from_child) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = mtr_lockstep::stamp_of(stamp_ns);
  message.header.frame_id = parent_from_child.parent;
  message.child_frame_id = parent_from_child.child;
  message.transform.translation.x = parent_from_child.x_m;
  message.transform.translation.y = parent_from_child.y_m;
  message.transform.rotation.z = std::sin(0.5 * parent_from_child.heading_rad);
  message.transform.rotation.w = std::cos(0.5 * parent_from_child.heading_rad);
  return message;
}

}  // namespace mtr_localization
