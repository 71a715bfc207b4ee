/// @file
/// Plausibility of the potentiometer's readings.
// SPDX-License-Identifier: Apache-2.0
#include "position_sensor.hpp"

namespace mtr {
namespace {

/// Slope with 8 bits behind the point: 9206 counts times 33369 fit into 31 bits, and rounding costs 20 um at the end.
constexpr uint8_t kSlopeBits = 8;

}  // namespace

bool Calibration::is_plausible() const {
  return low >= kBrokenLow && high <= kBrokenHigh && high > low && high - low >= kSmallestSpan &&
         stroke_mm >= kShortestStrokeMm && stroke_mm <= kLongestStrokeMm;
}

int32_t Calibration::height_um(uint16_t counts) const {
  const int32_t span = static_cast<int32_t>(high) - low;
  const int32_t slope = ((stroke_um() << kSlopeBits) + span / 2) / span;
  return ((static_cast<int32_t>(counts) - low) * slope) >> kSlopeBits;
}

bool PositionSensor::add(uint16_t reading) {
  sum_ = static_cast<uint16_t>(sum_ + reading);
  if (++samples_ < kSamplesPerStep) {
    return false;
  }
  judge(sum_);
  sum_ = samples_ = 0;
  return true;
}

void PositionSensor::judge(uint16_t counts) {
  const uint16_t change = counts > counts_ ? counts - counts_ : counts_ - counts;
  const bool jumped = has_counts_ && change > kJumpLimit;
  counts_ = counts;
  has_counts_ = true;
  if (jumped || counts < kBrokenLow || counts > kBrokenHigh) {
    good_steps_ = 0;
  } else if (good_steps_ < kSensorGoodSteps) {
    ++good_steps_;
  }
}

}  // namespace mtr
