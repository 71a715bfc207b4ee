/// @file
/// Standstill detector.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "parameters.hpp"
#include "samples.hpp"

namespace mtr_localization {

/// Detects standstill: wheels at rest for the settling time, and a quiet gyro.
class StandstillDetector {
 public:
  explicit StandstillDetector(const SensorParameters& parameters) : parameters_(parameters) {}

  /// Adds the next samples; the rate is corrected by the gyro bias.
  void update(const WheelSample& wheels, double yaw_rate_radps);

  /// Forgets the past, as after a gap.
  void reset() { resting_since_ns_.reset(); }

  /// True if the newest samples show no motion.
  bool resting() const { return resting_since_ns_.has_value(); }

  /// True if the robot has rested for the settling time.
  bool standing() const { return standing_s() >= 0.0; }

  /// Time since the start of the standstill, s; negative while the robot moves.
  double standing_s() const;

 private:
  SensorParameters parameters_;
  std::optional<std::int64_t> resting_since_ns_;
  std::int64_t now_ns_ = 0;
};

}  // namespace mtr_localization
