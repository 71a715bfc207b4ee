/// @file
/// Microcontroller, line and lift together.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "lift_plant.hpp"
#include "mcu.hpp"
#include "pulse_probe.hpp"
#include "stop_contact.hpp"
#include "uart_line.hpp"

namespace emulator {

/// What can be seen of a board from outside.
struct Probe {
  std::uint64_t time_us;
  double servo_us[2];
  bool leds[3];
  bool buzzer;
  bool beacon;
  double lift_m;
  double lift_duty;
  int untouched_ram;
  int resets;
  std::uint64_t overruns;
};

class Emulator {
 public:
  Emulator(const std::string& elf, const std::string& mcu, const LiftParameters& lift, std::uint32_t seed);

  Mcu& mcu() { return mcu_; }
  const Mcu& mcu() const { return mcu_; }
  UartLine& line() { return line_; }

  Probe probe() const;

  /// State of the stop chain's contact. Throws std::invalid_argument.
  void set_stop_contact(const std::string& state) { stop_contact_.set(state); }

  /// Begins or ends a fault; one_in: bytes for drop and corrupt. Throws std::invalid_argument.
  void fault(const std::string& name, std::uint32_t one_in);

 private:
  double duty() const;
  void step_lift();

  Mcu mcu_;
  UartLine line_;
  LiftPlant lift_;
  StopContact stop_contact_;
  PulseProbe lock_servo_, unlock_servo_;
  avr_irq_t* sensor_;
};

}  // namespace emulator
