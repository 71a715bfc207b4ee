/// @file
/// Trapezoid in whole numbers.
// SPDX-License-Identifier: Apache-2.0
#include "motion_profile.hpp"

#include "../config.hpp"

namespace mtr {
namespace {

/// Way from a speed to standstill when each step takes kAccelerationUmPerStep2 off.
int32_t braking_um(int32_t speed_um) {
  const int32_t steps = speed_um / kAccelerationUmPerStep2;
  return steps * speed_um - kAccelerationUmPerStep2 * steps * (steps + 1) / 2;
}

/// True when a step at this speed leaves enough of the way to brake.
bool stops_within(int32_t left_um, int32_t speed_um) {
  return speed_um <= 0 || speed_um + braking_um(speed_um) <= left_um;
}

int32_t sign(int32_t value) { return value < 0 ? -1 : 1; }

}  // namespace

void MotionProfile::start_at(int32_t position_um) {
  position_um_ = position_um;
  speed_um_ = 0;
}

void MotionProfile::step(int32_t target_um) {
  const int32_t way = target_um - position_um_;
  const int32_t towards = sign(way);
  const int32_t left = way * towards, speed = speed_um_ * towards;
  if (left <= kAccelerationUmPerStep2 && speed >= -kAccelerationUmPerStep2 && speed <= kAccelerationUmPerStep2) {
    start_at(target_um);
    return;
  }
  int32_t next = speed + kAccelerationUmPerStep2;
  if (next > kTopSpeedUmPerStep) {
    next = kTopSpeedUmPerStep;
  }
  if (!stops_within(left, next)) {
    next = stops_within(left, speed) ? speed : speed - kAccelerationUmPerStep2;
  }
  speed_um_ = next * towards;
  position_um_ += speed_um_;
}

int32_t MotionProfile::stopping_point_um() const {
  const int32_t direction = sign(speed_um_);
  return position_um_ + direction * braking_um(speed_um_ * direction);
}

}  // namespace mtr
