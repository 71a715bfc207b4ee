/// @file
/// Localization figures for diagnostics only; no decision depends on them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_localization {

/// Figures of the newest scan set.
struct TrackingFigures {
  int points = 0;
  int matched = 0;
  double residual_rms = 0.0;
  /// Larger of two shares: expected surfaces that are seen, and returns that the map explains.
  double agreement = 1.0;
  /// 1 sigma of a single scan set in its weakest direction.
  double weakest_sigma_m = 0.0;
};

/// Figures of the satellite receiver.
struct GnssFigures {
  int refused = 0;
  /// Number of fixes that corrected the pose.
  int used = 0;
  /// Distance of the newest fix from the pose, m; 0 until the frame is known.
  double residual_m = 0.0;
};

/// All figures of a pose source.
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
