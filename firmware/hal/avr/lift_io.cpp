/// @file
/// Motor driver with PWM and direction on timer 2, position sensor on the analog-digital converter.
// SPDX-License-Identifier: Apache-2.0
#include <avr/io.h>

#include "../hal.hpp"
#include "board_avr.hpp"
#include "pins.hpp"

namespace hal {

void start_lift() {
  MOTOR_PWM_PORT &= ~_BV(kMotorPwm);
  MOTOR_PWM_DDR |= _BV(kMotorPwm);
  MOTOR_UP_DDR |= _BV(kMotorUp);
  // Reference AVCC, which also feeds the sensor, so that its drift cancels; 125 kHz.
  ADMUX = _BV(REFS0);
  DIDR0 = _BV(ADC0D);
  ADCSRA = _BV(ADEN) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0) | _BV(ADSC);
  while (ADCSRA & _BV(ADSC)) {
  }
}

uint16_t position_take() {
  // A conversion takes 0.1 ms, the calls are 1 ms apart.
  const uint16_t reading = ADC;
  ADCSRA |= _BV(ADSC);
  return reading;
}

void motor_drive(int16_t duty) {
  if (duty == 0) {
    // A compare value of 0 would still give short pulses: the pin leaves the timer.
    TCCR2A = 0;
    TCCR2B = 0;
    MOTOR_PWM_PORT &= ~_BV(kMotorPwm);
    return;
  }
  if (duty > 0) {
    MOTOR_UP_PORT |= _BV(kMotorUp);
  } else {
    MOTOR_UP_PORT &= ~_BV(kMotorUp);
  }
  OCR2B = static_cast<uint8_t>((duty > 0 ? duty : -duty) - 1);
  // 7.8 kHz
  TCCR2A = _BV(COM2B1) | _BV(WGM21) | _BV(WGM20);
  TCCR2B = _BV(CS21);
}

}  // namespace hal
