/// @file
/// What tracking hands to mapping and mapping hands back: key frames in, surface elements out.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mtr_core/problem.hpp"

namespace mtr_surfel_map {

/// LiDARs of a robot: the front one is number 0, the rear one 1.
inline constexpr int kLidars = 2;

/// One beam's return without motion distortion, in base_link at the stamp of its ScanPoints.
struct ScanPoint {
  Eigen::Vector2d position;
  /// Unit vector along the beam, away from the LiDAR: a range error e moves the point by e * direction.
  Eigen::Vector2d direction;
  double range_m;
  /// Above the LiDAR's height, by the robot's tilt; negative below it.
  double rise_m = 0.0;
  /// Number of the LiDAR that sent it.
  int lidar = 0;
};

/// Returns of one or more sweeps (front and rear) that hold at the same instant.
struct ScanPoints {
  std::int64_t stamp_ns = 0;
  std::vector<ScanPoint> points;
};

/// Pose of base_link in map: x (m), y (m), heading (rad).
using PoseVector = Eigen::Vector3d;

/// A place from which the surroundings were seen.
struct KeyFrame {
  std::int64_t stamp_ns = 0;
  PoseVector pose = PoseVector::Zero();
  ScanPoints scan;
  /// Motion since the previous key frame by wheels and gyro, in base_link of the previous one, and its covariance.
  PoseVector motion = PoseVector::Zero();
  Eigen::Matrix3d motion_covariance = Eigen::Matrix3d::Identity();
  /// The robot stood still; the scan may be the mean of several.
  bool standing = false;
  /// Number of sweeps that the scan is the mean of.
  int sweeps = 1;
};

/// Lean of surfaces of which nothing is known, 1 sigma: sides of cars and cones lean by up to 1 in 5, the fronts of
/// tyres by more, walls not at all.
inline constexpr double kLeanSigma = 0.2;
/// What a lean leaves unexplained, 1 sigma: no surface is straight from top to bottom. Bumpers are upright above and
/// recede by 1 in 3 below; a straight line through both is off by a quarter of the bend.
inline constexpr double kBendSigma = 0.1;

/// A short straight piece of surface in map.
struct Surfel {
  Eigen::Vector2d position;
  /// Unit vector towards the side from which it was seen.
  Eigen::Vector2d normal;
  double length_m;
  /// 1 sigma of its position along the normal, in the frame of the map.
  double sigma_m;
  int hits;
  /// Heights at which beams met it, above the LiDAR's own height by the robot's tilt.
  double lowest_rise_m = 0.0;
  double highest_rise_m = 0.0;
  /// How far it stands out along its normal per metre of rise, and its 1 sigma: cones narrow upwards, bumpers recede
  /// downwards.
  double lean = 0.0;
  double lean_sigma = kLeanSigma;
};

/// Constant error of each LiDAR's ranges (m, by its number) and its covariance (m^2): each LiDAR has its own.
struct RangeBias {
  Eigen::Matrix<double, kLidars, 1> value_m = Eigen::Matrix<double, kLidars, 1>::Zero();
  Eigen::Matrix<double, kLidars, kLidars> covariance = Eigen::Matrix<double, kLidars, kLidars>::Zero();

  /// Error of this point's range.
  double of(const ScanPoint& point) const { return value_m[point.lidar]; }
  /// Where the point is without it, in base_link.
  Eigen::Vector2d corrected(const ScanPoint& point) const { return point.position - of(point) * point.direction; }
};

/// Result of the adjustment of all key frames.
struct AdjustedMap {
  /// False: the key frames gave no map that can be trusted; see message.
  bool valid = false;
  std::vector<Surfel> surfels;
  /// The key frames as given, with adjusted poses.
  std::vector<KeyFrame> key_frames;
  std::vector<Eigen::Matrix3d> pose_covariances;
  /// The surfels are free of it.
  RangeBias range_bias;
  /// Why it is not valid, or what is to be known of it.
  mtr_core::Problem message;
};

}  // namespace mtr_surfel_map
