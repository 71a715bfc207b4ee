/// @file
/// Level of the pin, each ms and so again after a reset.
// SPDX-License-Identifier: Apache-2.0
#include "stop_contact.hpp"

#include <simavr/avr_ioport.h>

#include <map>
#include <stdexcept>

namespace emulator {
namespace {

constexpr std::uint32_t kStepUs = 1000;

}  // namespace

StopContact::StopContact(Mcu* mcu)
    : mcu_(mcu),
      pin_(avr_io_getirq(mcu->core(), static_cast<std::uint32_t>(AVR_IOCTL_IOPORT_GETIRQ(mcu->wiring().stop_port)),
                         mcu->wiring().stop_bit)) {
  mcu->every(kStepUs, [this] { step(); });
  step();
}

void StopContact::set(const std::string& state) {
  const std::map<std::string, State> states = {
      {"open", State::kOpen}, {"closed", State::kClosed}, {"bouncing", State::kBouncing}};
  const auto found = states.find(state);
  if (found == states.end()) {
    throw std::invalid_argument("There is no state " + state + " of the stop contact.");
  }
  state_ = found->second;
  step();
}

void StopContact::step() {
  is_bounced_ = !is_bounced_;
  const bool is_open = state_ == State::kOpen || (state_ == State::kBouncing && is_bounced_);
  // Only an external level outlasts the firmware's writes to other pins of the port.
  avr_ioport_external_t level{};
  level.mask = 1U << mcu_->wiring().stop_bit;
  level.value = is_open ? level.mask : 0U;
  avr_ioctl(mcu_->core(), static_cast<std::uint32_t>(AVR_IOCTL_IOPORT_SET_EXTERNAL(mcu_->wiring().stop_port)), &level);
  // A reset clears the pin, and simavr ignores a level that has not changed.
  avr_raise_irq(pin_, is_open ? 0 : 1);
  avr_raise_irq(pin_, is_open ? 1 : 0);
}

}  // namespace emulator
