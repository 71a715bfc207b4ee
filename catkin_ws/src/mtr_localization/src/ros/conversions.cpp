/// @file
/// Conversions between ROS messages and core types.
// SPDX-License-Identifier: Apache-2.0
#include "ros/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map_names.hpp"
#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"

namespace mtr_localization {
namespace {

// Cosine of 5 degrees.
constexpr double kLevel = 0.996;

// Tolerance of the norm of a rotation quaternion, for single precision and rounding in text.
constexpr double kNormTolerance = 0.05;

/// Returns the direction of the rotated x axis in the plane, or NaN for an invalid rotation, such as a zero quaternion.
double heading_of(const geometry_msgs::Quaternion& rotation) {
  const double norm =
      std::sqrt(rotation.w * rotation.w + rotation.x * rotation.x + rotation.y * rotation.y + rotation.z * rotation.z);
  if (!(std::abs(norm - 1.0) <= kNormTolerance)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::atan2(2.0 * (rotation.w * rotation.z + rotation.x * rotation.y),
                    1.0 - 2.0 * (rotation.y * rotation.y + rotation.z * rotation.z));
}

std::uint8_t mode_of(PoseMode mode) {
  switch (mode) {
    case PoseMode::kMapping:
      return mtr_msgs::LocalizedPose::MAPPING;
    case PoseMode::kLocalized:
      return mtr_msgs::LocalizedPose::LOCALIZED;
    case PoseMode::kLost:
      return mtr_msgs::LocalizedPose::LOST;
    default:
      return mtr_msgs::LocalizedPose::DEAD_RECKONING;
  }
}

}  // namespace

ImuSample imu_sample_of(const sensor_msgs::Imu& message) {
  const auto& rate = message.angular_velocity;
  const auto& force = message.linear_acceleration;
  // REP-145: a covariance of -1 marks a quantity that is not measured.
  const bool has_force = message.linear_acceleration_covariance[0] != -1.0;
  return {mtr_core::to_ns(message.header.stamp),
          rate.z,
          {rate.x, rate.y},
          has_force ? Eigen::Vector3d(force.x, force.y, force.z) : Eigen::Vector3d::Zero()};
}

GnssFix gnss_fix_of(const sensor_msgs::NavSatFix& message, const Eigen::Vector2d& antenna) {
  const auto& covariance = message.position_covariance;
  const bool is_known = message.status.status >= sensor_msgs::NavSatStatus::STATUS_FIX &&
                        message.position_covariance_type != sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN;
  // Larger eigenvalue of the horizontal covariance.
  const double mean = 0.5 * (covariance[0] + covariance[4]);
  const double variance = mean + std::hypot(0.5 * (covariance[0] - covariance[4]), covariance[1]);
  const double rad = M_PI / 180.0;
  return {mtr_core::to_ns(message.header.stamp), rad * message.latitude, rad * message.longitude,
          is_known ? std::sqrt(variance) : 0.0, antenna};
}

WheelSample wheel_sample_of(const nav_msgs::Odometry& message) {
  return {mtr_core::to_ns(message.header.stamp),     message.pose.pose.position.x, message.pose.pose.position.y,
          heading_of(message.pose.pose.orientation), message.twist.twist.linear.x, message.twist.twist.angular.z};
}

MapOrder order_of(const mtr_msgs::MappingOrder& message) {
  MapOrder order{mtr_core::to_ns(message.header.stamp), message.map_car_id, MapOrder::Phase::kIdle};
  if (message.phase == mtr_msgs::MappingOrder::COLLECT) {
    order.phase = MapOrder::Phase::kCollect;
  } else if (message.phase == mtr_msgs::MappingOrder::FREEZE) {
    order.phase = MapOrder::Phase::kFreeze;
  }
  return order;
}

Sweep sweep_of(const sensor_msgs::LaserScan& message, Lidar lidar, const Mount& mount) {
  const double sense = mount.upside_down ? -1.0 : 1.0;
  Sweep sweep;
  sweep.lidar = lidar;
  sweep.stamp_ns = mtr_core::to_ns(message.header.stamp);
  sweep.mount = mount.pose;
  sweep.mount_height_m = mount.height_m;
  sweep.angle_min_rad = sense * message.angle_min;
  sweep.angle_max_rad = sense * message.angle_max;
  sweep.angle_increment_rad = sense * message.angle_increment;
  sweep.time_increment_s = message.time_increment;
  sweep.scan_time_s = message.scan_time;
  sweep.range_min_m = message.range_min;
  sweep.range_max_m = message.range_max;
  sweep.ranges_m.assign(message.ranges.begin(), message.ranges.end());
  return sweep;
}

std::optional<Mount> mount_from(const geometry_msgs::TransformStamped& base_from_lidar) {
  const auto& q = base_from_lidar.transform.rotation;
  const double upright = 1.0 - 2.0 * (q.x * q.x + q.y * q.y);
  if (std::abs(upright) < kLevel) {
    return std::nullopt;
  }
  return Mount{pose_of(base_from_lidar.transform), base_from_lidar.transform.translation.z, upright < 0.0};
}

PoseVector pose_of(const geometry_msgs::Transform& transform) {
  return {transform.translation.x, transform.translation.y, heading_of(transform.rotation)};
}

mtr_msgs::LocalizedPose message_of(const Estimate& estimate) {
  mtr_msgs::LocalizedPose message;
  message.header.stamp = mtr_core::stamp_of(estimate.stamp_ns);
  message.header.frame_id = mtr_core::names::kMap;
  message.valid = estimate.valid;
  message.x = estimate.x_m;
  message.y = estimate.y_m;
  message.heading = estimate.heading_rad;
  std::copy(estimate.covariance.begin(), estimate.covariance.end(), message.covariance.begin());
  message.speed_mps = estimate.speed_mps;
  message.yaw_rate_radps = estimate.yaw_rate_radps;
  message.message = estimate.message.text;
  message.problems = mtr_core::messages_of<mtr_msgs::Problem>(estimate.message);
  message.mode = mode_of(estimate.mode);
  message.degenerate = estimate.degenerate;
  message.map_revision = estimate.map_revision;
  message.origin_id = estimate.origin_id;
  return message;
}

geometry_msgs::TransformStamped map_from_odom_message(std::int64_t stamp_ns, const Estimate& estimate,
                                                      const std::array<double, 3>& odom) {
  const PoseVector pose(estimate.x_m, estimate.y_m, estimate.heading_rad);
  const PoseVector base(odom[0], odom[1], odom[2]);
  const PoseVector map_from_odom = compose(pose, relative(base, PoseVector::Zero()));
  return transform_message(stamp_ns, {mtr_core::names::kMap, mtr_core::names::kOdom, map_from_odom.x(),
                                      map_from_odom.y(), map_from_odom.z()});
}

geometry_msgs::TransformStamped transform_message(std::int64_t stamp_ns, const Transform2& parent_from_child) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = mtr_core::stamp_of(stamp_ns);
  message.header.frame_id = parent_from_child.parent;
  message.child_frame_id = parent_from_child.child;
  message.transform.translation.x = parent_from_child.x_m;
  message.transform.translation.y = parent_from_child.y_m;
  message.transform.rotation.z = std::sin(0.5 * parent_from_child.heading_rad);
  message.transform.rotation.w = std::cos(0.5 * parent_from_child.heading_rad);
  return message;
}

}  // namespace mtr_localization
