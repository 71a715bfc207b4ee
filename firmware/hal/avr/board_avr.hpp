/// @file
/// What the parts of the AVR hal need of each other.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hal {

void start_timers();
void start_uart();
void start_lift();
void start_leds();
void start_signals();

/// Sleeps until an interrupt, unless there is work.
void idle();

/// True when a received byte or a tick waits; interrupts must be off.
bool has_byte();
bool has_tick();

}  // namespace hal
