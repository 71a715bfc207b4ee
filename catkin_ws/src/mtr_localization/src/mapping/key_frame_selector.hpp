/// @file
/// Selection of key frames from scans.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "map_names.hpp"
#include "mapping/scan_mean.hpp"
#include "parameters.hpp"

namespace mtr_localization {

/// Scan that may become a key frame.
struct KeyFrameCandidate {
  ScanPoints scan;
  PoseVector pose = PoseVector::Zero();
  /// Pose of base_link in odom.
  PoseVector odom = PoseVector::Zero();
  bool standing = false;
  double gyro_bias_sigma_radps = 0.0;
};

/// Selects a key frame at a fixed spacing of distance or angle, and one at each stop, which is the mean of several
/// scans.
class KeyFrameSelector {
 public:
  explicit KeyFrameSelector(const SensorParameters& parameters) : parameters_(parameters) {}

  /// Starts a new map with the next candidate.
  void restart();

  /// Adds driven distance and absolute turn.
  void travel(double distance_m, double angle_rad);

  /// Adds a motion that was not measured.
  /// @param covariance of the motion in odom: x (m), y (m), heading (rad)
  void lead(const Eigen::Matrix3d& covariance) { led_ += covariance; }

  /// Adds a candidate and returns the key frame that it completes, if any.
  std::optional<KeyFrame> add(const KeyFrameCandidate& candidate);

 private:
  bool is_due(const KeyFrameCandidate& candidate, double every_m, double every_rad) const;
  KeyFrame key_frame_of(const KeyFrameCandidate& candidate);
  Eigen::Matrix3d motion_covariance(double duration_s, double gyro_bias_sigma_radps) const;

  SensorParameters parameters_;
  /// Pose of base_link in odom and time of the last key frame.
  std::optional<PoseVector> last_odom_;
  std::int64_t last_ns_ = 0;
  double distance_m_ = 0.0;
  double turned_rad_ = 0.0;
  /// Covariance of unmeasured motions since the last key frame.
  Eigen::Matrix3d led_ = Eigen::Matrix3d::Zero();
  ScanMean resting_;
};

}  // namespace mtr_localization
