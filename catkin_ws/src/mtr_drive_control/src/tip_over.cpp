/// @file
/// Static tip-over limit.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/tip_over.hpp"

#include <algorithm>

namespace mtr_drive_control {
namespace {

constexpr double kGravityMps2 = 9.81;

}  // namespace

Parameters limits_at(const Parameters& parameters, double key_height_m) {
  // Also takes the raised mast for an unknown height, which is NaN.
  const double height_m =
      key_height_m >= 0.0 ? std::min(key_height_m, parameters.key_raised_m) : parameters.key_raised_m;
  const double centre_m = parameters.centre_of_mass_m + parameters.centre_of_mass_rise * height_m;
  const double per_lever = parameters.tip_margin * kGravityMps2 / centre_m;
  const double along_mps2 = per_lever * parameters.tip_lever_along_m;
  const double across_mps2 = per_lever * parameters.tip_lever_across_m;
  Parameters limits = parameters;
  for (double Parameters::*each : {&Parameters::linear_acceleration_mps2, &Parameters::linear_deceleration_mps2,
                                   &Parameters::emergency_linear_deceleration_mps2}) {
    limits.*each = std::min(parameters.*each, along_mps2);
  }
  limits.lateral_acceleration_mps2 = std::min(parameters.lateral_acceleration_mps2, across_mps2);
  limits.max_linear_mps =
      std::min(parameters.max_linear_mps, limits.emergency_linear_deceleration_mps2 * kStandstillWithinS);
  return limits;
}

}  // namespace mtr_drive_control
