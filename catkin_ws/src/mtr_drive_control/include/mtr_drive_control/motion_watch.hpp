/// @file
/// Checks the robot's motion against the commands: base, wheel odometry and gyro are compared with each other.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "mtr_core/problem.hpp"
#include "mtr_drive_control/collision/echoes.hpp"

namespace mtr_drive_control {

/// Reading of the IMU.
struct ImuReading {
  std::int64_t stamp_ns;
  /// Angular velocity about x, y, z of the IMU, z up, in rad/s.
  std::array<double, 3> rates_radps;
  /// Specific force along them, in m/s2.
  std::array<double, 3> forces_mps2;

  double yaw_rate_radps() const { return rates_radps[2]; }
  /// False if one of the values is implausible for a robot's IMU.
  bool is_plausible() const;
  bool repeats(const ImuReading& other) const {
    return rates_radps == other.rates_radps && forces_mps2 == other.forces_mps2;
  }
};

/// Duration of an uninterrupted condition.
class Duration {
 public:
  /// Updates the condition at a tick; returns true if it has lasted for this time.
  bool lasts(bool is_so, std::int64_t tick_ns, double for_s);

 private:
  std::optional<std::int64_t> since_ns_;
};

/// Check of the motion: each fault is reported with its cause, and never after a single reading.
///
/// The wheels follow with a delay, so their motion is compared with all recent commands. Live sensors never repeat
/// themselves in motion: encoders count, and the IMU has noise. At standstill the wheels may repeat their values or
/// not: encoders flicker, and servos settle.
class MotionWatch {
 public:
  /// Accepts the velocity sent last and the newest readings of a tick; returns a problem while they contradict each
  /// other.
  /// @param motion,imu fresh readings; empty without one
  mtr_core::Problem take(std::int64_t tick_ns, const Velocity& sent, const std::optional<Motion>& motion,
                         const std::optional<ImuReading>& imu);

 private:
  void remember(std::int64_t tick_ns, const Velocity& sent);
  bool was_told_to_move() const;
  bool obeys(const Velocity& measured) const;
  mtr_core::Problem wheels_problem(std::int64_t tick_ns, const Motion& motion);
  mtr_core::Problem imu_problem(std::int64_t tick_ns, const std::optional<Motion>& motion, const ImuReading& imu);

  struct Told {
    std::int64_t tick_ns;
    Velocity velocity;
  };

  std::deque<Told> told_;
  std::optional<Motion> motion_;
  std::optional<ImuReading> imu_;
  bool odometry_repeats_ = false;
  bool imu_repeats_ = false;
  Duration standing_;
  Duration frozen_odometry_;
  Duration frozen_imu_;
  Duration disobedience_;
  Duration slip_;
};

}  // namespace mtr_drive_control
