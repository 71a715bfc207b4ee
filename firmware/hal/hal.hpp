/// @file
/// What the logic wants of a board: hal/avr has it for the microcontrollers, hal_host for tests on the PC.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

namespace hal {

/// Clock in us; wraps.
uint32_t clock_us();

/// Ticks of 1 ms that have passed since the last call.
uint8_t take_ticks();

// Serial line
/// The next received byte; false when there is none.
bool uart_take(uint8_t* byte);
/// Bytes that can be sent without waiting.
uint8_t uart_room();
/// Sends a byte; only when there is room.
void uart_put(uint8_t byte);
/// Bytes lost in the UART, and because the buffer was full.
uint16_t uart_overruns();
uint16_t uart_dropped();

// Lift
/// Reading of the position sensor, 0 to 1023, begun at the last call; begins the next one.
uint16_t position_take();
/// Drives the motor, -255 down to 255 up; 0 switches it off.
void motor_drive(int16_t duty);

// Servos
/// True once per servo period, when pulse widths for the next period can be set; then also when that period starts.
bool servo_turn(uint32_t* next_period_us);
/// Pulse width from the next period on.
void servo_write(uint8_t servo, uint16_t width_us);

/// Lights LEDs: bit 0 green, 1 yellow, 2 red.
void leds_write(uint8_t bits);

/// True while the contact at the stop input is open; also when nothing is connected.
bool stop_input_open();
/// Switches the outputs of buzzer and beacon.
void buzzer_write(bool is_on);
void beacon_write(bool is_on);

// Memory that outlives power
uint8_t eeprom_read(uint8_t address);
/// False while an earlier byte is still being written.
bool eeprom_ready();
/// Begins to write a byte; only when ready.
void eeprom_write(uint8_t address, uint8_t value);

/// Bits of MCUSR at the start: 1 power on, 2 external, 4 brown-out, 8 watchdog.
uint8_t reset_cause();
/// Bytes between heap and stack, at their nearest so far.
uint16_t free_ram();

}  // namespace hal
