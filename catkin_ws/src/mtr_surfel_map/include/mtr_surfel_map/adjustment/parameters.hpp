/// @file
/// Parameters of the adjustment of key frames in SI units: measurement uncertainties and the loop-closure distance.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"
#include "mtr_core/sensor_figures.hpp"

namespace mtr_surfel_map {

/// Standard deviations (1 sigma). The figures of the sensors, with their sources, are in mtr_core/sensor_figures.py.
struct AdjustmentParameters {
  /// Random error of one range.
  double range_noise_m = mtr_core::sensor_figures::kAssumedRangeNoiseM.value;
  /// Prior of the constant range error, 1 sigma.
  double range_bias_sigma_m = mtr_core::sensor_figures::kAssumedRangeBiasM.value;
  /// Direction error of a beam, including mounting and motion distortion within the sweep.
  double bearing_sigma_rad = mtr_core::sensor_figures::kAssumedViewDirectionRad.value;
  /// Error of one view caused by the shape of the surface: curvature, edges and tilt of the scan plane.
  double surface_sigma_m = 0.004;
  /// Prior of the scale error of the wheel distances in the motions of the key frames.
  double wheel_scale_sigma = mtr_core::sensor_figures::kAssumedWheelScale.value;
  /// Prior of the scale error of the gyro turns in the motions of the key frames.
  double gyro_scale_sigma = mtr_core::sensor_figures::kAssumedGyroScale.value;
  /// The path must end within this distance of an earlier part of itself.
  double closing_distance_m = 1.5;
};

using AdjustmentRow = mtr_core::ParameterRow<AdjustmentParameters>;

/// Name, range and unit of each parameter.
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

/// Throws ConfigurationError if a value is outside its range.
void check(const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
