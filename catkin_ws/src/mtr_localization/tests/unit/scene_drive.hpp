/// @file
/// Robot with noisy wheels, gyro and LiDAR that drives through a scene and feeds a pose source.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "localizer.hpp"
#include "map_names.hpp"
#include "mtr_surfel_map/testing/synthetic_world.hpp"

namespace mtr_localization {

namespace synthetic = mtr_surfel_map::synthetic;

namespace scenes {

inline void add_box(synthetic::World& world, const PoseVector& pose, double length_m, double width_m) {
  const double x = 0.5 * length_m;
  const double y = 0.5 * width_m;
  synthetic::add_polygon(world, {{x, y}, {-x, y}, {-x, -y}, {x, -y}}, pose);
}

/// Returns the Car alone, with its centre at the origin.
inline synthetic::World open() {
  synthetic::World world;
  add_box(world, {0.0, 0.0, 0.0}, 4.5, 1.8);
  return world;
}

/// Returns the Car, two walls and another car, without any symmetry.
inline synthetic::World lot() {
  synthetic::World world = open();
  world.push_back({{-14.0, 11.0}, {9.0, 12.5}});
  world.push_back({{13.0, -9.0}, {12.0, 10.0}});
  add_box(world, {-11.0, -4.0, 1.2}, 4.3, 1.7);
  return world;
}

}  // namespace scenes

inline constexpr std::int64_t kTickNs = 20'000'000;
inline constexpr double kTickS = 0.02;
inline constexpr int kBeams = 360;
inline constexpr double kFieldRad = 4.7;

/// Simulated drive. The truth is in the frame of the scene; `map_truth` is the pose in map, which starts at the start
/// pose.
class SceneDrive {
 public:
  SceneDrive(synthetic::World scene, const Parameters& parameters, unsigned seed = 1)
      : SceneDrive(std::move(scene), std::make_unique<Localizer>(in_lockstep(parameters)), seed) {}

  SceneDrive(synthetic::World scene, std::unique_ptr<PoseSource> source, unsigned seed = 1)
      : world(std::move(scene)), source_(std::move(source)), random_(seed) {
    poses_.assign(3, truth);
  }

  /// Drives round the Car after a standstill, and returns to the start.
  void drive_round() {
    for (const double side_m : {5.6, 8.4, 5.6, 8.4}) {
      drive(0.6, 0.0, side_m / 0.6);
      drive(0.0, M_PI_2 / 2.0, 2.0);
    }
    drive(0.6, 0.0, 1.5);
  }

  /// Runs the whole mapping and returns the result.
  MapResult map(std::uint64_t map_car_id = 1) {
    drive(0.0, 0.0, 2.0);
    order(map_car_id, MapOrder::Phase::kCollect);
    drive_round();
    drive(0.0, 0.0, 0.5);
    order(map_car_id, MapOrder::Phase::kFreeze);
    result.reset();
    drive(0.0, 0.0, 3.0);
    return result ? *result : MapResult{};
  }

  void order(std::uint64_t map_car_id, MapOrder::Phase phase) { source_->add_order({now_ns, map_car_id, phase}); }

  Estimate drive(double linear_mps, double angular_radps, double duration_s) {
    for (long step = std::lround(duration_s / kTickS); step > 0; --step) {
      tick(linear_mps, angular_radps);
    }
    return newest;
  }

  void tick(double linear_mps, double angular_radps) {
    now_ns += kTickNs;
    const double turn = angular_radps * kTickS;
    truth = compose(truth, {linear_mps * kTickS, 0.0, 0.0});
    truth.z() = wrapped(truth.z() + turn);
    poses_.erase(poses_.begin());
    poses_.push_back(truth);
    if (now_ns % (2 * kTickNs) == 0 && lidar_works && hears && now_ns > 3 * kTickNs) {
      Sweep seen = sweep();
      ranges_ = lidar_is_frozen ? ranges_ : seen.ranges_m;
      seen.ranges_m = ranges_;
      if (lidar_is_covered) {
        std::fill(seen.ranges_m.begin(), seen.ranges_m.end(), std::numeric_limits<float>::quiet_NaN());
      }
      EXPECT_EQ(source_->add_scan(std::move(seen)).empty(), !lidar_is_frozen);
    }
    feel(linear_mps, angular_radps);
  }

  /// Lifts the robot and puts it down elsewhere, in the frame of the scene.
  void carry(double x_m, double y_m, double turn_rad) {
    truth += PoseVector(x_m, y_m, turn_rad);
    poses_.assign(3, truth);
  }

  /// Places persons round the robot, 1 m away.
  void surround() {
    for (double angle = 0.0; angle < 2.0 * M_PI; angle += 0.25) {
      persons.emplace_back(truth.x() + std::cos(angle), truth.y() + std::sin(angle));
    }
  }

  PoseVector map_truth() const { return relative(start_, truth); }

  PoseVector error() const {
    PoseVector error = PoseVector(newest.x_m, newest.y_m, newest.heading_rad) - map_truth();
    error.z() = wrapped(error.z());
    return error;
  }

  double position_error_m() const { return error().head<2>().norm(); }
  double position_sigma_m() const { return std::sqrt(newest.covariance[0] + newest.covariance[4]); }

  static Parameters in_lockstep(Parameters parameters) {
    parameters.lockstep = true;
    return parameters;
  }

  PoseSource& localizer() { return *source_; }

  /// Ends the process and starts another one with the stored state.
  void start_anew(Memory memory) {
    auto localizer = std::make_unique<Localizer>(in_lockstep(Parameters{}));
    localizer->go_on(std::move(memory));
    source_ = std::move(localizer);
  }

