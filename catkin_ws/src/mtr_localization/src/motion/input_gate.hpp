/// @file
/// Wheels and gyro joined by their stamps; what is late, silent or makes no sense is told apart from what can be used.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "motion/yaw_rate_history.hpp"
#include "mtr_core/problem.hpp"
#include "samples.hpp"

namespace mtr_localization {

/// What the gyro saw over a time: integral of its rate, without its bias taken off.
struct GyroTurn {
  double duration_s = 0.0;
  double angle_rad = 0.0;
};

/// A wheel sample whose turn has come.
struct GatedSample {
  WheelSample wheels;
  /// Why it cannot be used; none when it can.
  mtr_core::Problem problem;
  /// Wheels or gyro were silent or jumped since the last sample that could be used.
  mtr_core::Problem interruption;
  /// Of an interruption of the wheels alone: how the robot turned meanwhile.
  std::optional<GyroTurn> turn_meanwhile = {};
};

/// Gives each wheel sample as soon as IMU data reaches its stamp; the order in which the two arrive does not matter.
class InputGate {
 public:
  /// @param gap_limit_s a longer gap in either is an interruption
  explicit InputGate(double gap_limit_s);

  void add_imu(const ImuSample& sample);
  void add_wheels(const WheelSample& sample);

  /// The next wheel sample, unless it still waits for the IMU.
  std::optional<GatedSample> next();

  /// The sample has been used: the gyro's rates before it are not needed any more.
  void release(const GatedSample& sample) { gyro_.forget_before(sample.wheels.stamp_ns); }

  /// A problem while wheel odometry is silent.
  mtr_core::Problem silence(std::int64_t now_ns) const;

  /// Those that are newer than all before: late data counts for the pose, but consumers already know of later times.
  std::vector<Estimate> in_order(std::vector<Estimate> estimates);

  const YawRateHistory& gyro() const { return gyro_; }

 private:
  /// The sensor, or its driver, says the same again and again although the wheels move.
  bool is_frozen(const ImuSample& sample);
  /// The base's driver says the same again and again: a place that does not change at a speed.
  bool is_frozen(const WheelSample& sample);
  mtr_core::Problem problem_with(const WheelSample& wheels) const;
  mtr_core::Problem interruption_before(const WheelSample& wheels);
  /// None where the gyro was silent, too.
  std::optional<GyroTurn> turn_before(const WheelSample& wheels) const;

  std::int64_t gap_limit_ns_;
  YawRateHistory gyro_;
  std::optional<ImuSample> newest_imu_;
  int imu_repeats_ = 0;
  std::optional<WheelSample> newest_wheels_;
  int wheel_repeats_ = 0;
  bool wheels_are_frozen_ = false;
  /// Stamp of the newest wheel sample that did not say what the one before it said.
  std::int64_t fresh_wheels_ns_ = 0;
  std::deque<WheelSample> pending_;
  std::optional<WheelSample> last_used_;
  std::optional<std::int64_t> newest_wheels_ns_;
  std::optional<std::int64_t> emitted_ns_;
  /// Why the next sample does not continue what was before.
  mtr_core::Problem restart_;
};

}  // namespace mtr_localization
