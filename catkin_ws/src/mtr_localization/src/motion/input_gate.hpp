/// @file
/// Time alignment of wheels and gyro, with detection of late, missing and implausible samples.
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

/// Integral of the gyro rate over a time, including its bias.
struct GyroTurn {
  double duration_s = 0.0;
  double angle_rad = 0.0;
};

/// Wheel sample that is ready for processing.
struct GatedSample {
  WheelSample wheels;
  /// Reason why the sample is not usable, or empty.
  mtr_core::Problem problem;
  /// Reason of an interruption (silence or jump of wheels or gyro) since the last usable sample, or empty.
  mtr_core::Problem interruption;
  /// Turn of the robot during an interruption of the wheels only.
  std::optional<GyroTurn> turn_meanwhile = {};
};

/// Releases each wheel sample when IMU data covers its stamp, independent of the order of arrival.
class InputGate {
 public:
  /// @param gap_limit_s longer gaps in either input are interruptions
  explicit InputGate(double gap_limit_s);

  void add_imu(const ImuSample& sample);
  void add_wheels(const WheelSample& sample);

  /// Returns the next wheel sample, or nothing while it waits for the IMU.
  std::optional<GatedSample> next();

  /// Drops the gyro rates before a processed sample.
  void release(const GatedSample& sample) { gyro_.forget_before(sample.wheels.stamp_ns); }

  /// Returns a problem while wheel odometry is silent.
  mtr_core::Problem silence(std::int64_t now_ns) const;

  /// Returns the estimates newer than all previous ones: late data improves the pose, but consumers must not see time
  /// go back.
  std::vector<Estimate> in_order(std::vector<Estimate> estimates);

  const YawRateHistory& gyro() const { return gyro_; }

 private:
  /// True if the IMU repeats identical values although the wheels move.
  bool is_frozen(const ImuSample& sample);
  /// True if the wheel odometry repeats an unchanged position at a nonzero speed.
  bool is_frozen(const WheelSample& sample);
  mtr_core::Problem problem_with(const WheelSample& wheels) const;
  mtr_core::Problem interruption_before(const WheelSample& wheels);
  /// Returns nothing if the gyro was silent, too.
  std::optional<GyroTurn> turn_before(const WheelSample& wheels) const;

  std::int64_t gap_limit_ns_;
  YawRateHistory gyro_;
  std::optional<ImuSample> newest_imu_;
  int imu_repeats_ = 0;
  std::optional<WheelSample> newest_wheels_;
  int wheel_repeats_ = 0;
  bool wheels_are_frozen_ = false;
  /// Stamp of the newest wheel sample that differed from its predecessor.
  std::int64_t fresh_wheels_ns_ = 0;
  std::deque<WheelSample> pending_;
  std::optional<WheelSample> last_used_;
  std::optional<std::int64_t> newest_wheels_ns_;
  std::optional<std::int64_t> emitted_ns_;
  /// Reason why the next sample does not continue the previous ones.
  mtr_core::Problem restart_;
};

}  // namespace mtr_localization
