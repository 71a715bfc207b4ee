/// @file
/// Parameters of localization with unit, range and source: sensors, tracking, mapping. SI units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"
#include "mtr_core/sensor_figures.hpp"
#include "mtr_surfel_map/adjustment/parameters.hpp"

namespace mtr_localization {

namespace sensors = mtr_core::sensor_figures;
using mtr_core::row_of;

/// Uncertainties of wheels and gyro; the sources are in mtr_core/sensor_figures.py. Sigmas are 1 standard deviation;
/// densities are per square root of time, distance or angle.
struct SensorParameters {
  /// Gyro: white noise density, random walk of the bias, scale error.
  double gyro_noise_radps_per_sqrt_hz = sensors::kAssumedGyroNoiseRadpsPerSqrtHz.value;
  double gyro_bias_walk_radps_per_sqrt_s = sensors::kAssumedGyroBiasWalkRadpsPerSqrtS.value;
  double gyro_scale_sigma = sensors::kAssumedGyroScale.value;
  /// Wheels: radius error, slip along the path, shift of base_link in turns.
  double wheel_scale_sigma = sensors::kAssumedWheelScale.value;
  double slip_m_per_sqrt_m = sensors::kAssumedSlipMPerSqrtM.value;
  double turn_slip_m_per_sqrt_rad = sensors::kAssumedTurnSlipMPerSqrtRad.value;
  /// Upper limits of the wheel speeds at standstill, in m/s and rad/s.
  double standstill_linear_mps = 0.005;
  double standstill_angular_radps = 0.01;
  /// Upper limit of the bias-corrected gyro rate at standstill.
  double standstill_gyro_radps = 0.03;
  /// The wheels must rest this long before standstill is detected, because mast and tyres swing after a stop.
  double standstill_settling_s = 0.5;
  /// Duration of the standstill that measures the gyro bias before the first valid pose.
  double bias_time_s = 1.0;
  /// Longer gaps in wheel odometry or IMU data are interruptions.
  double gap_limit_s = 0.2;
  /// For recordings that start in motion: the prior of the gyro bias at switch-on is used until standstill.
  bool begins_in_motion = false;
};

using SensorRow = mtr_core::ParameterRow<SensorParameters>;

/// Name, range and unit of each parameter.
inline constexpr std::array<SensorRow, 12> kSensorRows{{
    row_of("gyro_noise_radps_per_sqrt_hz", &SensorParameters::gyro_noise_radps_per_sqrt_hz,
           sensors::kAssumedGyroNoiseRadpsPerSqrtHz),
    row_of("gyro_bias_walk_radps_per_sqrt_s", &SensorParameters::gyro_bias_walk_radps_per_sqrt_s,
           sensors::kAssumedGyroBiasWalkRadpsPerSqrtS),
    row_of("gyro_scale_sigma", &SensorParameters::gyro_scale_sigma, sensors::kAssumedGyroScale),
    row_of("wheel_scale_sigma", &SensorParameters::wheel_scale_sigma, sensors::kAssumedWheelScale),
    row_of("slip_m_per_sqrt_m", &SensorParameters::slip_m_per_sqrt_m, sensors::kAssumedSlipMPerSqrtM),
    row_of("turn_slip_m_per_sqrt_rad", &SensorParameters::turn_slip_m_per_sqrt_rad,
           sensors::kAssumedTurnSlipMPerSqrtRad),
    {"standstill_linear_mps", &SensorParameters::standstill_linear_mps, 0.0001, 0.05, "m/s"},
    {"standstill_angular_radps", &SensorParameters::standstill_angular_radps, 0.0001, 0.1, "rad/s"},
    {"standstill_gyro_radps", &SensorParameters::standstill_gyro_radps, 0.001, 0.2, "rad/s"},
    {"standstill_settling_s", &SensorParameters::standstill_settling_s, 0.1, 5.0, "s"},
    {"bias_time_s", &SensorParameters::bias_time_s, 0.2, 60.0, "s"},
    {"gap_limit_s", &SensorParameters::gap_limit_s, 0.05, 1.0, "s"},
}};

/// Uncertainties of scan points and map. Sigmas are 1 standard deviation.
struct TrackingParameters {
  /// Range of one beam, including the roughness of the surface.
  double range_sigma_m = sensors::kAssumedPointM.value;
  /// Direction of one beam.
  double beam_angle_sigma_rad = sensors::kAssumedReturnDirectionRad.value;
  /// Share of independent beams: neighbours have the shape of the surface and the footprint in common.
  double independent_share = 0.25;
  /// Sweeps with more points are thinned out evenly.
  double max_points = 360;
  /// Largest distance between a point and its surface.
  double max_match_m = 0.4;
  /// A scan with a larger 1 sigma in its weakest direction is degenerate.
  double degenerate_sigma_m = 0.25;
  /// The pose is lost if both shares are below the limit for `lost_after_s`: expected surfaces that are seen, and
  /// returns that the map explains.
  double min_agreement = 0.55;
  double lost_after_s = 0.6;
  /// Replaces `lost_after_s` while a nearer object hides most of the view, which is weaker evidence: a person, or the
  /// Car's body above its tyres while the robot brakes and pitches, which lasts 1 s. On level ground, an agreement of
  /// little more than half may be chance. While it lasts, this limit decreases to `lost_after_s`, and to 0 if beams
  /// pass through surfaces.
  double lost_hidden_after_s = 1.5;
  /// The pose is lost above this 1 sigma of the position in its worst direction.
  double lost_sigma_m = 0.3;
  /// Radius of the search for a lost pose in x and y, with all headings. It must be larger than the distance over which
  /// a robot is carried, because a look-alike place has no competitor outside of it.
  double search_radius_m = 12.0;
  /// Lowest mean of both shares in each view of a found pose, and its lowest margin over every other place.
  double found_agreement = 0.6;
  double found_margin = 0.12;
};

using TrackingRow = mtr_core::ParameterRow<TrackingParameters>;

/// Name, range and unit of each parameter.
inline constexpr std::array<TrackingRow, 13> kTrackingRows{{
    row_of("range_sigma_m", &TrackingParameters::range_sigma_m, sensors::kAssumedPointM),
    row_of("beam_angle_sigma_rad", &TrackingParameters::beam_angle_sigma_rad, sensors::kAssumedReturnDirectionRad),
    {"independent_share", &TrackingParameters::independent_share, 0.01, 1.0, ""},
    {"max_points", &TrackingParameters::max_points, 50, 5000, ""},
    {"max_match_m", &TrackingParameters::max_match_m, 0.05, 2.0, "m"},
    {"degenerate_sigma_m", &TrackingParameters::degenerate_sigma_m, 0.01, 5.0, "m"},
    {"min_agreement", &TrackingParameters::min_agreement, 0.0, 1.0, ""},
    {"lost_after_s", &TrackingParameters::lost_after_s, 0.1, 10.0, "s"},
    {"lost_hidden_after_s", &TrackingParameters::lost_hidden_after_s, 0.1, 10.0, "s"},
    {"lost_sigma_m", &TrackingParameters::lost_sigma_m, 0.02, 10.0, "m"},
    {"search_radius_m", &TrackingParameters::search_radius_m, 0.5, 30.0, "m"},
    {"found_agreement", &TrackingParameters::found_agreement, 0.1, 1.0, ""},
    {"found_margin", &TrackingParameters::found_margin, 0.0, 1.0, ""},
}};

/// Parameters of the map.
struct MappingParameters {
  /// Delay from the stamp of the order to freeze the map to the time from which on poses are in the frozen map.
  double freeze_delay_s = 2.0;
  /// Drift of the growing map: sigma of position and heading after 1 m of travel, growing with the square root. In
  /// simulation, the drift is half of it with the Car alone in view, and a tenth among walls.
  double mapping_drift_m_per_sqrt_m = 0.01;
  double mapping_drift_rad_per_sqrt_m = 0.003;
};

using MappingRow = mtr_core::ParameterRow<MappingParameters>;

/// Name, range and unit of each parameter.
inline constexpr std::array<MappingRow, 3> kMappingRows{{
    {"mapping_drift_m_per_sqrt_m", &MappingParameters::mapping_drift_m_per_sqrt_m, 0.0, 1.0, "m/sqrt(m)"},
    {"mapping_drift_rad_per_sqrt_m", &MappingParameters::mapping_drift_rad_per_sqrt_m, 0.0, 0.1, "rad/sqrt(m)"},
    {"freeze_delay_s", &MappingParameters::freeze_delay_s, 0.1, 30.0, "s"},
}};

/// All parameters of localization.
struct Parameters {
  SensorParameters sensors;
  TrackingParameters tracking;
  MappingParameters mapping;
  mtr_surfel_map::AdjustmentParameters adjustment;
  /// In lock-step, sweeps, orders and maps take effect at times that depend on their stamps only: simulation and
  /// replay.
  bool lockstep = false;
};

/// Calls visit(rows, struct) for each group of parameters.
template <typename P, typename Visit>
void for_each_group(P& parameters, Visit visit) {
  visit(kSensorRows, parameters.sensors);
  visit(kTrackingRows, parameters.tracking);
  visit(kMappingRows, parameters.mapping);
  visit(mtr_surfel_map::kAdjustmentRows, parameters.adjustment);
}

/// Throws ConfigurationError if a value is outside its range.
void check(const Parameters& parameters);

}  // namespace mtr_localization
