/// @file
/// Recorded drive round the Car in a synthetic scene.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "map_names.hpp"
#include "mtr_surfel_map/testing/synthetic_world.hpp"

namespace mtr_localization {

namespace synthetic = mtr_surfel_map::synthetic;

/// Contents of the bag.
struct BagOptions {
  bool with_odometry = true;
  bool with_imu = true;
  bool with_scans = true;
  /// Recording delay of scans after their last beam.
  double scan_delay_s = 0.0;
  /// Scan time; some LiDARs report 0.
  double scan_time_s = 0.04;
};

/// Writes a standstill, an ellipse round the Car, and a standstill; 50 Hz, scans at 25 Hz with 360 beams.
class BagWriter {
 public:
  BagWriter(const std::string& path, const BagOptions& options) : options_(options) {
    bag_.open(path, rosbag::bagmode::Write);
  }

  /// Returns true poses in the frame of the Car, from 1 s on, every 20 ms.
  std::vector<PoseVector> write() {
    std::vector<PoseVector> truth(kStanding, place(0.0));
    for (int i = 1; i <= kDriving; ++i) {
      // Accelerates and brakes smoothly, so that the wheels never jump.
      const double part = static_cast<double>(i) / kDriving;
      truth.push_back(place(kTurn * (part - std::sin(2.0 * M_PI * part) / (2.0 * M_PI))));
    }
    truth.insert(truth.end(), 4 * kStanding, truth.back());
    for (std::size_t i = 1; i < truth.size(); ++i) {
      step(truth, i);
    }
    bag_.close();
    return truth;
  }

 private:
  static constexpr std::size_t kStanding = 75;
  static constexpr int kDriving = 1800;
  static constexpr double kTurn = 1.1 * 2.0 * M_PI;
  static constexpr double kStepS = 0.02;

  static PoseVector place(double angle) {
    return {4.2 * std::cos(angle), 2.9 * std::sin(angle), std::atan2(2.9 * std::cos(angle), -4.2 * std::sin(angle))};
  }

  double draw(double sigma) { return sigma * normal_(random_); }

  void step(const std::vector<PoseVector>& truth, std::size_t i) {
    const double time_s = 1.0 + kStepS * static_cast<double>(i);
    const PoseVector motion = relative(truth[i - 1], truth[i]);
    const double distance = std::copysign(motion.head<2>().norm(), motion.x());
    turned_ += motion[2];
    const double heading = wrapped(turned_);
    wheels_ += 0.998 * distance * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    if (options_.with_imu) {
      sensor_msgs::Imu imu;
      imu.angular_velocity.z = motion[2] / kStepS + 0.003 + (distance == 0.0 ? 0.0 : draw(0.001));
      write("/imu/data", imu, "imu", time_s, 0.0);
    }
    if (options_.with_scans && i % 2 == 0) {
      write("/front/scan", scan(truth, i), "front_lidar", time_s - 2.0 * kStepS, 2.0 * kStepS + options_.scan_delay_s);
    }
    if (options_.with_odometry) {
      nav_msgs::Odometry odometry;
      odometry.pose.pose.position.x = wheels_.x();
      odometry.pose.pose.position.y = wheels_.y();
      odometry.pose.pose.orientation.z = std::sin(heading / 2.0);
      odometry.pose.pose.orientation.w = std::cos(heading / 2.0);
      odometry.twist.twist.linear.x = distance / kStepS;
      odometry.twist.twist.angular.z = motion[2] / kStepS;
      write("/jackal_velocity_controller/odom", odometry, "odom", time_s, 0.0);
    }
  }

  /// Returns the sweep that ends at step i, with its motion distortion.
  sensor_msgs::LaserScan scan(const std::vector<PoseVector>& truth, std::size_t i) {
    constexpr int kBeams = 360;
    sensor_msgs::LaserScan message;
    message.angle_min = static_cast<float>(-0.75 * M_PI);
    message.angle_max = static_cast<float>(0.75 * M_PI);
    message.angle_increment = static_cast<float>(1.5 * M_PI / (kBeams - 1));
    message.scan_time = static_cast<float>(options_.scan_time_s);
    message.time_increment = static_cast<float>(1.5 * kStepS / kBeams);
    message.range_min = 0.1F;
    message.range_max = 30.0F;
    for (int beam = 0; beam < kBeams; ++beam) {
      const double steps = 1.5 * beam / kBeams;
      const std::size_t before = i - 2 + static_cast<std::size_t>(steps);
      const PoseVector motion = (steps - std::floor(steps)) * relative(truth[before], truth[before + 1]);
      const PoseVector lidar = compose(compose(truth[before], motion), {0.12, 0.0, 0.0});
      const double angle = lidar[2] + message.angle_min + static_cast<double>(beam) * message.angle_increment;
      const double range = synthetic::cast(world_, lidar.head<2>(), rotation(angle) * Eigen::Vector2d::UnitX());
      message.ranges.push_back(range > 0.0 ? static_cast<float>(range + draw(0.01))
                                           : std::numeric_limits<float>::infinity());
    }
    return message;
  }

  template <typename M>
  void write(const std::string& topic, M message, const std::string& frame, double stamp_s, double delay_s) {
    message.header.frame_id = frame;
    message.header.stamp = ros::Time(stamp_s);
    bag_.write(topic, ros::Time(stamp_s + delay_s), message);
  }

  BagOptions options_;
  rosbag::Bag bag_;
  synthetic::World world_ = synthetic::world_of("lot");
  Eigen::Vector2d wheels_ = Eigen::Vector2d::Zero();
  double turned_ = 0.0;
  std::mt19937 random_{11};
  std::normal_distribution<double> normal_{0.0, 1.0};
};

}  // namespace mtr_localization
