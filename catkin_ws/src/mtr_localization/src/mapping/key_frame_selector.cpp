/// @file
/// Distance, angle and standstill since the last key frame.
// SPDX-License-Identifier: Apache-2.0
#include "mapping/key_frame_selector.hpp"

#include <cmath>

#include "map_names.hpp"

namespace mtr_localization {
namespace {

// Spacing of key frames while driving: each piece of surface is then seen about ten times at each occurring distance.
constexpr double kEveryM = 0.3;
constexpr double kEveryRad = 0.25;
// A place of rest at this distance from the last key frame becomes a key frame of its own.
constexpr double kRestEveryM = 0.1;
constexpr double kRestEveryRad = 0.1;
// Averaged scans per place: 0.4 s at 25 Hz; with more, surface errors dominate the LiDAR noise.
constexpr int kScansAtRest = 10;

double square(double value) { return value * value; }

}  // namespace

void KeyFrameSelector::restart() {
  last_odom_.reset();
  led_.setZero();
  resting_.clear();
}

void KeyFrameSelector::travel(double distance_m, double angle_rad) {
  distance_m_ += std::abs(distance_m);
  turned_rad_ += std::abs(angle_rad);
}

std::optional<KeyFrame> KeyFrameSelector::add(const KeyFrameCandidate& candidate) {
  if (!candidate.standing) {
    resting_.clear();
    return is_due(candidate, kEveryM, kEveryRad) ? std::optional<KeyFrame>(key_frame_of(candidate)) : std::nullopt;
  }
  if (!is_due(candidate, kRestEveryM, kRestEveryRad)) {
    return std::nullopt;
  }
  resting_.add(candidate.scan);
  if (resting_.scans() < kScansAtRest) {
    return std::nullopt;
  }
  KeyFrame frame = key_frame_of(candidate);
  frame.scan = resting_.mean();
  frame.standing = true;
  frame.sweeps = resting_.scans();
  resting_.clear();
  return frame;
}

bool KeyFrameSelector::is_due(const KeyFrameCandidate& candidate, double every_m, double every_rad) const {
  if (!last_odom_) {
    return true;
  }
  const PoseVector moved = relative(*last_odom_, candidate.odom);
  return moved.head<2>().norm() >= every_m || std::abs(moved[2]) >= every_rad;
}

KeyFrame KeyFrameSelector::key_frame_of(const KeyFrameCandidate& candidate) {
  KeyFrame frame;
  frame.stamp_ns = candidate.scan.stamp_ns;
  frame.pose = candidate.pose;
  frame.scan = candidate.scan;
  if (last_odom_) {
    const double duration_s = static_cast<double>(frame.stamp_ns - last_ns_) * 1e-9;
    frame.motion = relative(*last_odom_, candidate.odom);
    frame.motion_covariance = motion_covariance(duration_s, candidate.gyro_bias_sigma_radps);
  }
  last_odom_ = candidate.odom;
  last_ns_ = frame.stamp_ns;
  distance_m_ = turned_rad_ = 0.0;
  led_.setZero();
  return frame;
}

Eigen::Matrix3d KeyFrameSelector::motion_covariance(double duration_s, double gyro_bias_sigma_radps) const {
  const double heading = square(parameters_.gyro_noise_radps_per_sqrt_hz) * duration_s +
                         square(gyro_bias_sigma_radps * duration_s) +
                         square(parameters_.gyro_scale_sigma * turned_rad_) + led_(2, 2);
  const double turning = square(parameters_.turn_slip_m_per_sqrt_rad) * turned_rad_;
  // The wheel scale is excluded, because it is common to all motions and estimated by the adjustment.
  const double along = square(parameters_.slip_m_per_sqrt_m) * distance_m_;
  // Lateral: slip of the tyres, and the mean heading error on the path.
  const double across = along + heading * square(0.5 * distance_m_);
  // Bridged motions are given in odom; their covariance is treated as isotropic.
  return Eigen::Vector3d(along + turning + led_(0, 0), across + turning + led_(1, 1), heading).asDiagonal();
}

}  // namespace mtr_localization
