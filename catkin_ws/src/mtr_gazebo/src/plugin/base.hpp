/// @file
/// The base: velocity commands to the wheels, which ODE's friction holds on the ground, and odometry from their angles.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <gazebo/physics/physics.hh>
#include <vector>

#include "core/base_drive.hpp"
#include "core/wheel_odometry.hpp"
#include "plugin/values.hpp"

namespace mtr_gazebo {

/// Joints of one side.
using Side = std::vector<gazebo::physics::JointPtr>;

class Base {
 public:
  Base(const sdf::ElementPtr& element, const gazebo::physics::ModelPtr& model, ros::NodeHandle& ros);

  /// Set the wheels' motors for the step that begins.
  void drive(double step_s);

  /// Publish odometry when it is time.
  void update(const Step& step);

 private:
  void command(const geometry_msgs::Twist& twist);

  mtr_core::Slot slot_;
  BaseDrive drive_;
  WheelOdometry odometry_;
  Side left_;
  Side right_;
  nav_msgs::Odometry message_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

}  // namespace mtr_gazebo
