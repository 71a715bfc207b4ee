/// @file
/// Position of the lift from its potentiometer.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "../config.hpp"

namespace mtr {

/// Where the stops are on the sensor, and how far apart.
struct Calibration {
  uint16_t low = kNominalLow;
  uint16_t high = kNominalHigh;
  uint16_t stroke_mm = kNominalStrokeMm;

  int32_t stroke_um() const { return stroke_mm * 1000L; }
  bool is_plausible() const;
  /// Height of a sum of readings above the lower stop.
  int32_t height_um(uint16_t counts) const;
};

/// Adds up readings, so that noise averages out, and knows a broken wire: beyond either end, or a jump.
class PositionSensor {
 public:
  /// Takes a reading, one per ms; true when a step's sum is complete.
  bool add(uint16_t reading);

  /// Newest sum of kSamplesPerStep readings.
  uint16_t counts() const { return counts_; }
  bool is_broken() const { return good_steps_ < kSensorGoodSteps; }

 private:
  void judge(uint16_t counts);

  uint16_t sum_ = 0;
  uint16_t counts_ = 0;
  uint8_t samples_ = 0;
  uint8_t good_steps_ = kSensorGoodSteps;
  bool has_counts_ = false;
};

}  // namespace mtr
