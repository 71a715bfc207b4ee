/// @file
/// What localization tells a person about its work; nothing is decided by it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_localization {

/// Figures of the newest scan set, for a person.
struct TrackingFigures {
  int points = 0;
  int matched = 0;
  double residual_rms = 0.0;
  /// Share of what the map lets expect that is seen, or of what is seen that it explains; the larger one.
  double agreement = 1.0;
  /// 1 sigma of a single scan set in its weakest direction.
  double weakest_sigma_m = 0.0;
};

/// Figures of the satellite receiver.
struct GnssFigures {
  int refused = 0;
  /// Fixes that corrected the pose.
  int used = 0;
  /// Distance of the newest fix from the pose, m; 0 as long as the frame is not known.
  double residual_m = 0.0;
};

/// All figures of a source of poses.
struct PoseFigures {
  double gyro_bias_radps = 0.0;
  double gyro_bias_sigma_radps = 0.0;
  double wheel_scale = 0.0;
  int scans_used = 0;
  int scans_refused = 0;
  TrackingFigures tracking;
  GnssFigures gnss;
};

}  // namespace mtr_localization
