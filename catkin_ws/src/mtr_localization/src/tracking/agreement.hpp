/// @file
/// Agreement of a sweep with the map at a pose.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map_names.hpp"
#include "scans/sweep.hpp"

namespace mtr_localization {

/// Counts of beams by their result.
struct Agreement {
  /// Fewer expected beams are not evidence of a lost pose: a Car at 12 m is met by 20 beams of one degree.
  static constexpr int kMinEvidence = 8;

  /// The beam meets the expected surface.
  int seen = 0;
  /// The return is in front of the expected surface.
  int hidden = 0;
  /// The return is behind the expected surface: the surface is not there.
  int beyond = 0;
  /// No return where a surface is expected: it is not there, or the beam passes over or under it.
  int missing = 0;
  /// No return, or one behind the surface, near one of its edges: the beam may pass the edge.
  int passed = 0;
  /// A return without a surface on the map.
  int unknown = 0;
  /// Beams in `beyond` and `missing` that passed the surface above or below all heights at which it was met. The
  /// difference is below the tilt error, so the surface may end there.
  int unsure = 0;
  /// Not the expected surface, but the tilted LiDAR looks over or under it: no information.
  int excused = 0;

  Agreement& operator+=(const Agreement& other);
  /// Beams with an expected surface.
  int expected() const { return seen + hidden + beyond + missing + passed; }
  /// Beams that pass through a surface at a height at which it was met.
  int through() const { return beyond + missing - unsure; }
  /// Share of the expected view that is seen, 0 to 1; 1 if no surface is expected.
  double share_of_expected() const;
  /// Share of returns that the map explains, 0 to 1; without returns 1 if none is expected, otherwise 0.
  double share_of_returns() const;
  /// Mean of both shares.
  double share_of_both() const { return 0.5 * (share_of_expected() + share_of_returns()); }
  /// True if the agreement is so high that it is unlikely by chance at a wrong place.
  bool is_expected() const;
  /// True if surfaces are missing at their mapped places, which a person cannot cause.
  bool is_contradicted() const;
  /// Like is_expected() for a growing map, which ignores unmapped objects.
  bool is_expected_so_far() const;
};

/// Turn of base_link relative to the pose of a sweep, at its first and its last beam.
struct SweepTurn {
  double at_first_beam_rad = 0.0;
  double at_last_beam_rad = 0.0;
};

/// Pose of base_link in map at the time of a sweep.
struct ViewPose {
  PoseVector pose;
  SweepTurn turn = {};
  /// Rise of base_link's x and y axes per metre.
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  /// 1 sigma of the slope along each axis.
  double slope_sigma = 0.0;
};

/// Renders the map as seen by the LiDAR and compares it with a sweep. If the tilt makes the LiDAR look over or under
/// mapped surfaces, or at the ground, beams without the expected surface count as no information.
/// @param tolerance_m largest offset of a surface that counts as seen
Agreement agreement_of(const Sweep& sweep, const ViewPose& view, const SurfelMap& map, double tolerance_m);

}  // namespace mtr_localization