  /// Returns the state that the process would store now.
  Memory memory(const MapResult& map) const {
    Memory memory{map.map, map.map_car_id, map.revision, {}};
    memory.pose.emplace();
    memory.pose->pose << newest.x_m, newest.y_m, newest.heading_rad;
    memory.pose->covariance = Eigen::Map<const Eigen::Matrix3d>(newest.covariance.data());
    memory.pose->wheel_odom = newest.wheel_odom;
    memory.pose->origin_id = newest.origin_id;
    return memory;
  }

  synthetic::World world;
  PoseVector truth{4.2, -2.8, M_PI_2};
  std::int64_t now_ns = 1'000'000'000;
  bool lidar_works = true;
  /// The driver repeats its last message.
  bool imu_is_frozen = false;
  bool wheels_are_frozen = false;
  bool lidar_is_frozen = false;
  /// The LiDAR reports no range of any beam.
  bool lidar_is_covered = false;
  /// Accelerometer reading; 0 without an accelerometer.
  double gravity_mps2 = 0.0;
  /// False: the sensors work, but nothing arrives.
  bool hears = true;
  double range_bias_m = 0.0;
  double range_noise_m = 0.01;
  /// Share of beams that hit a rain drop.
  double rain = 0.0;
  /// Centres of persons with a radius of 0.2 m.
  std::vector<Eigen::Vector2d> persons;
  Estimate newest;
  std::optional<MapResult> result;
  int lost_ticks = 0;

 private:
  double noise(double sigma) { return sigma * normal_(random_); }

  void feel(double linear_mps, double angular_radps) {
    if (!imu_is_frozen) {
      imu_.yaw_rate_radps = angular_radps + 0.003 + noise(1e-3);
      const Eigen::Vector3d own((linear_mps - wheels_.linear_mps) / kTickS, linear_mps * angular_radps, gravity_mps2);
      imu_.force_mps2 = gravity_mps2 > 0.0 ? own : Eigen::Vector3d::Zero();
    }
    wheels_.stamp_ns = now_ns;
    const double along = linear_mps * kTickS * 1.003;
    wheels_.x_m += along * std::cos(wheels_.heading_rad);
    wheels_.y_m += along * std::sin(wheels_.heading_rad);
    wheels_.heading_rad += 1.4 * angular_radps * kTickS;
    wheels_.linear_mps = linear_mps;
    wheels_.angular_radps = angular_radps;
    if (!hears) {
      return;
    }
    imu_.stamp_ns = now_ns;
    take(source_->add_imu(imu_));
    if (!wheels_are_frozen) {
      said_ = wheels_;
    }
    said_.stamp_ns = now_ns;
    take(source_->add_wheels(said_));
    take(source_->check_silence(now_ns));
  }

  void take(const std::vector<Estimate>& estimates) {
    for (const Estimate& estimate : estimates) {
      newest = estimate;
      lost_ticks += estimate.mode == PoseMode::kLost ? 1 : 0;
    }
    if (auto map = source_->take_map()) {
      result = std::move(map);
    }
  }

  /// Returns the sweep of the last 40 ms, with each beam from the pose at its time.
  Sweep sweep() {
    Sweep sweep;
    sweep.stamp_ns = now_ns - 2 * kTickNs;
    sweep.mount = {0.12, 0.0, 0.0};
    sweep.angle_min_rad = -0.5 * kFieldRad;
    sweep.angle_max_rad = 0.5 * kFieldRad;
    sweep.angle_increment_rad = kFieldRad / (kBeams - 1);
    sweep.scan_time_s = 2.0 * kTickS;
    sweep.time_increment_s = 0.03 / kBeams;
    sweep.range_min_m = 0.1;
    sweep.range_max_m = 30.0;
    for (int beam = 0; beam < kBeams; ++beam) {
      sweep.ranges_m.push_back(static_cast<float>(range(sweep, beam)));
    }
    return sweep;
  }

  double range(const Sweep& sweep, int beam) {
    const double ticks = beam * sweep.time_increment_s / kTickS;
    const auto before = static_cast<std::size_t>(ticks);
    const PoseVector step = relative(poses_[before], poses_[before + 1]);
    const PoseVector eye = compose(compose(poses_[before], (ticks - static_cast<double>(before)) * step), sweep.mount);
    const double angle = eye.z() + sweep.angle_min_rad + beam * sweep.angle_increment_rad;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    double range = synthetic::cast(world, eye.head<2>(), direction);
    for (const Eigen::Vector2d& person : persons) {
      const Eigen::Vector2d offset = person - eye.head<2>();
      const double along = offset.dot(direction);
      const double aside = offset.squaredNorm() - along * along;
      const double nearest = along - std::sqrt(std::max(0.0, 0.04 - aside));
      if (along > 0.0 && aside < 0.04 && (range < 0.0 || nearest < range)) {
        range = nearest;
      }
    }
    if (range < 0.0 || range > sweep.range_max_m) {
      range = std::numeric_limits<double>::infinity();
    } else {
      range += range_bias_m + noise(range_noise_m);
    }
    return uniform_(random_) < rain ? std::min(range, 0.3 + 5.0 * uniform_(random_)) : range;
  }

  std::unique_ptr<PoseSource> source_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  PoseVector start_ = truth;
  /// Poses at the last three ticks.
  std::vector<PoseVector> poses_;
  std::vector<float> ranges_;
  ImuSample imu_{0, 0.0};
  WheelSample wheels_{0, 0.0, 0.0, 0.0, 0.0, 0.0};
  /// Wheel odometry as published by the driver.
  WheelSample said_ = wheels_;
};

}  // namespace mtr_localization
