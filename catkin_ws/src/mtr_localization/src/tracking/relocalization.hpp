/// @file
/// Finds a lost pose again: a search of all poses round the last one, a little with each sweep.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "scans/sweep.hpp"
#include "tracking/distance_field.hpp"
#include "tracking/matcher.hpp"

namespace mtr_localization {

/// What one scan set shows.
struct SearchView {
  const Sweep& sweep;
  const ScanPoints& scan;
  /// Base_link in odom at the scan.
  PoseVector odom;
  /// Rise of base_link's x and y axes per metre.
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};

/// One search. The robot may move meanwhile: poses are those at the search's first sweep, carried on by odometry.
///
/// Coarse: each pose of a grid is scored by how near the first sweep's points come to surfaces. Fine: the best are laid
/// on the surfaces and compared by what the present sweep shows. Unique: the best must be better than any other place.
/// Confirmed: further sweeps agree.
class Relocalization {
 public:
  struct Found {
    PoseVector pose;
    Eigen::Matrix3d covariance;
  };

  /// Both outlive the search.
  Relocalization(const TrackingParameters& parameters, const ReferenceMap& map);

  /// Begins anew round a pose of base_link in map.
  void begin(const PoseVector& around, const SearchView& view);

  /// One step; the pose at the view when it is sure.
  std::optional<Found> advance(const SearchView& view);

 private:
  struct Candidate {
    PoseVector pose;
    double score;
  };
  enum class Phase { kIdle, kCoarse, kFine, kConfirm };

  void score_headings();
  void keep(const Candidate& candidate);
  void refine(const SearchView& view);
  bool choose();
  std::optional<Found> confirm(const SearchView& view);
  PoseVector carried(const PoseVector& pose, const SearchView& view) const;
  double agreement_at(const PoseVector& pose, const SearchView& view) const;
  ScanMatch match_at(const PoseVector& pose, const SearchView& view, double sigma_m, double sigma_rad) const;

  TrackingParameters parameters_;
  const ReferenceMap& map_;
  ScanMatcher matcher_;
  DistanceField field_;
  Phase phase_ = Phase::kIdle;
  PoseVector around_ = PoseVector::Zero();
  PoseVector first_odom_ = PoseVector::Zero();
  std::vector<Eigen::Vector2d> points_;
  int next_heading_ = 0;
  std::vector<Candidate> candidates_;
  std::size_t next_candidate_ = 0;
  std::vector<Candidate> refined_;
  Candidate best_{PoseVector::Zero(), 0.0};
  int confirmed_ = 0;
};

}  // namespace mtr_localization
