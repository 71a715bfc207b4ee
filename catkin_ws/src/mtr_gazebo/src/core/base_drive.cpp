// SPDX-License-Identifier: Apache-2.0
#include "core/base_drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mtr_gazebo {
namespace {

double limited(double value, double limit) { return std::clamp(value, -limit, limit); }

}  // namespace

BaseDrive::BaseDrive(const BaseFigures& figures)
    : figures_(figures), silent_s_(std::numeric_limits<double>::infinity()) {}

void BaseDrive::command(double linear_mps, double angular_radps) {
  if (!std::isfinite(linear_mps) || !std::isfinite(angular_radps)) {
    return;
  }
  wanted_linear_ = limited(linear_mps, figures_.max_linear_mps);
  wanted_angular_ = limited(angular_radps, figures_.max_angular_radps);
  silent_s_ = 0.0;
}

WheelSpeeds BaseDrive::step(double step_s) {
  const bool obeys = silent_s_ < figures_.command_timeout_s;
  silent_s_ += step_s;
  linear_ += limited((obeys ? wanted_linear_ : 0.0) - linear_, figures_.max_linear_mps2 * step_s);
  angular_ += limited((obeys ? wanted_angular_ : 0.0) - angular_, figures_.max_angular_radps2 * step_s);
  const double turn = angular_ * figures_.believed_half_track_m;
  return {(linear_ - turn) / figures_.believed_radius_m, (linear_ + turn) / figures_.believed_radius_m};
}

}  // namespace mtr_gazebo
