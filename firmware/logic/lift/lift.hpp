/// @file
/// Closed loop of the lift: to a height, within its stops, off when it jams.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "../config.hpp"
#include "motion_profile.hpp"
#include "stall_detector.hpp"

namespace mtr {

/// The host repeats its order; only another height is a new one. After a jam the motor rests and tries again once.
/// Then it stays off for any height: only hold(), a decision of the host, permits another attempt.
class Lift {
 public:
  Lift() : stall_(kStallUm) {}

  /// Goes to a height, which must lie within the stroke.
  void go_to(int32_t target_um);
  /// Brakes and stands still; a jam is over, and the next height gets all tries.
  void hold();
  /// Motor off at once, until the next order. Tries remain counted.
  void cut();

  /// One step of kLiftPeriodMs at a measured height; returns the motor's duty, positive up.
  int16_t step(int32_t measured_um, int32_t stroke_um);

  bool is_jammed() const { return tries_ > 0; }
  /// True when no try is left.
  bool has_given_up() const { return tries_ >= kJamTries; }
  bool is_moving() const { return mode_ != Mode::kOff && !arrived_ && rest_steps_ == 0 && !has_given_up(); }

 private:
  enum class Mode : uint8_t { kOff, kGoTo, kHold };

  void begin();
  int16_t duty(int32_t measured_um);
  void jam();

  MotionProfile profile_;
  StallDetector stall_;
  Mode mode_ = Mode::kOff;
  int32_t target_um_ = 0;
  int16_t creep_ = 0;
  uint8_t rest_steps_ = 0;
  uint8_t tries_ = 0;
  bool arrived_ = false;
  bool at_rest_ = true;
};

}  // namespace mtr
