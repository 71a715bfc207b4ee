/// @file
/// Pins of both boards. Servos are on OC1A and OC1B, the motor's PWM on OC2B, the position sensor on ADC0.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <avr/io.h>
#include <stdint.h>

#if defined(__AVR_ATmega2560__)

constexpr uint8_t kServoPins = _BV(PB5) | _BV(PB6);  // 11, 12
#define SERVO_DDR DDRB
constexpr uint8_t kMotorPwm = PH6;  // 9
#define MOTOR_PWM_PORT PORTH
#define MOTOR_PWM_DDR DDRH
constexpr uint8_t kMotorUp = PG5;  // 4
#define MOTOR_UP_PORT PORTG
#define MOTOR_UP_DDR DDRG
// Green, yellow, red on 22, 23, 24
constexpr uint8_t kFirstLed = PA0;
#define LED_PORT PORTA
#define LED_DDR DDRA
constexpr uint8_t kStopInput = PA3;  // 25
constexpr uint8_t kBuzzer = PA4;     // 26
constexpr uint8_t kBeacon = PA5;     // 27
#define SIGNAL_PORT PORTA
#define SIGNAL_DDR DDRA
#define SIGNAL_PIN PINA

#elif defined(__AVR_ATmega328P__)

constexpr uint8_t kServoPins = _BV(PB1) | _BV(PB2);  // 9, 10
#define SERVO_DDR DDRB
constexpr uint8_t kMotorPwm = PD3;                   // 3
#define MOTOR_PWM_PORT PORTD
#define MOTOR_PWM_DDR DDRD
constexpr uint8_t kMotorUp = PD4;                    // 4
#define MOTOR_UP_PORT PORTD
#define MOTOR_UP_DDR DDRD
// Green, yellow, red on 5, 6, 7
constexpr uint8_t kFirstLed = PD5;
#define LED_PORT PORTD
#define LED_DDR DDRD
constexpr uint8_t kStopInput = PC1;  // A1
constexpr uint8_t kBuzzer = PC2;     // A2
constexpr uint8_t kBeacon = PC3;     // A3
#define SIGNAL_PORT PORTC
#define SIGNAL_DDR DDRC
#define SIGNAL_PIN PINC

#else
#error "There is no pin table for this microcontroller."
#endif

constexpr uint8_t kLedMask = 7 << kFirstLed;
