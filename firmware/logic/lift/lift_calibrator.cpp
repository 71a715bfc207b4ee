/// @file
/// Down, up, plausible or not.
// SPDX-License-Identifier: Apache-2.0
#include "lift_calibrator.hpp"

namespace mtr {

void LiftCalibrator::start(uint16_t stroke_mm) {
  found_.stroke_mm = stroke_mm;
  enter(Phase::kDown);
}

void LiftCalibrator::abort() {
  if (is_running()) {
    enter(Phase::kFailed);
  }
}

int16_t LiftCalibrator::step(uint16_t counts) {
  if (!is_running()) {
    return 0;
  }
  if (++steps_ > kCalibrationSteps) {
    enter(Phase::kFailed);
    return 0;
  }
  const int16_t drive = phase_ == Phase::kDown ? -kCalibrationDuty : kCalibrationDuty;
  if (!stall_.step(drive, counts)) {
    return drive;
  }
  if (phase_ == Phase::kDown) {
    found_.low = counts;
    enter(Phase::kUp);
  } else {
    found_.high = counts;
    enter(found_.is_plausible() ? Phase::kDone : Phase::kFailed);
  }
  return 0;
}

bool LiftCalibrator::take(Calibration* found) {
  if (phase_ != Phase::kDone) {
    return false;
  }
  *found = found_;
  phase_ = Phase::kIdle;
  return true;
}

void LiftCalibrator::enter(Phase phase) {
  phase_ = phase;
  steps_ = 0;
  stall_.reset();
}

}  // namespace mtr
