/// @file
/// Table of buzzer patterns, and the end of orders that are not repeated.
// SPDX-License-Identifier: Apache-2.0
#include "signals.hpp"

#include "progmem.hpp"

namespace mtr {
namespace {

/// Slots of 2 s as bits.
const uint16_t kBuzzer[kSignalCount] PROGMEM = {
    0x0000,  // none
    0x5555,  // about to set off: four beeps per second
    0x0F0F,  // reversing: a beep of 0.5 s per second
};

}  // namespace

bool buzzer_of(uint8_t signal, uint8_t slot) { return (pgm_read_word(&kBuzzer[signal]) >> slot & 1) != 0; }

bool Signals::order(uint8_t signal, bool has_beacon, uint32_t now_us) {
  if (signal >= kSignalCount) {
    return false;
  }
  signal_ = signal;
  has_beacon_ = has_beacon;
  ordered_us_ = now_us;
  return true;
}

void Signals::step(uint32_t now_us) {
  if (now_us - ordered_us_ > kSignalSilenceUs) {
    end();
  }
}

}  // namespace mtr
