/// @file
/// A board without a board: what the logic reads can be set, what it does can be seen.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "../hal/hal.hpp"
#include "../logic/config.hpp"

namespace hal_host {

struct Hardware {
  std::uint32_t now_us = mtr::kClockStartUs;
  std::uint8_t ticks = 0;
  std::deque<std::uint8_t> to_firmware;
  std::vector<std::uint8_t> from_firmware;
  std::uint8_t room = 255;
  /// Reading of the position sensor; at first that of the lower stop.
  std::uint16_t position = 51;
  std::int16_t duty = 0;
  std::array<std::uint16_t, mtr::kServoCount> servo_us{};
  /// When the period of the servos began that runs now.
  std::uint32_t period_us = mtr::kClockStartUs;
  bool is_servo_turn = false;
  std::uint8_t leds = 0;
  /// Contact at the stop input; nothing is connected at first.
  bool is_stop_open = true;
  bool buzzer = false;
  bool beacon = false;
  std::array<std::uint8_t, 64> eeprom{};
  std::uint8_t reset_cause = 1;

  /// Lets 1 ms pass.
  void pass_ms();
};

/// The one board there is.
Hardware& hardware();

/// Power off and on; an erased EEPROM.
void renew();

}  // namespace hal_host
