/// @file
/// What hangs on which register of each microcontroller; the counterpart of hal/avr/pins.hpp.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace emulator {

/// A pin by the data address of its PORT register; DDR is one below.
struct Pin {
  std::uint16_t port;
  std::uint8_t bit;
};

struct Wiring {
  const char* mcu;
  Pin motor_pwm;
  Pin motor_up;
  Pin leds[3];
  Pin buzzer;
  Pin beacon;
  /// Port letter and bit of the stop input, as simavr names them.
  char stop_port;
  std::uint8_t stop_bit;
  /// Highest data address of I/O registers; RAM begins behind it.
  std::uint16_t last_register;
};

/// Wiring of a microcontroller. Throws std::invalid_argument when there is none.
const Wiring& wiring_of(const std::string& mcu);

// The same on both
constexpr std::uint16_t kTccr2a = 0xB0, kTccr2b = 0xB1, kOcr2b = 0xB4;
constexpr std::uint8_t kCom2b1 = 0x20, kClockSelect = 0x07;
constexpr std::uint16_t kMcusr = 0x54;
constexpr std::uint8_t kPowerOn = 1, kExternal = 2;

}  // namespace emulator
