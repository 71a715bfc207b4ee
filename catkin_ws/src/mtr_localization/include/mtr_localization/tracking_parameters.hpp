/// @file
/// Parameters of tracking by LiDAR: how far its points and the map are trusted, SI units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"

namespace mtr_localization {

/// Sigmas are 1 standard deviation.
struct TrackingParameters {
  /// Range noise of one beam: Hokuyo UST and SICK TiM state 1 to 2 cm indoors; together with the surface's roughness.
  double range_sigma_m = 0.015;
  /// Direction of one beam.
  double beam_angle_sigma_rad = 0.002;
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
  double least_agreement = 0.55;
  double lost_after_s = 0.6;
  /// The same while most of it is hidden by something nearer, which says less: a person, or the Car's body above its
  /// tyres while the robot brakes and pitches, which takes 1 s.
  double lost_hidden_after_s = 1.5;
  /// A position less certain than this, 1 sigma in the worst direction, is lost.
  double lost_sigma_m = 0.3;
  /// The search for a lost pose covers so much round the last one, in x and y; all headings.
  double search_radius_m = 3.0;
  /// Mean of the two shares that a found pose must have, and by how much more than any other place.
  double found_agreement = 0.6;
  double found_margin = 0.12;
  /// Drift of the map while it grows: sigma of position and heading after 1 m of travel, growing with its root. With
  /// the Car alone in view the simulation shows half of it, among walls a tenth.
  double mapping_drift_m_per_sqrt_m = 0.01;
  double mapping_drift_rad_per_sqrt_m = 0.003;
  /// From the stamp of the order to freeze the map to the instant at which poses are in the frozen map.
  double freeze_delay_s = 2.0;
  /// Pose from elsewhere (localization:=external): its sigmas, and how old map -> odom may be.
  double external_position_sigma_m = 0.05;
  double external_heading_sigma_rad = 0.02;
  double external_timeout_s = 1.0;
};

using TrackingRow = mtr_core::ParameterRow<TrackingParameters>;

/// Range and unit of each parameter.
inline constexpr std::array<TrackingRow, 19> kTrackingRows{{
    {"range_sigma_m", &TrackingParameters::range_sigma_m, 0.001, 0.2, "m"},
    {"beam_angle_sigma_rad", &TrackingParameters::beam_angle_sigma_rad, 0.0, 0.05, "rad"},
    {"independent_share", &TrackingParameters::independent_share, 0.01, 1.0, ""},
    {"max_points", &TrackingParameters::max_points, 50, 5000, ""},
    {"max_match_m", &TrackingParameters::max_match_m, 0.05, 2.0, "m"},
    {"degenerate_sigma_m", &TrackingParameters::degenerate_sigma_m, 0.01, 5.0, "m"},
    {"least_agreement", &TrackingParameters::least_agreement, 0.0, 1.0, ""},
    {"lost_after_s", &TrackingParameters::lost_after_s, 0.1, 10.0, "s"},
    {"lost_hidden_after_s", &TrackingParameters::lost_hidden_after_s, 0.1, 10.0, "s"},
    {"lost_sigma_m", &TrackingParameters::lost_sigma_m, 0.02, 10.0, "m"},
    {"search_radius_m", &TrackingParameters::search_radius_m, 0.5, 10.0, "m"},
    {"found_agreement", &TrackingParameters::found_agreement, 0.1, 1.0, ""},
    {"found_margin", &TrackingParameters::found_margin, 0.0, 1.0, ""},
    {"mapping_drift_m_per_sqrt_m", &TrackingParameters::mapping_drift_m_per_sqrt_m, 0.0, 1.0, "m/sqrt(m)"},
    {"mapping_drift_rad_per_sqrt_m", &TrackingParameters::mapping_drift_rad_per_sqrt_m, 0.0, 0.1, "rad/sqrt(m)"},
    {"freeze_delay_s", &TrackingParameters::freeze_delay_s, 0.1, 30.0, "s"},
    {"external_position_sigma_m", &TrackingParameters::external_position_sigma_m, 0.001, 10.0, "m"},
    {"external_heading_sigma_rad", &TrackingParameters::external_heading_sigma_rad, 0.0001, 1.0, "rad"},
    {"external_timeout_s", &TrackingParameters::external_timeout_s, 0.05, 60.0, "s"},
}};

/// Throws ConfigurationError unless each value is in its range.
void check(const TrackingParameters& parameters);

}  // namespace mtr_localization
