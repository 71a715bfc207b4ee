/// @file
/// Motion from wheels and gyro: prediction of the filter, and its reliability.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "map_names.hpp"
#include "motion/filter_history.hpp"
#include "motion/ground_level.hpp"
#include "motion/input_gate.hpp"
#include "motion/standstill.hpp"
#include "motion/tilt_filter.hpp"
#include "parameters.hpp"

namespace mtr_localization {

/// Reliability of wheels and gyro.
///
/// Starting -> tracking: the gyro bias is known after standstill.
/// Tracking -> interrupted: a data gap while stationary; -> tracking after standstill.
/// Tracking or interrupted -> lost: the robot moved during a gap. With a map, scans restore the pose. Without a map,
/// the pose is frozen until the Car is mapped again, because any other pose would be a guess.
enum class MotionState { kStarting, kTracking, kInterrupted, kLost };

/// Predicts from one wheel sample to the next.
class Odometry {
 public:
  explicit Odometry(const SensorParameters& parameters);

  /// Predicts to a usable sample. Returns the reason if the robot moved unobserved, so that scans must restore the
  /// pose.
  /// @param gyro covers the time since the previous sample
  /// @param has_map scans can restore a pose
  mtr_core::Problem predict(const GatedSample& sample, const YawRateHistory& gyro, bool has_map);

  /// Sets the pose in odom after a motion that could not be predicted.
  void lead(const PoseVector& odom);

  /// Starts a new map at the present pose; a lost pose is then irrelevant.
  void begin_map();

  FilterHistory& history() { return history_; }
  const FilterHistory& history() const { return history_; }
  const PoseFilter& filter() const { return history_.newest().filter; }

  MotionState state() const { return state_; }
  /// Empty while tracking.
  const mtr_core::Problem& problem() const { return problem_; }
  bool standing() const { return standstill_.standing(); }
  /// True after the first usable sample.
  bool has_begun() const { return last_.has_value(); }

  /// Pose of base_link in the wheel odometry: x, y (m), heading (rad).
  std::array<double, 3> wheel_odom() const;
  double speed_mps() const { return filter().corrected_speed(last_->linear_mps); }
  double yaw_rate_radps() const { return filter().corrected_rate(gyro_rate_radps_); }

 private:
  FilterInput input_since_last(const WheelSample& wheels, const YawRateHistory& gyro);
  Eigen::Vector2d slope_at(const WheelSample& wheels, const ImuSample& imu, double duration_s);
  double rate_for_standstill() const;
  mtr_core::Problem interrupt(const GatedSample& sample, bool has_map);
  mtr_core::Problem lose(const mtr_core::Problem& reason, bool has_map);
  void track();

  SensorParameters parameters_;
  FilterHistory history_;
  StandstillDetector standstill_;
  TiltFilter tilt_;
  GroundLevel level_;
  /// Pose at the last update of the ground level.
  PoseVector leveled_odom_ = PoseVector::Zero();
  std::optional<WheelSample> last_;
  double gyro_rate_radps_ = 0.0;
  MotionState state_ = MotionState::kStarting;
  mtr_core::Problem problem_;
};

}  // namespace mtr_localization
