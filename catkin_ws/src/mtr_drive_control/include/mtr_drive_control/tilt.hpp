/// @file
/// Tilt of the robot from the direction of gravity, and its restrictions.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "mtr_core/problem.hpp"
#include "mtr_drive_control/geometry.hpp"
#include "mtr_drive_control/motion_watch.hpp"
#include "mtr_drive_control/tip_over.hpp"

namespace mtr_drive_control {

/// Direction or rate with its components along x, y and z of base_link.
struct Vector3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// Estimate of the upward direction, in the frame of the IMU, which is base_link's, z up (REP-103, REP-145).
///
/// A complementary filter: the gyro turns the estimate from reading to reading, and the accelerometer pulls it slowly
/// towards the measured specific force, less the acceleration that the wheels report. Braking, jolts and noise are
/// shorter than this pull, and a ramp is still detected at once. While the wheels are stopped, the gyro's mean is its
/// bias.
class GravityEstimate {
 public:
  /// Includes a reading; one with the stamp of the previous reading has no effect.
  /// @param wheels measured velocity; empty if unknown
  void take(const ImuReading& imu, const std::optional<Velocity>& wheels);

  /// Angle between up and the z axis of base_link, 0 to pi; empty while no recent reading has shown gravity.
  std::optional<double> tilt_at(std::int64_t tick_ns) const;

 private:
  void restart(const ImuReading& imu, const std::optional<Velocity>& wheels);
  void turn(const ImuReading& imu, double step_s);
  void learn_bias(const ImuReading& imu, const std::optional<Velocity>& wheels, double step_s);
  void pull(const ImuReading& imu, const Vector3& acceleration, double step_s);
  /// Acceleration of base_link from its wheels since the previous reading.
  Vector3 acceleration_of(const ImuReading& imu, const std::optional<Velocity>& wheels, double step_s) const;

  std::optional<std::int64_t> stamp_ns_;
  /// Stamp of the last reading that showed gravity.
  std::optional<std::int64_t> seen_ns_;
  std::optional<Velocity> wheels_;
  Vector3 up_;
  /// The same, without motion that is shorter than a jolt.
  Vector3 smooth_up_;
  Vector3 bias_radps_;
  /// Durations of the readings used so far, each limited to its filter's time.
  double pulled_s_ = 0.0;
  double rested_s_ = 0.0;
};

/// Evaluates the tilt: the robot stops from tilt_stop_rad on, and while the tilt is unknown.
class TiltWatch {
 public:
  explicit TiltWatch(const Parameters& parameters) : parameters_(parameters) {}

  /// Updates the estimate; must be called once per tick.
  /// @param imu,wheels fresh readings; empty without one
  void take(std::int64_t tick_ns, const std::optional<ImuReading>& imu, const std::optional<Velocity>& wheels);

  /// Limits with the key at this height on the current slope. While it is too steep for the planner they are for a
  /// person who drives the robot off.
  Limits limits_at(double key_height_m) const;

  bool is_known() const { return is_known_; }

  /// Reason why the robot must stop; no problem if it may move within these limits.
  mtr_core::Problem problem(const Limits& limits, bool by_hand) const;

  /// Sentence while the slope is too steep for the planner; no problem elsewhere.
  mtr_core::Problem warning() const;

 private:
  Parameters parameters_;
  GravityEstimate gravity_;
  /// Last known tilt.
  double tilt_rad_ = 0.0;
  bool is_known_ = false;
  /// With hysteresis, so that noise on a slope at the limit causes only one stop.
  bool is_tilted_ = false;
};

}  // namespace mtr_drive_control
