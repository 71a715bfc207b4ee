/// @file
/// Search of all places from which a scan could have been taken, best first.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <queue>
#include <vector>

#include "map_names.hpp"
#include "tracking/distance_field.hpp"

namespace mtr_localization {

/// Poses of one place differ by less than this.
inline constexpr double kSamePlaceM = 0.3;
inline constexpr double kSameHeadingRad = 0.12;

inline bool is_same_place(const PoseVector& a, const PoseVector& b) {
  return (a - b).head<2>().norm() < kSamePlaceM && std::abs(wrapped(a.z() - b.z())) < kSameHeadingRad;
}

/// Searches a square of places with all headings by branch and bound (Olson 2009). The score of a pose is the nearness
/// of its points to surfaces; squares of places have an upper bound, and only the best are split. The result equals an
/// exhaustive search of the grid. The work is divided into pieces, so that it does not block the caller.
class PlaceSearch {
 public:
  /// The field must outlive the search.
  explicit PlaceSearch(const DistanceField& field) : field_(field) {}

  /// Starts a search for poses of base_link within `radius_m` in x and y of a pose, from which the points could be
  /// seen.
  /// @param points in base_link
  void begin(const PoseVector& around, double radius_m, const std::vector<Eigen::Vector2d>& points);
  /// Executes one piece of work; returns true when the search is finished.
  bool advance();
  /// Found places, best first, each place once.
  const std::vector<PoseVector>& places() const { return places_; }

 private:
  /// A square of 2^level by 2^level places at one heading, with an upper bound of their scores.
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
  /// Points rotated to each heading.
  std::vector<std::vector<Eigen::Vector2d>> turned_;
  int next_heading_ = 0;
  std::priority_queue<Square> squares_;
  std::vector<PoseVector> places_;
  int work_left_ = 0;
};

}  // namespace mtr_localization
