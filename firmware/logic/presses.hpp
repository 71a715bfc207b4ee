/// @file
/// Presses of the Remote key's buttons by servos.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "config.hpp"
#include "counters.hpp"
#include "link/messages.hpp"

namespace mtr {

/// Ids that were taken, and what became of the newest; lies in memory that a watchdog or external reset leaves alone.
struct PressMemory {
  uint32_t ids[kRememberedPresses];
  uint16_t next;
  uint16_t state;
  uint16_t crc;
};

/// One press at a time: ramp to the travel, hold, release. Released by itself, whatever the host does.
class Presses {
 public:
  explicit Presses(PressMemory* memory) : memory_(memory) {}

  /// Takes over what a reset left. Its clock is gone and with it the times of the newest press, which counts as cut
  /// short.
  void start();

  /// Takes an order; a known id is not taken again, and one with an impediment is refused for it. Returns why it was
  /// refused, or kNone.
  Refusal order(const Press& press, Refusal impediment);

  /// Widths for the servo period that starts then.
  void step(uint32_t period_us);

  /// Releases at the next period.
  void abort();

  uint16_t width_us(uint8_t servo) const { return width_us_[servo]; }
  const PressReport& report() const { return report_; }

 private:
  enum class Phase : uint8_t { kIdle, kReturning, kRamp, kHold, kAborted };

  bool knows(uint32_t id) const;
  void remember(uint32_t id);
  void note(PressState state);
  uint16_t memory_crc() const;
  void ramp(uint32_t period_us);
  void release(uint32_t period_us, PressState how);
  void set_widths(uint8_t ramp_periods);

  PressMemory* memory_;
  Press press_ = {};
  PressReport report_;
  uint16_t width_us_[kServoCount] = {};
  uint32_t released_us_ = 0;
  uint8_t ramp_periods_ = 0;
  Phase phase_ = Phase::kIdle;
};

}  // namespace mtr
