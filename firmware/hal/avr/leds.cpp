/// @file
/// Three LEDs on one port.
// SPDX-License-Identifier: Apache-2.0
#include <avr/io.h>

#include "../hal.hpp"
#include "board_avr.hpp"
#include "pins.hpp"

namespace hal {

void start_leds() { LED_DDR |= kLedMask; }

void leds_write(uint8_t bits) {
  LED_PORT = static_cast<uint8_t>((LED_PORT & ~kLedMask) | (bits << kFirstLed & kLedMask));
}

}  // namespace hal
