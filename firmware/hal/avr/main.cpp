/// @file
/// Main loop: a pass of the board, then sleep until there is work.
// SPDX-License-Identifier: Apache-2.0
#include <avr/interrupt.h>
#include <avr/sleep.h>
#include <avr/wdt.h>

#include "../../logic/board.hpp"
#include "board_avr.hpp"

namespace {

mtr::PressMemory press_memory __attribute__((section(".noinit")));
mtr::StopMemory stop_memory __attribute__((section(".noinit")));
mtr::Board board(&press_memory, &stop_memory);

}  // namespace

void hal::idle() {
  cli();
  // A sent byte also wakes the core; it is no reason for a pass.
  while (!has_byte() && !has_tick()) {
    sleep_enable();
    // The instruction after sei runs before any interrupt, so that none is slept through.
    sei();
    sleep_cpu();
    sleep_disable();
    cli();
  }
  sei();
}

int main() {
  hal::start_lift();
  hal::start_leds();
  hal::start_signals();
  hal::start_uart();
  hal::start_timers();
  set_sleep_mode(SLEEP_MODE_IDLE);
  wdt_enable(WDTO_250MS);
  sei();
  board.start();
  for (;;) {
    wdt_reset();
    board.step();
    hal::idle();
  }
}
