/// @file
/// Set point that goes to a target with limited speed and acceleration.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

namespace mtr {

/// Trapezoid of speed in steps of equal time; um and um per step.
class MotionProfile {
 public:
  void start_at(int32_t position_um);
  void step(int32_t target_um);

  /// Where it stands still when it brakes now.
  int32_t stopping_point_um() const;
  int32_t position_um() const { return position_um_; }
  int32_t speed_um() const { return speed_um_; }

 private:
  int32_t position_um_ = 0;
  int32_t speed_um_ = 0;
};

}  // namespace mtr
