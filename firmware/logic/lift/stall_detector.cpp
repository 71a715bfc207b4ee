/// @file
/// Progress within a time.
// SPDX-License-Identifier: Apache-2.0
#include "stall_detector.hpp"

namespace mtr {

bool StallDetector::step(int16_t drive, int32_t position) {
  const auto direction = static_cast<int8_t>(drive > 0 ? 1 : drive < 0 ? -1 : 0);
  const bool moved = (position - anchor_) * direction >= least_way_;
  if (direction == 0 || direction != direction_ || moved) {
    progressed_ = direction != 0 && direction == direction_;
    direction_ = direction;
    anchor_ = position;
    steps_ = 0;
    return false;
  }
  return ++steps_ >= kStallSteps;
}

}  // namespace mtr
