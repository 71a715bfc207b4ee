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

/// How far wheels and gyro are trusted; sources are in mtr_core/sensor_figures.py. Sigmas are 1 standard deviation;
/// densities are per square root of time, distance or angle.
struct SensorParameters {
  /// Gyro: white noise density, random walk of the bias, error of scale.
  double gyro_noise_radps_per_sqrt_hz = sensors::kAssumedGyroNoiseRadpsPerSqrtHz.value;
  double gyro_bias_walk_radps_per_sqrt_s = sensors::kAssumedGyroBiasWalkRadpsPerSqrtS.value;
  double gyro_scale_sigma = sensors::kAssumedGyroScale.value;
  /// Wheels: error of the radius, slip along the path, shift of base_link while the base turns.
  double wheel_scale_sigma = sensors::kAssumedWheelScale.value;
  double slip_m_per_sqrt_m = sensors::kAssumedSlipMPerSqrtM.value;
  double turn_slip_m_per_sqrt_rad = sensors::kAssumedTurnSlipMPerSqrtRad.value;
  /// Wheels slower than this, in m/s and rad/s, may stand still.
  double standstill_linear_mps = 0.005;
  double standstill_angular_radps = 0.01;
  /// Bias-corrected gyro rate above which the robot does not stand still.
  double standstill_gyro_radps = 0.03;
  /// Wheels must rest for so long before the robot is taken to stand still: mast and tyres swing after a stop.
  double standstill_settling_s = 0.5;
  /// Duration of standstill that measures the gyro's bias before the first valid pose.
  double bias_time_s = 1.0;
  /// A longer gap in wheel odometry or IMU data is an interruption.
  double gap_limit_s = 0.2;
  /// Of a recording that begins while the robot drives: the gyro's bias is that of switch-on until it stands.
  bool begins_in_motion = false;
};

using SensorRow = mtr_core::ParameterRow<SensorParameters>;

/// Range and unit of each parameter.
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

/// How far points of scans and the map are trusted. Sigmas are 1 standard deviation.
struct TrackingParameters {
  /// Range of one beam, together with the surface's roughness.
  double range_sigma_m = sensors::kAssumedPointM.value;
  /// Direction of one beam.
  double beam_angle_sigma_rad = sensors::kAssumedReturnDirectionRad.value;
  /// Share of the beams that count as independent: neighbours share the surface's shape and the footprint of the beam.
  double independent_share = 0.25;
  /// More points of one sweep than these are thinned out evenly.
  double max_points = 360;
  /// Largest distance between a point and its surface.
  double max_match_m = 0.4;
  /// A scan that leaves one direction to guess by more than this, 1 sigma, is degenerate.
  double degenerate_sigma_m = 0.25;
  /// Share of what is expected in view that must be seen, or of what is seen that must be expected, over
  /// `lost_after_s`; else the pose is lost.
  double min_agreement = 0.55;
  double lost_after_s = 0.6;
  /// The same while most of it is hidden by something nearer, which says less: a person, or the Car's body above its
  /// tyres while the robot brakes and pitches, which takes 1 s. On level ground a view of which little more than half
  /// agrees may be chance: while it lasts this falls to `lost_after_s`, and to 0 where it looks through surfaces.
  double lost_hidden_after_s = 1.5;
  /// A position less certain than this, 1 sigma in the worst direction, is lost.
  double lost_sigma_m = 0.3;
  /// The search for a lost pose covers so much round the last one, in x and y; all headings. Where it does not reach, a
  /// place that looks like the true one has no rival: it has to be larger than what a robot can be carried.
  double search_radius_m = 12.0;
  /// Mean of the two shares that a found pose must have in each view, and by how much more than any other place.
  double found_agreement = 0.6;
  double found_margin = 0.12;
};

using TrackingRow = mtr_core::ParameterRow<TrackingParameters>;

/// Range and unit of each parameter.
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

/// From key frames to a map.
struct MappingParameters {
  /// From the stamp of the order to freeze the map to the instant at which poses are in the frozen map.
  double freeze_delay_s = 2.0;
  /// Drift of the map while it grows: sigma of position and heading after 1 m of travel, growing with its root. With
  /// the Car alone in view the simulation shows half of it, among walls a tenth.
  double mapping_drift_m_per_sqrt_m = 0.01;
  double mapping_drift_rad_per_sqrt_m = 0.003;
};

using MappingRow = mtr_core::ParameterRow<MappingParameters>;

/// Range and unit of each parameter.
inline constexpr std::array<MappingRow, 3> kMappingRows{{
    {"mapping_drift_m_per_sqrt_m", &MappingParameters::mapping_drift_m_per_sqrt_m, 0.0, 1.0, "m/sqrt(m)"},
    {"mapping_drift_rad_per_sqrt_m", &MappingParameters::mapping_drift_rad_per_sqrt_m, 0.0, 0.1, "rad/sqrt(m)"},
    {"freeze_delay_s", &MappingParameters::freeze_delay_s, 0.1, 30.0, "s"},
}};

/// Everything that localization is started with.
struct Parameters {
  SensorParameters sensors;
  TrackingParameters tracking;
  MappingParameters mapping;
  mtr_surfel_map::AdjustmentParameters adjustment;
  /// Sweeps, orders and maps take effect at times that follow from their stamps alone: in simulation and offline.
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

/// Throws ConfigurationError unless each value is in its range.
void check(const Parameters& parameters);

}  // namespace mtr_localization
