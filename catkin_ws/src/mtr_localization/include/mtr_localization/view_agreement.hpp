/// @file
/// Whether a sweep shows what a map lets expect at a pose.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mtr_localization/map_types.hpp"
#include "mtr_localization/surfel_map.hpp"
#include "mtr_localization/sweep.hpp"

namespace mtr_localization {

/// Beams by what they show.
struct Agreement {
  /// The expected surface.
  int seen = 0;
  /// Something in front of it.
  int hidden = 0;
  /// What lies behind it, or nothing at all: the surface is not there.
  int missing = 0;
  /// Something where the map has nothing.
  int unknown = 0;

  int evidence() const { return seen + hidden + missing; }
  /// Seen share of what the beams say, 0 to 1. What is unknown counts less: a frozen map ends somewhere.
  double share() const;
};

/// Pose of base_link in the map when a sweep was taken, and how far it turned meanwhile.
struct ViewPose {
  PoseVector pose;
  double turned_at_first_beam_rad = 0.0;
  double turned_at_last_beam_rad = 0.0;
};

/// Draws the map as the LiDAR would see it and compares.
/// @param tolerance_m what a surface may be off to count as seen
Agreement agreement_of(const Sweep& sweep, const ViewPose& view, const SurfelMap& map, double tolerance_m);

}  // namespace mtr_localization
