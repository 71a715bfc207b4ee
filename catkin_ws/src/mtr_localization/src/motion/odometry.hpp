/// @file
/// Motion by wheels and gyro: the filter's prediction, and how far it can be trusted.
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

/// How far wheels and gyro can be trusted.
///
/// Starting -> tracking: the gyro's bias is known after standstill.
/// Tracking -> interrupted: a gap in the data while the robot stood still; -> tracking after standstill.
/// Tracking or interrupted -> lost: it moved unseen. With a map the scans find the pose again; without one it is frozen
/// until the Car is mapped anew, for any other would be a guess.
enum class MotionState { kStarting, kTracking, kInterrupted, kLost };

/// Predicts from one wheel sample to the next.
class Odometry {
 public:
  explicit Odometry(const SensorParameters& parameters);

  /// Goes on to a sample that can be used. @param gyro covers the time since the one before. @param has_map scans can
  /// find a pose again. Returns the reason when they must: the robot moved unseen.
  mtr_core::Problem predict(const GatedSample& sample, const YawRateHistory& gyro, bool has_map);

  /// The robot is there in odom: what led it there was no motion that could be predicted.
  void lead(const PoseVector& odom);

  /// A new map begins here: a pose that was lost does not matter any more.
  void begin_map();

  FilterHistory& history() { return history_; }
  const FilterHistory& history() const { return history_; }
  const PoseFilter& filter() const { return history_.newest().filter; }

  MotionState state() const { return state_; }
  /// None while tracking.
  const mtr_core::Problem& problem() const { return problem_; }
  bool standing() const { return standstill_.standing(); }
  /// A sample has been used.
  bool has_begun() const { return last_.has_value(); }

  /// Base_link in the wheels' own odometry: x, y (m), heading (rad).
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
  /// Where the ground's level was learned last.
  PoseVector leveled_odom_ = PoseVector::Zero();
  std::optional<WheelSample> last_;
  double gyro_rate_radps_ = 0.0;
  MotionState state_ = MotionState::kStarting;
  mtr_core::Problem problem_;
};

}  // namespace mtr_localization
