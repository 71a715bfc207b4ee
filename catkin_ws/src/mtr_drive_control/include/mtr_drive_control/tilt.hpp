/// @file
/// Tilt of the robot by the direction of gravity, and what it forbids.
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

/// Estimate of the direction that is up, in the frame of the IMU: that of base_link, z up (REP-103, REP-145).
///
/// A complementary filter: the gyro turns the estimate from reading to reading, and the accelerometer pulls it slowly
/// towards the measured specific force, less the acceleration that the wheels report. Braking, jolts and noise are
/// shorter than this pull, and a ramp is still seen at once. While the wheels stand, the gyro's mean is its bias.
class GravityEstimate {
 public:
  /// Includes a reading; one with the stamp of the previous reading changes nothing.
  /// @param wheels measured velocity; nothing when it is not known
  void take(const ImuReading& imu, const std::optional<Velocity>& wheels);

  /// Angle between up and the z axis of base_link, 0 to pi; nothing while no reading has shown gravity lately.
  std::optional<double> tilt_at(std::int64_t tick_ns) const;

 private:
  void restart(const ImuReading& imu, const std::optional<Velocity>& wheels);
  void turn(const ImuReading& imu, double step_s);
  void learn_bias(const ImuReading& imu, const std::optional<Velocity>& wheels, double step_s);
  void pull(const ImuReading& imu, const Vector3& acceleration, double step_s);
  /// Acceleration of base_link by its wheels since the previous reading.
  Vector3 acceleration_of(const ImuReading& imu, const std::optional<Velocity>& wheels, double step_s) const;

  std::optional<std::int64_t> stamp_ns_;
  /// Stamp of the last reading that showed gravity.
  std::optional<std::int64_t> seen_ns_;
  std::optional<Velocity> wheels_;
  Vector3 up_;
  /// The same without what is shorter than a jolt.
  Vector3 smooth_up_;
  Vector3 bias_radps_;
  /// Duration of the readings so far that were used, each up to its filter's time.
  double pulled_s_ = 0.0;
  double rested_s_ = 0.0;
};

/// Judges the tilt: the robot stops from tilt_stop_rad on, and when the tilt is not known.
class TiltWatch {
 public:
  explicit TiltWatch(const Parameters& parameters) : parameters_(parameters) {}

  /// To be called once per tick.
  /// @param imu,wheels fresh ones; nothing when there is none
  void take(std::int64_t tick_ns, const std::optional<ImuReading>& imu, const std::optional<Velocity>& wheels);

  /// Limits with the key at this height on the present slope. While it is too steep for the planner they are those at
  /// which a person drives the robot off.
  Limits limits_at(double key_height_m) const;

  bool is_known() const { return is_known_; }

  /// Reason why the robot must stand; no problem when it may move within these limits.
  mtr_core::Problem problem(const Limits& limits, bool by_hand) const;

  /// Sentence while the slope is too steep for the planner; no problem elsewhere.
  mtr_core::Problem warning() const;

 private:
  Parameters parameters_;
  GravityEstimate gravity_;
  /// The last one that was known.
  double tilt_rad_ = 0.0;
  bool is_known_ = false;
  /// With hysteresis, so that noise on a slope at the limit is one stop.
  bool is_tilted_ = false;
};

}  // namespace mtr_drive_control
