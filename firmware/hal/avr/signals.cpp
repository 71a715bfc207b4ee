/// @file
/// Stop input with pull-up, buzzer and beacon on one port.
// SPDX-License-Identifier: Apache-2.0
#include <avr/io.h>

#include "../hal.hpp"
#include "board_avr.hpp"
#include "pins.hpp"

namespace hal {
namespace {

void write(uint8_t pin, bool is_on) {
  if (is_on) {
    SIGNAL_PORT |= _BV(pin);
  } else {
    SIGNAL_PORT &= static_cast<uint8_t>(~_BV(pin));
  }
}

}  // namespace

void start_signals() {
  // The pull-up makes an open contact, a broken wire and a missing connector read high.
  SIGNAL_PORT |= _BV(kStopInput);
  SIGNAL_DDR |= _BV(kBuzzer) | _BV(kBeacon);
}

bool stop_input_open() { return (SIGNAL_PIN & _BV(kStopInput)) != 0; }

void buzzer_write(bool is_on) { write(kBuzzer, is_on); }

void beacon_write(bool is_on) { write(kBeacon, is_on); }

}  // namespace hal
