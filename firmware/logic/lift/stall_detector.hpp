/// @file
/// Notices that something is driven and does not move.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "../config.hpp"

namespace mtr {

/// A stall is kStallSteps steps in one direction without having come least_way further in that direction.
class StallDetector {
 public:
  explicit StallDetector(int32_t least_way) : least_way_(least_way) {}

  void reset() {
    direction_ = 0;
    progressed_ = false;
  }

  /// One step; drive is the motor's duty. True when it stalls.
  bool step(int16_t drive, int32_t position);

  /// True when it has come further since the last reset.
  bool has_progressed() const { return progressed_; }

 private:
  int32_t least_way_;
  int32_t anchor_ = 0;
  uint8_t steps_ = 0;
  int8_t direction_ = 0;
  bool progressed_ = false;
};

}  // namespace mtr
