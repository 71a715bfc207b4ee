/// @file
/// Lays a scan on the surfaces of a map.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map_names.hpp"
#include "motion/pose_filter.hpp"
#include "parameters.hpp"
#include "tracking/error_sources.hpp"

namespace mtr_localization {

/// A map to match against.
struct ReferenceMap {
  SurfelMap surfaces;
  ErrorSources sources;
  /// Taken off each range before it is compared.
  RangeBias range_bias;

  /// Of the surfaces, and what the LiDARs' biases may be off.
  int error_sources() const { return sources.count + kLidars; }
};

/// Where the pose was before the scan, and how far it may be off.
struct PosePrior {
  PoseVector pose = PoseVector::Zero();
  /// As the filter weighs it.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  /// The same with lasting errors: it bounds the search for surfaces.
  Eigen::Matrix3d full_covariance = Eigen::Matrix3d::Identity();
};

struct ScanMatch {
  /// What the scan says, linearised where it and the prior agree best.
  PoseCorrection correction;
  /// That place.
  PoseVector pose = PoseVector::Zero();
  /// Points that were compared, and those that lie on a surface.
  int points = 0;
  int matched = 0;
  /// Root mean square of the matched points' distance from their surfaces, in units of their sigma.
  double residual_rms = 0.0;

  /// Shift that the scan alone asks for, where it determines the pose at all: x (m), y (m), heading (rad).
  Eigen::Vector3d shift() const;
  /// The scan and what was known before it, with its covariance, exclude each other.
  bool contradicts(const Eigen::Matrix3d& prior_covariance) const;
};

/// Returns from the LiDAR's own height, where a surface's lean and steps do not matter.
struct ScanFit {
  /// Near a surface.
  int near = 0;
  /// Of these as near as the pose's covariance would have them.
  int exact = 0;
};

/// Iterated least squares of the points' distances from surfaces, robust against what is not in the map: the update of
/// an iterated extended Kalman filter (Bell and Cathey 1993).
class ScanMatcher {
 public:
  explicit ScanMatcher(const TrackingParameters& parameters) : parameters_(parameters) {}

  ScanMatch match(const ScanPoints& scan, const ReferenceMap& map, const PosePrior& prior) const;
  /// How well a scan lies on the map at the pose of a prior.
  ScanFit fit(const ScanPoints& scan, const ReferenceMap& map, const PosePrior& prior) const;

 private:
  struct Sums;
  Sums sum_at(const PoseVector& pose, const ScanPoints& scan, const ReferenceMap& map, const PosePrior& prior) const;
  void add_error_sources(const PoseVector& pose, const ScanPoints& scan, const ReferenceMap& map,
                         const PosePrior& prior, PoseCorrection& correction) const;

  template <typename Visit>
  void for_each_match(const PoseVector& pose, const ScanPoints& scan, const ReferenceMap& map, const PosePrior& prior,
                      Visit visit) const;

  TrackingParameters parameters_;
};

}  // namespace mtr_localization
