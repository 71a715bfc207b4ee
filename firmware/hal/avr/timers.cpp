/// @file
/// Timer 1: servo pulses and clock, 0.5 us and 20 ms; timer 0: ticks of 1 ms.
// SPDX-License-Identifier: Apache-2.0
#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "../../logic/config.hpp"
#include "../hal.hpp"
#include "board_avr.hpp"
#include "pins.hpp"

namespace hal {
namespace {

constexpr uint16_t kTicksPerUs = 2;
constexpr uint16_t kPeriodTicks = mtr::kServoPeriodUs * kTicksPerUs;
// Widths are set while no pulse is high and none is about to begin. A real timer takes them over when the next period
// begins, simavr at once: in this window both come to the same.
constexpr uint16_t kWindowBeginTicks = 3000 * kTicksPerUs;
constexpr uint16_t kWindowEndTicks = 19000 * kTicksPerUs;

volatile uint32_t period_start_us = mtr::kClockStartUs;
volatile uint8_t ticks;
uint32_t served_period_us = mtr::kClockStartUs - mtr::kServoPeriodUs;

struct Instant {
  uint32_t period_us;
  uint16_t ticks;
};

Instant now() {
  Instant instant{};
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    instant.period_us = period_start_us;
    instant.ticks = TCNT1;
    // The overflow may have come after interrupts went off, before or after the count was read.
    if (TIFR1 & _BV(TOV1)) {
      instant.ticks = TCNT1;
      instant.period_us += mtr::kServoPeriodUs;
    }
  }
  return instant;
}

}  // namespace

void start_timers() {
  SERVO_DDR |= kServoPins;
  ICR1 = kPeriodTicks - 1;
  TCCR1A = _BV(COM1A1) | _BV(COM1B1) | _BV(WGM11);
  TCCR1B = _BV(WGM13) | _BV(WGM12) | _BV(CS11);
  TIMSK1 = _BV(TOIE1);
  OCR0A = F_CPU / 64 / 1000 - 1;
  TCCR0A = _BV(WGM01);
  TCCR0B = _BV(CS01) | _BV(CS00);
  TIMSK0 = _BV(OCIE0A);
}

uint32_t clock_us() {
  const Instant instant = now();
  return instant.period_us + instant.ticks / kTicksPerUs;
}

uint8_t take_ticks() {
  uint8_t taken = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    taken = ticks;
    ticks = 0;
  }
  return taken;
}

bool has_tick() { return ticks > 0; }

bool servo_turn(uint32_t* next_period_us) {
  const Instant instant = now();
  if (instant.period_us == served_period_us || instant.ticks < kWindowBeginTicks || instant.ticks > kWindowEndTicks) {
    return false;
  }
  served_period_us = instant.period_us;
  *next_period_us = instant.period_us + mtr::kServoPeriodUs;
  return true;
}

void servo_write(uint8_t servo, uint16_t width_us) {
  const uint16_t compare = static_cast<uint16_t>(width_us * kTicksPerUs - 1);
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    if (servo == 0) {
      OCR1A = compare;
    } else {
      OCR1B = compare;
    }
  }
}

}  // namespace hal

ISR(TIMER1_OVF_vect) { hal::period_start_us = hal::period_start_us + mtr::kServoPeriodUs; }

ISR(TIMER0_COMPA_vect) { hal::ticks = static_cast<uint8_t>(hal::ticks + 1); }
