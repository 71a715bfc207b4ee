/// @file
/// Whether a sweep shows what a map lets expect at a pose.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map_names.hpp"
#include "scans/sweep.hpp"

namespace mtr_localization {

/// Beams by what they show.
struct Agreement {
  /// Fewer expected beams say nothing about being lost: a Car 12 m away is met by 20 of one degree.
  static constexpr int kMinEvidence = 8;

  /// The expected surface.
  int seen = 0;
  /// Something in front of it.
  int hidden = 0;
  /// Something behind it: the surface is not there.
  int beyond = 0;
  /// Nothing, where a surface is expected: it is not there, or the LiDAR looks over or under it.
  int missing = 0;
  /// Nothing, or something behind it, beside an edge of the surface: the beam may just pass.
  int passed = 0;
  /// Something where the map has nothing.
  int unknown = 0;
  /// Those of `beyond` and `missing` that passed the surface above or below all heights at which it has been met, by
  /// less than the robot's lean is off: it may end there.
  int unsure = 0;
  /// Not the expected surface, but as the robot leans the LiDAR looks over or under it: it says nothing.
  int excused = 0;

  Agreement& operator+=(const Agreement& other);
  /// Beams that meet what the map shows, or should.
  int expected() const { return seen + hidden + beyond + missing + passed; }
  /// Beams that look through a surface at a height at which it has been met.
  int through() const { return beyond + missing - unsure; }
  /// Share of the expected view that is seen, 0 to 1; 1 when nothing is expected.
  double share_of_expected() const;
  /// Share of the returns that the map explains, 0 to 1; without returns 1 when none is expected, else 0.
  double share_of_returns() const;
  /// Mean of both.
  double share_of_both() const { return 0.5 * (share_of_expected() + share_of_returns()); }
  /// So much agrees as at a wrong place only chance gives, and seldom.
  bool is_expected() const;
  /// Surfaces are not where the map has them, of which no person can be the cause.
  bool is_contradicted() const;
  /// The same of a map that grows: what it does not have yet says nothing.
  bool is_expected_so_far() const;
};

/// How far base_link had turned against the pose of a sweep when its first and its last beam were taken.
struct SweepTurn {
  double at_first_beam_rad = 0.0;
  double at_last_beam_rad = 0.0;
};

/// Pose of base_link in the map when a sweep was taken.
struct ViewPose {
  PoseVector pose;
  SweepTurn turn = {};
  /// Rise of base_link's x and y axes per metre.
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  /// Its 1 sigma along each axis.
  double slope_sigma = 0.0;
};

/// Draws the map as the LiDAR would see it and compares. Where the robot's tilt makes the LiDAR look over or under
/// what the map shows, or at the ground, a beam that does not show the expected surface says nothing.
/// @param tolerance_m what a surface may be off to count as seen
Agreement agreement_of(const Sweep& sweep, const ViewPose& view, const SurfelMap& map, double tolerance_m);

}  // namespace mtr_localization
