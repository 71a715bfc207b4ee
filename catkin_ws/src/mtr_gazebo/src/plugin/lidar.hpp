/// @file
/// LiDAR with beams cast by Gazebo's physics, each from the robot's pose at the time of the beam.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include <cstdint>
#include <gazebo/physics/physics.hh>
#include <random>

#include "core/sweep.hpp"
#include "plugin/values.hpp"

namespace mtr_gazebo {

/// Publishes a scan at the end of its turn, stamped with its first beam.
class Lidar {
 public:
  Lidar(const sdf::ElementPtr& element, const gazebo::physics::LinkPtr& base, std::uint64_t seed, ros::NodeHandle& ros);

  /// Casts the beams that were due in the last step.
  void update(const Step& step);

 private:
  void cast(const Beam& beam, std::int64_t now_ns);
  void publish(std::int64_t start_ns);

  SweepFigures figures_;
  Sweep sweep_;
  ignition::math::Pose3d base_from_lidar_;
  gazebo::physics::LinkPtr base_;
  gazebo::physics::RayShapePtr ray_;
  double noise_m_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  sensor_msgs::LaserScan scan_;
  ros::Publisher publisher_;
};

}  // namespace mtr_gazebo
