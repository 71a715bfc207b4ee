/// @file
/// What went wrong since the reset, as FirmwareHealth reports it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

namespace mtr {

/// Numbers of FirmwareHealth.last_refusal.
enum class Refusal : uint8_t {
  kNone = 0,
  kHeight = 1,
  kLedPattern = 2,
  kPressId = 3,
  kServos = 4,
  kStrength = 5,
  kHold = 6,
  kBusy = 7,
  kCalibration = 8,
  kLate = 9,
  kStopped = 10,
  kSignal = 11,
};

struct Counters {
  uint16_t checksum_errors = 0;
  uint16_t skipped_frames = 0;
  uint16_t refused_commands = 0;
  uint16_t dropped_reports = 0;
  Refusal last_refusal = Refusal::kNone;

  void refuse(Refusal reason);
};

/// One more, up to the highest value.
inline void count(uint16_t* counter) {
  if (*counter != 0xFFFF) {
    ++*counter;
  }
}

inline void Counters::refuse(Refusal reason) {
  count(&refused_commands);
  last_refusal = reason;
}

}  // namespace mtr
