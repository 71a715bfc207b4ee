/// @file
/// Which tilt is that of the place, and which the sensor's error.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace mtr_localization {

/// The Car stands on the same ground as the robot: what counts is the tilt against that ground's mean plane. Over many
/// places and headings the tilt that turns with the robot is the accelerometer's bias, and the one that does not is
/// the slope of the ground; both are found by least squares, of which the older counts less and less.
class GroundLevel {
 public:
  /// The robot is at another place or heading. @param slope rise of base_link's x and y axes per metre
  void add(double heading_rad, const Eigen::Vector2d& slope);

  /// Slope against the ground.
  Eigen::Vector2d relative(double heading_rad, const Eigen::Vector2d& slope) const;

  /// 1 sigma of that slope along each axis: uneven ground tells less of its mean plane.
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
