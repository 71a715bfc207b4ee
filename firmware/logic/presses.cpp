/// @file
/// Phases of a press, advanced once per servo period.
// SPDX-License-Identifier: Apache-2.0
#include "presses.hpp"

#include <stddef.h>
#include <string.h>

#include "crc16.hpp"
#include "progmem.hpp"

namespace mtr {
namespace {

/// Pulse widths of a servo: released, and at full travel.
struct Travel {
  uint16_t released_us;
  uint16_t pressed_us;
};

/// Lock, unlock; a further servo is a further line, a bit in FirmwarePress and a channel in the hal.
const Travel kTravels[kServoCount] PROGMEM = {{1000, 2000}, {1000, 2000}};

constexpr uint8_t kAllServos = (1 << kServoCount) - 1;

uint16_t released_us(uint8_t servo) { return pgm_read_word(&kTravels[servo].released_us); }

/// NaN fails each comparison.
Refusal objection(const Press& press) {
  if (press.servos == 0 || (press.servos & ~kAllServos) != 0) {
    return Refusal::kServos;
  }
  if (!(press.strength >= 0.0f && press.strength <= 1.0f)) {
    return Refusal::kStrength;
  }
  return press.hold_ms < kShortestHoldMs || press.hold_ms > kLongestHoldMs ? Refusal::kHold : Refusal::kNone;
}

}  // namespace

void Presses::start() {
  set_widths(0);
  if (memory_->crc != memory_crc() || memory_->next >= kRememberedPresses) {
    memset(memory_, 0, sizeof *memory_);
  }
  report_.id = memory_->ids[(memory_->next + kRememberedPresses - 1) % kRememberedPresses];
  if (report_.id != 0) {
    const bool refused = memory_->state == static_cast<uint16_t>(PressState::kRefused);
    report_.state = refused ? PressState::kRefused : PressState::kCutShort;
  }
  note(report_.state);
}

Refusal Presses::order(const Press& press, Refusal impediment) {
  if (press.id == 0) {
    return Refusal::kPressId;
  }
  if (knows(press.id)) {
    return Refusal::kNone;
  }
  if (phase_ != Phase::kIdle) {
    return Refusal::kBusy;
  }
  const Refusal refusal = impediment != Refusal::kNone ? impediment : objection(press);
  remember(press.id);
  report_ = PressReport();
  report_.id = press.id;
  if (refusal != Refusal::kNone) {
    note(PressState::kRefused);
    return refusal;
  }
  press_ = press;
  ramp_periods_ = 0;
  phase_ = Phase::kReturning;
  note(PressState::kPressing);
  return Refusal::kNone;
}

void Presses::step(uint32_t period_us) {
  if (phase_ == Phase::kReturning && period_us - released_us_ >= kReturnUs) {
    phase_ = Phase::kRamp;
  }
  switch (phase_) {
    case Phase::kRamp:
      ramp(period_us);
      break;
    case Phase::kHold:
      if (period_us - report_.start_us >= press_.hold_ms * 1000UL) {
        release(period_us, PressState::kDone);
      }
      break;
    case Phase::kAborted:
      release(period_us, PressState::kCutShort);
      break;
    default:
      break;
  }
}

void Presses::abort() {
  if (phase_ != Phase::kIdle) {
    phase_ = Phase::kAborted;
    set_widths(0);
  }
}

bool Presses::knows(uint32_t id) const {
  for (uint32_t known : memory_->ids) {
    if (known == id) {
      return true;
    }
  }
  return false;
}

void Presses::remember(uint32_t id) {
  memory_->ids[memory_->next] = id;
  memory_->next = static_cast<uint16_t>((memory_->next + 1) % kRememberedPresses);
}

void Presses::note(PressState state) {
  report_.state = state;
  memory_->state = static_cast<uint16_t>(state);
  memory_->crc = memory_crc();
}

uint16_t Presses::memory_crc() const {
  return crc16(reinterpret_cast<const uint8_t*>(memory_), offsetof(PressMemory, crc));
}

void Presses::ramp(uint32_t period_us) {
  set_widths(++ramp_periods_);
  if (ramp_periods_ < kRampPeriods) {
    return;
  }
  // The servo knows a pulse when it ends.
  uint16_t longest_us = 0;
  for (uint16_t width : width_us_) {
    longest_us = width > longest_us ? width : longest_us;
  }
  report_.start_us = period_us + longest_us;
  phase_ = Phase::kHold;
}

void Presses::release(uint32_t period_us, PressState how) {
  set_widths(0);
  released_us_ = period_us;
  report_.end_us = period_us + released_us(0);
  phase_ = Phase::kIdle;
  note(how);
}

void Presses::set_widths(uint8_t ramp_periods) {
  for (uint8_t servo = 0; servo < kServoCount; ++servo) {
    const int16_t travel_us = static_cast<int16_t>(pgm_read_word(&kTravels[servo].pressed_us) - released_us(servo));
    const bool is_pressed = (press_.servos & 1 << servo) != 0;
    const float share = is_pressed ? press_.strength * ramp_periods / kRampPeriods : 0.0f;
    width_us_[servo] = static_cast<uint16_t>(released_us(servo) + static_cast<int16_t>(travel_us * share));
  }
}

}  // namespace mtr
