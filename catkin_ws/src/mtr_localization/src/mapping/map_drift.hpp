/// @file
/// Uncertainty of a pose in a map that grows: the map bends with its errors and still agrees with itself.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "motion/pose_filter.hpp"
#include "parameters.hpp"

namespace mtr_localization {

/// Random walk of position and heading over the path since the map began. A heading error displaces all of the path
/// after it, so the position becomes uncertain faster than its own walk.
class MapDrift {
 public:
  explicit MapDrift(const Parameters& parameters);

  void restart() { covariance_.setZero(); }

  /// Propagates over one motion. @param heading_rad of the robot in map
  void travel(const Motion& motion, double heading_rad);

  /// Of x (m), y (m), heading (rad), in map.
  const Eigen::Matrix3d& covariance() const { return covariance_; }

 private:
  Eigen::Vector3d per_metre_;
  double heading_per_second_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace mtr_localization
