/// @file
/// Uncertainty of a pose in a growing map, which may be distorted although it is consistent.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "motion/pose_filter.hpp"
#include "parameters.hpp"

namespace mtr_localization {

/// Random walk of position and heading over the path since the start of the map. A heading error displaces the whole
/// path after it, so the position uncertainty grows faster than its own random walk.
class MapDrift {
 public:
  explicit MapDrift(const Parameters& parameters);

  void restart() { covariance_.setZero(); }

  /// Propagates over one motion.
  /// @param heading_rad of the robot in map
  void travel(const Motion& motion, double heading_rad);

  /// Covariance of x (m), y (m), heading (rad), in map.
  const Eigen::Matrix3d& covariance() const { return covariance_; }

 private:
  Eigen::Vector3d per_metre_;
  double heading_per_second_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace mtr_localization
