/// @file
/// LiDAR view from one place, stored for comparison with other places.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map_names.hpp"
#include "motion/filter_history.hpp"
#include "scans/sweep.hpp"
#include "tracking/agreement.hpp"

namespace mtr_localization {

/// One scan set with the motion during it, independent of the place on the map.
struct View {
  /// Sweeps, and the turn of each relative to the view's pose at its first and last beam.
  std::vector<Sweep> sweeps;
  std::vector<SweepTurn> turns;
  /// Returns without motion distortion.
  ScanPoints scan;
  std::int64_t stamp_ns = 0;
  /// Pose of base_link in odom.
  PoseVector odom = PoseVector::Zero();
  /// Rise of base_link's x and y axes per metre.
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  /// 1 sigma of the slope along each axis.
  double slope_sigma = 0.0;
};

View view_of(const ScanSet& set, ScanPoints scan, const FilterHistory& history);

/// Returns the agreement of all sweeps, for a pose of base_link in map.
Agreement agreement_of(const View& view, const PoseVector& pose, const SurfelMap& map, double tolerance_m);

}  // namespace mtr_localization
