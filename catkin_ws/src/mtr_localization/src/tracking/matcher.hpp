/// @file
/// Scan matching against the surfaces of a map.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map_names.hpp"
#include "motion/pose_filter.hpp"
#include "parameters.hpp"
#include "tracking/error_sources.hpp"

namespace mtr_localization {

/// Map for matching.
struct ReferenceMap {
  SurfelMap surfaces;
  ErrorSources sources;
  /// Correction that is subtracted from each range.
  RangeBias range_bias;

  /// Number of error sources: surfaces, and the biases of the LiDARs.
  int error_sources() const { return sources.count + kLidars; }
};

/// Prior of the pose before a scan.
struct PosePrior {
  PoseVector pose = PoseVector::Zero();
  /// Covariance that the filter uses as weight.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  /// Covariance with persistent errors, which limits the association.
  Eigen::Matrix3d full_covariance = Eigen::Matrix3d::Identity();
};

struct ScanMatch {
  /// Correction by the scan, linearised at the matched pose.
  PoseCorrection correction;
  /// Pose at which scan and prior agree best.
  PoseVector pose = PoseVector::Zero();
  /// Compared points, and points on a surface.
  int points = 0;
  int matched = 0;
  /// Root mean square distance of matched points from their surfaces, in sigmas.
  double residual_rms = 0.0;

  /// Returns the shift by the scan alone, in directions that it determines: x (m), y (m), heading (rad).
  Eigen::Vector3d shift() const;
  /// True if scan and prior with its covariance exclude each other.
  bool contradicts(const Eigen::Matrix3d& prior_covariance) const;
};

/// Returns at the height of the LiDAR, where leans and steps of surfaces do not matter.
struct ScanFit {
  /// Number of returns near a surface.
  int near = 0;
  /// Number of these within the tolerance of the pose covariance.
  int exact = 0;
};

/// Iterated least squares of the distances of points from surfaces, robust against unmapped objects. It is the update
/// of an iterated extended Kalman filter (Bell and Cathey 1993).
class ScanMatcher {
 public:
  explicit ScanMatcher(const TrackingParameters& parameters) : parameters_(parameters) {}

  ScanMatch match(const ScanPoints& scan, const ReferenceMap& map, const PosePrior& prior) const;
  /// Returns how well a scan fits the map at the pose of a prior.
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
