/// @file
/// All places from which a scan could have been taken, best first.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <queue>
#include <vector>

#include "map_names.hpp"
#include "tracking/distance_field.hpp"

namespace mtr_localization {

/// Poses of the same place differ by less than this.
inline constexpr double kSamePlaceM = 0.3;
inline constexpr double kSameHeadingRad = 0.12;

inline bool is_same_place(const PoseVector& a, const PoseVector& b) {
  return (a - b).head<2>().norm() < kSamePlaceM && std::abs(wrapped(a.z() - b.z())) < kSameHeadingRad;
}

/// A search of a square of places with all headings, by branch and bound (Olson 2009): a pose is scored by how near its
/// points come to surfaces, squares of places by a bound of that, and only the best are split further. What it gives is
/// what trying each pose of the grid would give. It works in pieces, so that it never holds up its caller.
class PlaceSearch {
 public:
  /// The field outlives the search.
  explicit PlaceSearch(const DistanceField& field) : field_(field) {}

  /// Begins anew: poses of base_link within `radius_m` in x and y of a pose, from which the points would be seen.
  /// @param points in base_link
  void begin(const PoseVector& around, double radius_m, const std::vector<Eigen::Vector2d>& points);
  /// One piece of work; true when it is done.
  bool advance();
  /// Best first, no two of the same place.
  const std::vector<PoseVector>& places() const { return places_; }

 private:
  /// A square of 2^level by 2^level places at one heading, and the most that one of them can score.
  struct Square {
    int bound;
    int level;
    int heading;
    int x;
    int y;
    bool operator<(const Square& other) const { return bound < other.bound; }
  };

  Square scored(int level, int heading, int x, int y) const;
  void split(const Square& square);
  PoseVector pose_of(const Square& square) const;

  const DistanceField& field_;
  PoseVector corner_ = PoseVector::Zero();
  int places_aside_ = 0;
  /// Points turned to each heading.
  std::vector<std::vector<Eigen::Vector2d>> turned_;
  int next_heading_ = 0;
  std::priority_queue<Square> squares_;
  std::vector<PoseVector> places_;
  int work_left_ = 0;
};

}  // namespace mtr_localization
