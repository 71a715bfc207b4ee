/// @file
/// Input and output of mapping: key frames from tracking, surface elements of the map.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mtr_core/problem.hpp"

namespace mtr_surfel_map {

/// Number of LiDARs of a robot: index 0 is the front one, 1 the rear one.
inline constexpr int kLidars = 2;

/// Return of one beam without motion distortion, in base_link at the stamp of its ScanPoints.
struct ScanPoint {
  Eigen::Vector2d position;
  /// Unit vector along the beam, away from the LiDAR: a range error e moves the point by e * direction.
  Eigen::Vector2d direction;
  double range_m;
  /// Height of the return relative to the LiDAR, caused by the tilt of the robot; negative below the LiDAR.
  double rise_m = 0.0;
  /// Index of the LiDAR that measured it.
  int lidar = 0;
};

/// Returns of one or more sweeps (front and rear), corrected to one instant.
struct ScanPoints {
  std::int64_t stamp_ns = 0;
  std::vector<ScanPoint> points;
};

/// Pose of base_link in map: x (m), y (m), heading (rad).
using PoseVector = Eigen::Vector3d;

/// Scan with the pose at which it was measured.
struct KeyFrame {
  std::int64_t stamp_ns = 0;
  PoseVector pose = PoseVector::Zero();
  ScanPoints scan;
  /// Motion since the previous key frame from wheels and gyro, in base_link of that key frame, and its covariance.
  PoseVector motion = PoseVector::Zero();
  Eigen::Matrix3d motion_covariance = Eigen::Matrix3d::Identity();
  /// The robot was stationary; the scan may be the mean of several sweeps.
  bool standing = false;
  /// Number of averaged sweeps.
  int sweeps = 1;
};

/// Prior of the lean of a surface, 1 sigma. Sides of cars and cones lean by up to 1 in 5, fronts of tyres by more, and
/// walls do not lean.
inline constexpr double kLeanSigma = 0.2;
/// Shape error that a linear lean does not model, 1 sigma. Bumpers are upright above and recede by 1 in 3 below; one
/// straight line through both is off by a quarter of the bend.
inline constexpr double kBendSigma = 0.1;

/// A short straight piece of surface in map.
struct Surfel {
  Eigen::Vector2d position;
  /// Unit vector towards the side from which the surface was seen.
  Eigen::Vector2d normal;
  double length_m;
  /// 1 sigma of the position along the normal, in the frame of the map.
  double sigma_m;
  int hits;
  /// Lowest and highest hit relative to the height of the LiDAR, caused by the tilt of the robot.
  double lowest_rise_m = 0.0;
  double highest_rise_m = 0.0;
  /// Offset along the normal per metre of rise, and its 1 sigma. Cones narrow upwards; bumpers recede downwards.
  double lean = 0.0;
  double lean_sigma = kLeanSigma;
};

/// Constant range error of each LiDAR (m, by LiDAR index) and its covariance (m^2).
struct RangeBias {
  Eigen::Matrix<double, kLidars, 1> value_m = Eigen::Matrix<double, kLidars, 1>::Zero();
  Eigen::Matrix<double, kLidars, kLidars> covariance = Eigen::Matrix<double, kLidars, kLidars>::Zero();

  /// Returns the constant range error of the LiDAR that measured the point.
  double of(const ScanPoint& point) const { return value_m[point.lidar]; }
  /// Returns the position of the point without the range error, in base_link.
  Eigen::Vector2d corrected(const ScanPoint& point) const { return point.position - of(point) * point.direction; }
};

/// Result of the adjustment of all key frames.
struct AdjustedMap {
  /// False if the key frames did not give a trustworthy map; see message.
  bool valid = false;
  std::vector<Surfel> surfels;
  /// Input key frames with adjusted poses.
  std::vector<KeyFrame> key_frames;
  std::vector<Eigen::Matrix3d> pose_covariances;
  /// Estimated range bias; it is already removed from the surfels.
  RangeBias range_bias;
  /// Reason why the map is not valid; empty if it is valid.
  mtr_core::Problem message;
};

}  // namespace mtr_surfel_map
