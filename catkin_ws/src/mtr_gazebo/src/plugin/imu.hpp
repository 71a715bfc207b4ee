/// @file
/// The IMU: means over its period, with its errors.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <cstdint>
#include <gazebo/physics/physics.hh>

#include "core/imu_errors.hpp"
#include "plugin/values.hpp"

namespace mtr_gazebo {

/// Publishes at the ticks of its own slot, without an orientation.
class Imu {
 public:
  Imu(const sdf::ElementPtr& element, const gazebo::physics::LinkPtr& base, std::uint64_t seed, ros::NodeHandle& ros);

  /// Adds the state at the end of a step, and publishes when due.
  void update(const Step& step);

 private:
  void publish(std::int64_t now_ns);
  [[nodiscard]] ignition::math::Vector3d velocity() const;

  mtr_core::Slot slot_;
  double period_s_;
  ignition::math::Pose3d base_from_imu_;
  gazebo::physics::LinkPtr base_;
  ImuErrors errors_;
  ignition::math::Vector3d turned_;
  ignition::math::Vector3d velocity_before_;
  std::int64_t since_ns_{0};
  sensor_msgs::Imu message_;
  ros::Publisher publisher_;
};

}  // namespace mtr_gazebo
