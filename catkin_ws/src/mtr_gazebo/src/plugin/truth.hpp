/// @file
/// Ground truth: robot and key in the true Car's frame, and the lift that carries the key.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Pose2D.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>

#include <gazebo/physics/physics.hh>
#include <set>
#include <string>

#include "plugin/values.hpp"

namespace mtr_gazebo {

/// Publishes pose and key, moves the lift to the firmware's position, teleports the robot on request, and logs contacts
/// of the robot.
class Truth {
 public:
  Truth(const sdf::ElementPtr& plugin, const gazebo::physics::ModelPtr& model, ros::NodeHandle& ros);

  /// Sets the lift's motor for the next step.
  void drive();

  /// Publishes when due.
  void update(const Step& step);

 private:
  void lift(const std_msgs::Float64& height_m);
  void kidnap(const geometry_msgs::Pose2D& there);
  void publish_pose(std::int64_t now_ns);
  void publish_key(std::int64_t now_ns);
  void log_contacts(std::int64_t now_ns);
  [[nodiscard]] std::set<std::string> touched() const;

  mtr_core::Slot slot_;
  ignition::math::Pose3d world_from_car_;
  gazebo::physics::ModelPtr model_;
  gazebo::physics::LinkPtr base_;
  double base_height_m_;
  gazebo::physics::JointPtr lift_joint_;
  gazebo::physics::LinkPtr carriage_;
  ignition::math::Vector3d key_on_carriage_;
  double lift_m_{0.0};
  std::set<std::string> touched_;
  ros::Publisher pose_publisher_;
  ros::Publisher key_publisher_;
  ros::Subscriber lift_subscriber_;
  ros::Subscriber kidnap_subscriber_;
};

}  // namespace mtr_gazebo
