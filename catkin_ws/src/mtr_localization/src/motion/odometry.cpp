/// @file
/// Conversion of an interval of wheels and gyro to filter input, with handling of interruptions.
// SPDX-License-Identifier: Apache-2.0
#include "motion/odometry.hpp"

#include <cmath>

#include "mtr_core/sensor_figures.hpp"
#include "problems.hpp"

namespace mtr_localization {
namespace {

// Wheel motion over an interruption below which the robot counts as stationary.
constexpr double kUnmovedM = 0.01;
constexpr double kUnmovedRad = 0.02;
// Largest gyro rate at rest that may be a bias, rad/s: 4 sigma of the bias at switch-on.
constexpr double kMaxBiasRadps = 4.0 * mtr_core::sensor_figures::kAssumedGyroBiasAtStartRadps;
// Distance and turn between the tilt samples for the ground level.
constexpr double kLevelEveryM = 0.3;
constexpr double kLevelEveryRad = 0.3;

}  // namespace

Odometry::Odometry(const SensorParameters& parameters)
    : parameters_(parameters),
      history_(PoseFilter(parameters), 0),
      standstill_(parameters),
      problem_(problems::kStandStill()) {
  if (parameters.begins_in_motion) {
    track();
  }
}

mtr_core::Problem Odometry::predict(const GatedSample& sample, const YawRateHistory& gyro, bool has_map) {
  const WheelSample& wheels = sample.wheels;
  mtr_core::Problem loss;
  gyro_rate_radps_ = gyro.rate_at(wheels.stamp_ns);
  if (last_ && !sample.interruption) {
    standstill_.update(wheels, rate_for_standstill());
    if (state_ == MotionState::kInterrupted && !standstill_.resting()) {
      loss = lose(problem_, has_map);
    }
    history_.advance(wheels.stamp_ns, input_since_last(wheels, gyro));
  } else {
    if (last_) {
      loss = interrupt(sample, has_map);
    }
    history_.restart(filter(), wheels.stamp_ns, history_.newest().odom);
  }
  last_ = wheels;
  return loss;
}

FilterInput Odometry::input_since_last(const WheelSample& wheels, const YawRateHistory& gyro) {
  FilterInput input;
  input.motion.duration_s = static_cast<double>(wheels.stamp_ns - last_->stamp_ns) * 1e-9;
  input.slope = slope_at(wheels, gyro.sample_at(wheels.stamp_ns), input.motion.duration_s);
  input.slope_sigma = level_.sigma();
  if (state_ == MotionState::kLost) {
    return input;
  }
  if (standstill_.standing()) {
    input.kind = FilterInput::Kind::kStand;
    input.motion.gyro_angle_rad = gyro_rate_radps_ * input.motion.duration_s;
  } else if (state_ == MotionState::kTracking) {
    input.kind = FilterInput::Kind::kMove;
    input.motion.distance_m = wheels.distance_since(*last_);
    input.motion.gyro_angle_rad = gyro.integral(last_->stamp_ns, wheels.stamp_ns);
  }
  if (standstill_.standing_s() >= parameters_.bias_time_s) {
    track();
  }
  return input;
}

Eigen::Vector2d Odometry::slope_at(const WheelSample& wheels, const ImuSample& imu, double duration_s) {
  tilt_.advance(duration_s, imu, wheels.linear_mps, standstill_.standing());
  const PoseVector& odom = history_.newest().odom;
  const PoseVector moved = relative(leveled_odom_, odom);
  if (moved.head<2>().norm() > kLevelEveryM || std::abs(moved.z()) > kLevelEveryRad) {
    level_.add(odom.z(), tilt_.slope());
    leveled_odom_ = odom;
  }
  return level_.relative(odom.z(), tilt_.slope());
}

double Odometry::rate_for_standstill() const {
  // While the bias is unknown, only a rate above any possible bias proves a turn.
  const bool bias_unknown = state_ == MotionState::kStarting && std::abs(gyro_rate_radps_) <= kMaxBiasRadps;
  return bias_unknown ? 0.0 : filter().corrected_rate(gyro_rate_radps_);
}

mtr_core::Problem Odometry::interrupt(const GatedSample& sample, bool has_map) {
  const WheelSample& wheels = sample.wheels;
  const double moved_m = std::hypot(wheels.x_m - last_->x_m, wheels.y_m - last_->y_m);
  const double turned_rad = std::remainder(wheels.heading_rad - last_->heading_rad, 2.0 * M_PI);
  const bool unmoved = moved_m <= kUnmovedM && std::abs(turned_rad) <= kUnmovedRad;
  mtr_core::Problem loss;
  if (state_ == MotionState::kTracking && standstill_.standing() && unmoved) {
    state_ = MotionState::kInterrupted;
    problem_ = sample.interruption;
  } else if (state_ == MotionState::kTracking || (state_ == MotionState::kInterrupted && !unmoved)) {
    loss = lose(sample.interruption, has_map);
  }
  standstill_.reset();
  return loss;
}

mtr_core::Problem Odometry::lose(const mtr_core::Problem& reason, bool has_map) {
  mtr_core::Problem loss = reason;
  if (has_map) {
    track();
    return loss;
  }
  state_ = MotionState::kLost;
  problem_ = problems::kLost({{"cause", reason}});
  return {};
}

void Odometry::track() {
  state_ = MotionState::kTracking;
  problem_ = {};
}

void Odometry::lead(const PoseVector& odom) { history_.restart(filter(), history_.newest().stamp_ns, odom); }

void Odometry::begin_map() {
  if (state_ == MotionState::kLost) {
    track();
  }
}

std::array<double, 3> Odometry::wheel_odom() const {
  return last_ ? std::array<double, 3>{last_->x_m, last_->y_m, last_->heading_rad} : std::array<double, 3>{};
}

}  // namespace mtr_localization
