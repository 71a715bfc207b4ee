/// @file
/// Wires from the registers to the lift and back, and the faults.
// SPDX-License-Identifier: Apache-2.0
#include "emulator.hpp"

#include <simavr/avr_adc.h>

#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

namespace emulator {
namespace {

constexpr std::uint32_t kLiftStepUs = 1000;
constexpr double kPwmSteps = 256.0;

}  // namespace

Emulator::Emulator(const std::string& elf, const std::string& mcu, const LiftParameters& lift, std::uint32_t seed)
    : mcu_(elf, wiring_of(mcu)),
      line_(&mcu_, seed),
      lift_(lift, seed),
      stop_contact_(&mcu_),
      lock_servo_(&mcu_, 'A'),
      unlock_servo_(&mcu_, 'B'),
      sensor_(avr_io_getirq(mcu_.core(), AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0)) {
  mcu_.every(kLiftStepUs, [this] { step_lift(); });
  step_lift();
}

double Emulator::duty() const {
  const Wiring& wiring = mcu_.wiring();
  double share = mcu_.pin(wiring.motor_pwm) ? 1.0 : 0.0;
  if (mcu_.data(kTccr2a) & kCom2b1 && mcu_.data(kTccr2b) & kClockSelect) {
    share = (mcu_.data(kOcr2b) + 1) / kPwmSteps;
  }
  return mcu_.pin(wiring.motor_up) ? share : -share;
}

void Emulator::step_lift() {
  lift_.step(duty(), kLiftStepUs * 1e-6);
  avr_raise_irq(sensor_, static_cast<std::uint32_t>(std::lround(lift_.sensor_mv())));
}

Probe Emulator::probe() const {
  Probe seen{};
  seen.time_us = mcu_.time_us();
  seen.servo_us[0] = lock_servo_.width_us();
  seen.servo_us[1] = unlock_servo_.width_us();
  for (int led = 0; led < 3; ++led) {
    seen.leds[led] = mcu_.pin(mcu_.wiring().leds[led]);
  }
  seen.buzzer = mcu_.pin(mcu_.wiring().buzzer);
  seen.beacon = mcu_.pin(mcu_.wiring().beacon);
  seen.lift_m = lift_.height_m();
  seen.lift_duty = duty();
  seen.untouched_ram = mcu_.untouched_ram();
  seen.resets = mcu_.resets();
  seen.overruns = line_.overruns();
  return seen;
}

void Emulator::fault(const std::string& name, std::uint32_t one_in) {
  const std::map<std::string, std::function<void()>> faults = {
      {"cut", [&] { line_.cut(true); }},
      {"restore", [&] { line_.cut(false); }},
      {"drop", [&] { line_.drop_one_in(one_in); }},
      {"corrupt", [&] { line_.corrupt_one_in(one_in); }},
      {"reset", [&] { mcu_.reset(); }},
      {"hang", [&] { mcu_.hang(); }},
      {"wire_break", [&] { lift_.break_wire(true); }},
      {"jam", [&] { lift_.jam(true); }},
      {"none",
       [&] {
         line_.cut(false);
         line_.drop_one_in(0);
         line_.corrupt_one_in(0);
         lift_.break_wire(false);
         lift_.jam(false);
       }},
  };
  const auto found = faults.find(name);
  if (found == faults.end()) {
    throw std::invalid_argument("There is no fault " + name + ".");
  }
  found->second();
}

}  // namespace emulator
