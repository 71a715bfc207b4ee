/// @file
/// Parameters of the adjustment of key frames: how far each measurement is trusted and what a map must show, SI units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"

namespace mtr_surfel_map {

/// Sigmas are 1 standard deviation.
struct AdjustmentParameters {
  /// Random error of one range: repeatability in the data sheets of the Hokuyo UST-10LX and the SICK TiM561 is 10 to
  /// 20 mm.
  double range_noise_m = 0.015;
  /// Constant error of all ranges before it is estimated: accuracy in the same data sheets is 40 to 60 mm at most.
  double range_bias_sigma_m = 0.03;
  /// Error of a beam's direction, mounting and motion within the sweep included.
  double bearing_sigma_rad = 0.001;
  /// How far one view of a surface element is off by its shape: curvature, edges, tilt of the LiDAR's plane.
  double surface_sigma_m = 0.004;
  /// Common error of the wheels' distances in the key frames' motions.
  double wheel_scale_sigma = 0.005;
  /// The same of the gyro's turns; its source is in parameters.hpp.
  double gyro_scale_sigma = 0.001;
  /// The path must come back to where it has been before, within this distance.
  double closing_distance_m = 1.5;
};

using AdjustmentRow = mtr_core::ParameterRow<AdjustmentParameters>;

/// Range and unit of each parameter.
inline constexpr std::array<AdjustmentRow, 7> kAdjustmentRows{{
    {"range_noise_m", &AdjustmentParameters::range_noise_m, 0.001, 0.1, "m"},
    {"range_bias_sigma_m", &AdjustmentParameters::range_bias_sigma_m, 0.0001, 0.1, "m"},
    {"bearing_sigma_rad", &AdjustmentParameters::bearing_sigma_rad, 0.0, 0.01, "rad"},
    {"surface_sigma_m", &AdjustmentParameters::surface_sigma_m, 0.0005, 0.05, "m"},
    {"wheel_scale_sigma", &AdjustmentParameters::wheel_scale_sigma, 0.0001, 0.1, "of the distance"},
    {"gyro_scale_sigma", &AdjustmentParameters::gyro_scale_sigma, 0.0001, 0.1, "of the turn"},
    {"closing_distance_m", &AdjustmentParameters::closing_distance_m, 0.2, 5.0, "m"},
}};

/// Throws ConfigurationError unless each value is in its range.
void check(const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
