/// @file
/// The hal on plain memory.
// SPDX-License-Identifier: Apache-2.0
#include "hal_host.hpp"

namespace hal_host {

Hardware& hardware() {
  static Hardware only;
  return only;
}

void renew() {
  hardware() = Hardware();
  hardware().eeprom.fill(0xFF);
}

void Hardware::pass_ms() {
  now_us += 1000;
  ++ticks;
  if (now_us - period_us >= mtr::kServoPeriodUs) {
    period_us += mtr::kServoPeriodUs;
    is_servo_turn = true;
  }
}

}  // namespace hal_host

namespace hal {

using hal_host::hardware;

std::uint32_t clock_us() { return hardware().now_us; }

std::uint8_t take_ticks() {
  const std::uint8_t taken = hardware().ticks;
  hardware().ticks = 0;
  return taken;
}

bool uart_take(std::uint8_t* byte) {
  auto& waiting = hardware().to_firmware;
  if (waiting.empty()) {
    return false;
  }
  *byte = waiting.front();
  waiting.pop_front();
  return true;
}

std::uint8_t uart_room() { return hardware().room; }
void uart_put(std::uint8_t byte) { hardware().from_firmware.push_back(byte); }
std::uint16_t uart_overruns() { return 0; }
std::uint16_t uart_dropped() { return 0; }

std::uint16_t position_take() { return hardware().position; }
void motor_drive(std::int16_t duty) { hardware().duty = duty; }

bool servo_turn(std::uint32_t* next_period_us) {
  if (!hardware().is_servo_turn) {
    return false;
  }
  hardware().is_servo_turn = false;
  *next_period_us = hardware().period_us + mtr::kServoPeriodUs;
  return true;
}

void servo_write(std::uint8_t servo, std::uint16_t width_us) { hardware().servo_us.at(servo) = width_us; }
void leds_write(std::uint8_t bits) { hardware().leds = bits; }
bool stop_input_open() { return hardware().is_stop_open; }
void buzzer_write(bool is_on) { hardware().buzzer = is_on; }
void beacon_write(bool is_on) { hardware().beacon = is_on; }

std::uint8_t eeprom_read(std::uint8_t address) { return hardware().eeprom.at(address); }
bool eeprom_ready() { return true; }
void eeprom_write(std::uint8_t address, std::uint8_t value) { hardware().eeprom.at(address) = value; }

std::uint8_t reset_cause() { return hardware().reset_cause; }
std::uint16_t free_ram() { return 1000; }

}  // namespace hal
