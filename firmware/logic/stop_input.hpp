/// @file
/// Stop input: a normally closed contact of a stop chain between the pin and ground.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "config.hpp"

namespace mtr {

/// Whether the input is in use; lies in memory that a watchdog or external reset leaves alone.
struct StopMemory {
  uint16_t mark;
};

/// An open contact, a broken wire and an unplugged connector read the same and stop at the first reading. A stop ends
/// only after kStopCloseMs of readings that are all closed, so a bouncing contact remains a stop.
///
/// Without a stop chain the pin reads open; then the input is not in use and stops nothing. A board that was reset
/// knows of its use before the host has repeated it.
class StopInput {
 public:
  explicit StopInput(StopMemory* memory) : memory_(memory) {}

  /// Puts the input into use until the power is switched off.
  void use() { memory_->mark = kUsed; }

  /// Takes a reading, one per ms; true when an input in use has just opened.
  bool step(bool is_open);

  bool is_used() const { return memory_->mark == kUsed; }
  bool is_open() const { return is_used() && is_open_; }
  /// Times that the input opened while in use; wraps.
  uint16_t openings() const { return openings_; }

 private:
  static constexpr uint16_t kUsed = 0x5AC3;

  StopMemory* memory_;
  uint16_t openings_ = 0;
  uint8_t closed_ms_ = 0;
  bool is_open_ = true;
};

}  // namespace mtr
