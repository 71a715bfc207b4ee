/// @file
/// Parameters of the adjustment of key frames: how far each measurement is trusted and what a map must show, SI units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"
#include "mtr_core/sensor_figures.hpp"

namespace mtr_surfel_map {

/// Sigmas are 1 standard deviation; the sensors' are in mtr_core/sensor_figures.py, with sources.
struct AdjustmentParameters {
  /// Random error of one range.
  double range_noise_m = mtr_core::sensor_figures::kAssumedRangeNoiseM.value;
  /// Constant error of all ranges before it is estimated.
  double range_bias_sigma_m = mtr_core::sensor_figures::kAssumedRangeBiasM.value;
  /// Error of a beam's direction, mounting and motion within the sweep included.
  double bearing_sigma_rad = mtr_core::sensor_figures::kAssumedViewDirectionRad.value;
  /// How far one view of a surface element is off by its shape: curvature, edges, tilt of the LiDAR's plane.
  double surface_sigma_m = 0.004;
  /// Common error of the wheels' distances in the key frames' motions.
  double wheel_scale_sigma = mtr_core::sensor_figures::kAssumedWheelScale.value;
  /// The same of the gyro's turns.
  double gyro_scale_sigma = mtr_core::sensor_figures::kAssumedGyroScale.value;
  /// The path must come back to where it has been before, within this distance.
  double closing_distance_m = 1.5;
};

using AdjustmentRow = mtr_core::ParameterRow<AdjustmentParameters>;

/// Range and unit of each parameter.
inline constexpr std::array<AdjustmentRow, 7> kAdjustmentRows{{
    mtr_core::row_of("range_noise_m", &AdjustmentParameters::range_noise_m,
                     mtr_core::sensor_figures::kAssumedRangeNoiseM),
    mtr_core::row_of("range_bias_sigma_m", &AdjustmentParameters::range_bias_sigma_m,
                     mtr_core::sensor_figures::kAssumedRangeBiasM),
    mtr_core::row_of("bearing_sigma_rad", &AdjustmentParameters::bearing_sigma_rad,
                     mtr_core::sensor_figures::kAssumedViewDirectionRad),
    {"surface_sigma_m", &AdjustmentParameters::surface_sigma_m, 0.0005, 0.05, "m"},
    mtr_core::row_of("wheel_scale_sigma", &AdjustmentParameters::wheel_scale_sigma,
                     mtr_core::sensor_figures::kAssumedWheelScale),
    mtr_core::row_of("gyro_scale_sigma", &AdjustmentParameters::gyro_scale_sigma,
                     mtr_core::sensor_figures::kAssumedGyroScale),
    {"closing_distance_m", &AdjustmentParameters::closing_distance_m, 0.2, 5.0, "m"},
}};

/// Throws ConfigurationError unless each value is in its range.
void check(const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
