/// @file
/// LED patterns, one per state of the robot.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

namespace mtr {

/// Numbers of FirmwareCommand.led_pattern.
enum LedPattern : uint8_t {
  kLedOff = 0,
  kLedStarting = 1,
  kLedReady = 2,
  kLedMapping = 3,
  kLedMoving = 4,
  kLedPressing = 5,
  kLedPaused = 6,
  kLedError = 7,
  kLedLinkLost = 8,
  kLedWarning = 9,
  kLedSetsOff = 10,
  kLedPatternCount = 11,
};

constexpr uint16_t kLedSlotMs = 125;

/// LEDs that are lit in a slot of kLedSlotMs, 0 to 15: bit 0 green, 1 yellow, 2 red.
uint8_t leds_of(uint8_t pattern, uint8_t slot);

}  // namespace mtr
