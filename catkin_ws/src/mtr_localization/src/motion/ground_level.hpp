/// @file
/// Separation of ground slope and accelerometer bias.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace mtr_localization {

/// The Car and the robot have the same ground, so tilt is measured against its mean plane. Over many places and
/// headings, the tilt that turns with the robot is the accelerometer bias, and the constant part is the slope of the
/// ground. Both are estimated by least squares with exponential forgetting.
class GroundLevel {
 public:
  /// Adds the slope at another place or heading.
  /// @param slope rise of base_link's x and y axes per metre
  void add(double heading_rad, const Eigen::Vector2d& slope);

  /// Returns the slope relative to the ground plane.
  Eigen::Vector2d relative(double heading_rad, const Eigen::Vector2d& slope) const;

  /// 1 sigma of that slope along each axis; it is larger on uneven ground.
  double sigma() const { return sigma_; }

 private:
  using Unknowns = Eigen::Vector4d;

  /// Bias in base_link, slope of the ground.
  Unknowns unknowns_ = Unknowns::Zero();
  Eigen::Matrix4d information_ = Eigen::Matrix4d::Zero();
  Unknowns information_vector_ = Unknowns::Zero();
  double squares_ = 0.0;
  double count_ = 0.0;
  double sigma_ = 0.0;
};

}  // namespace mtr_localization
