/// @file
/// Finds where both stops are on the position sensor.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "position_sensor.hpp"
#include "stall_detector.hpp"

namespace mtr {

/// Drives slowly down until the lift stands still, then up. Whatever stops it on the way is taken for a stop, so a
/// person has to watch.
class LiftCalibrator {
 public:
  LiftCalibrator() : stall_(kCalibrationStallCounts) {}

  void start(uint16_t stroke_mm);
  void abort();

  /// One step of kLiftPeriodMs; returns the motor's duty, positive up.
  int16_t step(uint16_t counts);

  bool is_running() const { return phase_ == Phase::kDown || phase_ == Phase::kUp; }
  bool has_failed() const { return phase_ == Phase::kFailed; }
  /// True once after it has succeeded; then also what was found.
  bool take(Calibration* found);

 private:
  enum class Phase : uint8_t { kIdle, kDown, kUp, kDone, kFailed };

  void enter(Phase phase);

  StallDetector stall_;
  Calibration found_;
  uint16_t steps_ = 0;
  Phase phase_ = Phase::kIdle;
};

}  // namespace mtr
