/// @file
/// The base: velocity commands to the wheels, ODE friction on the ground, and odometry from the wheel angles.
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

  /// Sets the wheel motors for the next step.
  void drive(double step_s);

  /// Publishes odometry when due.
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
