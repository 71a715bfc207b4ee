/// @file
/// Finds a lost pose again: places that explain what is seen from several places on the way.
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

/// One search, for as long as the pose is lost. Sweeps of one place say the same again and again; what tells a place
/// from one that looks like it is what is seen after driving or turning, which wheels and gyro connect.
///
/// Search: from each new view all places round the pose that was lost are tried, without regard to those found before.
/// Compare: each place that was ever found, and the pose that wheels and gyro led to, is laid on the surfaces in each
/// view. Decide: one place explains all of at least kViewsToDecide views, every other place explains them less, and
/// there the returns lie on the surfaces as exactly as they are measured.
class Relocalization {
 public:
  struct Found {
    PoseVector pose;
    Eigen::Matrix3d covariance;
  };
  /// Where a pose may be found.
  enum class Extent { kEverywhere, kReckonedOnly };

  /// The map outlives the search.
  Relocalization(const TrackingParameters& parameters, const ReferenceMap& map, Extent extent = Extent::kEverywhere);

  /// One step; the pose at the view when it is sure.
  /// @param reckoned pose of base_link in map that wheels and gyro led to
  std::optional<Found> advance(const View& view, const PoseVector& reckoned);

 private:
  /// How well a place and a view agree.
  struct Shares {
    /// Of what is expected and of what returned, both.
    double both;
    /// Of what returned.
    double returns;
  };
  /// A place, as the pose of odom in map, and its shares in each view kept.
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
  /// Where the search began, in map.
  std::optional<PoseVector> around_;
  /// Where wheels and gyro have led, at the newest view.
  PoseVector reckoned_ = PoseVector::Zero();
  /// Places found from the newest view.
  std::vector<PoseVector> found_;
  /// The next of `known_` hypotheses of earlier views, and of the places found, to be worked on.
  std::size_t next_ = 0;
  std::size_t known_ = 0;
  /// Newest last.
  std::deque<View> views_;
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace mtr_localization
