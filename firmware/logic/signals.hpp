/// @file
/// Warning signals for people near the robot: buzzer and beacon; the LEDs show the same, see board.cpp.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "config.hpp"

namespace mtr {

/// Numbers of FirmwareSignals.signal.
enum Signal : uint8_t {
  kNoSignal = 0,
  kSetsOff = 1,
  kReverses = 2,
  kSignalCount = 3,
};

/// True when the buzzer sounds in a slot of kLedSlotMs, 0 to 15.
bool buzzer_of(uint8_t signal, uint8_t slot);

/// Signals in force. The beacon outlives the host: a robot without a host stands in the way unattended.
class Signals {
 public:
  /// Follows an order; false, and nothing changes, for a signal that does not exist.
  bool order(uint8_t signal, bool has_beacon, uint32_t now_us);
  /// Ends a signal that was not ordered for kSignalSilenceUs.
  void step(uint32_t now_us);
  /// Ends the signal.
  void end() { signal_ = kNoSignal; }

  uint8_t signal() const { return signal_; }
  bool has_beacon() const { return has_beacon_; }

 private:
  uint32_t ordered_us_ = 0;
  uint8_t signal_ = kNoSignal;
  bool has_beacon_ = false;
};

}  // namespace mtr
