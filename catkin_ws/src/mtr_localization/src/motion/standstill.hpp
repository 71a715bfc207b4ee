/// @file
/// Whether the robot stands still.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "parameters.hpp"
#include "samples.hpp"

namespace mtr_localization {

/// Standstill: wheels at rest for the settling time, and the gyro quiet.
class StandstillDetector {
 public:
  explicit StandstillDetector(const SensorParameters& parameters) : parameters_(parameters) {}

  /// Takes the next samples; the rate is the gyro's without its bias.
  void update(const WheelSample& wheels, double yaw_rate_radps);

  /// Forgets the past, as after a gap.
  void reset() { resting_since_ns_.reset(); }

  /// True when the newest samples show no motion.
  bool resting() const { return resting_since_ns_.has_value(); }

  /// True when the robot has rested for the settling time.
  bool standing() const { return standing_s() >= 0.0; }

  /// Time since the robot has been taken to stand still, s; negative when it does not.
  double standing_s() const;

 private:
  SensorParameters parameters_;
  std::optional<std::int64_t> resting_since_ns_;
  std::int64_t now_ns_ = 0;
};

}  // namespace mtr_localization
