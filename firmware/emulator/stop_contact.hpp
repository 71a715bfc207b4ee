/// @file
/// Contact of a stop chain at the firmware's stop input.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mcu.hpp"

namespace emulator {

/// Open at first, as an input to which nothing is connected; then its pull-up decides.
class StopContact {
 public:
  explicit StopContact(Mcu* mcu);

  /// "open", "closed", or "bouncing": open for every other ms. Throws std::invalid_argument.
  void set(const std::string& state);

 private:
  enum class State { kOpen, kClosed, kBouncing };

  void step();

  Mcu* mcu_;
  avr_irq_t* pin_;
  State state_ = State::kOpen;
  bool is_bounced_ = false;
};

}  // namespace emulator
