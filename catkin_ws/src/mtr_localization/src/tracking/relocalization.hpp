/// @file
/// Relocalization: places that explain the views from several positions on the path.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "tracking/distance_field.hpp"
#include "tracking/matcher.hpp"
#include "tracking/place_search.hpp"
#include "tracking/view.hpp"

namespace mtr_localization {

/// One search for a lost pose. Sweeps from one position are redundant. A place is distinguished from a look-alike by
/// views after driving or turning, which wheels and gyro connect.
///
/// Search: each new view starts a search of all places round the lost pose, independent of earlier results. Compare:
/// each found place, and the pose of wheels and gyro, is matched with the surfaces in each view. Decide: one place
/// explains all of at least kViewsToDecide views, every other place explains them less, and the residuals at that place
/// are within the measurement accuracy.
class Relocalization {
 public:
  struct Found {
    PoseVector pose;
    Eigen::Matrix3d covariance;
  };
  /// Extent of the search.
  enum class Extent { kEverywhere, kReckonedOnly };

  /// The map must outlive the search.
  Relocalization(const TrackingParameters& parameters, const ReferenceMap& map, Extent extent = Extent::kEverywhere);

  /// Executes one step; returns the pose at the view once it is certain.
  /// @param reckoned pose of base_link in map from wheels and gyro
  std::optional<Found> advance(const View& view, const PoseVector& reckoned);

 private:
  /// Agreement of a place with a view.
  struct Shares {
    /// Mean of both shares: expected surfaces and returns.
    double both;
    /// Share of the returns.
    double returns;
  };
  /// A place, as the pose of odom in map, with its shares in each stored view.
  struct Hypothesis {
    PoseVector map_from_odom;
    std::deque<Shares> shares;

    double mean() const;
    double least() const;
    double mean_of_returns() const;
  };
  enum class Phase { kWait, kSearch, kRefine, kCompare, kDecide };

  bool begin(const View& view, const PoseVector& reckoned);
  void search();
  void refine();
  void compare();
  std::optional<Found> decide(const View& view);
  bool is_alone(const Hypothesis& best) const;
  bool is_rival(const Hypothesis& other, const Hypothesis& best, bool is_reckoned) const;
  bool is_exact(const Hypothesis& best, const PoseVector& pose, const View& view) const;
  Found settled(const View& view, const PoseVector& pose) const;
  bool is_at_rim(const PoseVector& pose) const;
  bool is_new(const View& view) const;
  void add(const PoseVector& pose);
  Hypothesis laid(const PoseVector& pose) const;
  Shares shares_at(const View& view, const PoseVector& pose) const;
  PoseVector matched(const View& view, const PoseVector& pose, double sigma_m, double sigma_rad) const;
  ScanMatch fit(const View& view, const PoseVector& pose, double sigma_m, double sigma_rad) const;

  TrackingParameters parameters_;
  const ReferenceMap& map_;
  Extent extent_;
  ScanMatcher matcher_;
  DistanceField field_;
  PlaceSearch places_;
  Phase phase_ = Phase::kWait;
  /// Start of the search, in map.
  std::optional<PoseVector> around_;
  /// Pose of wheels and gyro at the newest view.
  PoseVector reckoned_ = PoseVector::Zero();
  /// Places found from the newest view.
  std::vector<PoseVector> found_;
  /// Next item to process among `known_` earlier hypotheses and the found places.
  std::size_t next_ = 0;
  std::size_t known_ = 0;
  /// Newest last.
  std::deque<View> views_;
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace mtr_localization
