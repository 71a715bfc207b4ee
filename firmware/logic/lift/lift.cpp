/// @file
/// Speed of the profile as feed-forward, position error in proportion, and a creeping rise against friction at the end.
// SPDX-License-Identifier: Apache-2.0
#include "lift.hpp"

#include "../config.hpp"

namespace mtr {
namespace {

int32_t magnitude(int32_t value) { return value < 0 ? -value : value; }

int32_t clamp(int32_t value, int32_t low, int32_t high) { return value < low ? low : value > high ? high : value; }

}  // namespace

void Lift::go_to(int32_t target_um) {
  if (mode_ == Mode::kGoTo && target_um == target_um_) {
    return;
  }
  if (mode_ == Mode::kOff || arrived_) {
    begin();
  }
  mode_ = Mode::kGoTo;
  target_um_ = target_um;
  arrived_ = false;
}

void Lift::hold() {
  if (is_jammed()) {
    tries_ = rest_steps_ = 0;
    cut();
  }
  if (mode_ == Mode::kOff || mode_ == Mode::kHold) {
    return;
  }
  mode_ = Mode::kHold;
  target_um_ = profile_.stopping_point_um();
  if (at_rest_ || arrived_) {
    cut();
  }
}

void Lift::cut() {
  mode_ = Mode::kOff;
  begin();
}

void Lift::begin() {
  // The profile begins at the next measured height.
  at_rest_ = true;
  arrived_ = false;
}

int16_t Lift::step(int32_t measured_um, int32_t stroke_um) {
  if (mode_ == Mode::kOff || has_given_up()) {
    return 0;
  }
  if (rest_steps_ > 0) {
    --rest_steps_;
    return 0;
  }
  if (at_rest_) {
    profile_.start_at(measured_um);
    stall_.reset();
    creep_ = 0;
    at_rest_ = false;
  }
  const int32_t target_um = clamp(target_um_, 0, stroke_um);
  profile_.step(target_um);
  const int32_t way_um = magnitude(target_um - measured_um);
  if (profile_.position_um() == target_um && way_um <= (arrived_ ? kDepartedUm : kArrivedUm)) {
    arrived_ = true;
    tries_ = 0;
    creep_ = 0;
    stall_.reset();
    return 0;
  }
  arrived_ = false;
  const int16_t drive = duty(measured_um);
  if (stall_.step(drive, measured_um)) {
    jam();
    return 0;
  }
  if (stall_.has_progressed()) {
    tries_ = 0;
  }
  return drive;
}

int16_t Lift::duty(int32_t measured_um) {
  const int32_t error_um = profile_.position_um() - measured_um;
  const bool is_final = profile_.speed_um() == 0;
  const int32_t wanted_um =
      clamp(profile_.speed_um() + error_um / kGainStepsPerCorrection, -kTopSpeedUmPerStep, kTopSpeedUmPerStep);
  creep_ = is_final ? static_cast<int16_t>(creep_ + (error_um > 0 ? 1 : -1)) : 0;
  const int32_t direction = (is_final ? error_um : profile_.speed_um()) > 0 ? 1 : -1;
  const int32_t drive = wanted_um * kFullDuty / kFullDutySpeedUmPerStep + direction * kFrictionDuty + creep_;
  return static_cast<int16_t>(clamp(drive, -kFullDuty, kFullDuty));
}

void Lift::jam() {
  ++tries_;
  rest_steps_ = kJamRestSteps;
  at_rest_ = true;
}

}  // namespace mtr
