/// @file
/// Measures the pulses of a servo output in simulated time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mcu.hpp"

namespace emulator {

/// Watches output OC1A or OC1B of timer 1. Not the pin: simavr lets any write to a port override the timer's level.
class PulseProbe {
 public:
  /// output: 'A' or 'B'.
  PulseProbe(Mcu* mcu, char output);

  /// Width of the newest complete pulse; 0 when the last one is older than two periods.
  double width_us() const;

 private:
  static void edge(avr_irq_t* irq, std::uint32_t level, void* self);

  Mcu* mcu_;
  avr_cycle_count_t rise_ = 0, fall_ = 0;
  avr_cycle_count_t width_ = 0;
  bool is_high_ = false;
};

}  // namespace emulator
