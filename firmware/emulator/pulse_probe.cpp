/// @file
/// Edges of a timer's compare output.
// SPDX-License-Identifier: Apache-2.0
#include "pulse_probe.hpp"

#include <simavr/avr_timer.h>

namespace emulator {
namespace {

constexpr double kCyclesPerUs = 16.0;
constexpr avr_cycle_count_t kSilenceCycles = 40000 * 16;

}  // namespace

PulseProbe::PulseProbe(Mcu* mcu, char output) : mcu_(mcu) {
  avr_irq_t* irq = avr_io_getirq(mcu->core(), AVR_IOCTL_TIMER_GETIRQ('1'), TIMER_IRQ_OUT_COMP + output - 'A');
  avr_irq_register_notify(irq, edge, this);
}

double PulseProbe::width_us() const {
  const bool is_silent = mcu_->core()->cycle - fall_ > kSilenceCycles;
  return is_silent ? 0.0 : static_cast<double>(width_) / kCyclesPerUs;
}

void PulseProbe::edge(avr_irq_t*, std::uint32_t level, void* self) {
  PulseProbe* probe = static_cast<PulseProbe*>(self);
  const bool is_high = (level & 1) != 0;
  if (is_high == probe->is_high_) {
    return;
  }
  probe->is_high_ = is_high;
  const avr_cycle_count_t now = probe->mcu_->core()->cycle;
  if (is_high) {
    probe->rise_ = now;
  } else {
    probe->fall_ = now;
    probe->width_ = now - probe->rise_;
  }
}

}  // namespace emulator
