/// @file
/// EEPROM, reset cause, and the RAM that the stack has not reached.
// SPDX-License-Identifier: Apache-2.0
#include <avr/eeprom.h>
#include <avr/io.h>
#include <avr/wdt.h>

#include "../hal.hpp"

extern uint8_t __heap_start;

namespace hal {
namespace {

constexpr uint8_t kPaint = 0xC5;
/// The stack may leave bytes unwritten; so many painted ones in a row are its end.
constexpr uint8_t kGapBytes = 16;

uint8_t cause __attribute__((section(".noinit")));
uint8_t* stack_end = reinterpret_cast<uint8_t*>(RAMEND);

}  // namespace

/// Runs before anything else: the watchdog stays on through a reset, and a short one would bite again during the start.
extern "C" void begin() __attribute__((naked, used, section(".init3")));

extern "C" void begin() {
  cause = MCUSR;
  MCUSR = 0;
  wdt_disable();
  for (uint8_t* byte = &__heap_start; byte <= reinterpret_cast<uint8_t*>(RAMEND); ++byte) {
    *byte = kPaint;
  }
}

uint8_t eeprom_read(uint8_t address) {
  return eeprom_read_byte(reinterpret_cast<const uint8_t*>(static_cast<uint16_t>(address)));
}

bool eeprom_ready() { return eeprom_is_ready(); }

void eeprom_write(uint8_t address, uint8_t value) {
  eeprom_write_byte(reinterpret_cast<uint8_t*>(static_cast<uint16_t>(address)), value);
}

uint8_t reset_cause() { return cause; }

uint16_t free_ram() {
  uint8_t painted = 0;
  for (uint8_t* byte = stack_end - 1; byte >= &__heap_start && painted < kGapBytes; --byte) {
    if (*byte == kPaint) {
      ++painted;
    } else {
      painted = 0;
      stack_end = byte;
    }
  }
  return static_cast<uint16_t>(stack_end - &__heap_start);
}

}  // namespace hal
