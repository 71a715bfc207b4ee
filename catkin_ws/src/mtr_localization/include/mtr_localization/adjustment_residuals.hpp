/// @file
/// What the adjustment makes small: distances of points from surfaces and contradictions to wheels and gyro, in sigmas.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "mtr_localization/map_types.hpp"
#include "mtr_localization/observations.hpp"

namespace mtr_localization {

/// One view of a surfel: distance of its mean point from the surfel shifted by `offset` along its normal.
struct SurfaceResidual {
  Observation seen;
  Eigen::Vector2d surfel_position;
  Eigen::Vector2d surfel_normal;

  template <typename T>
  bool operator()(const T* pose, const T* offset, const T* range_bias, T* residual) const {
    using std::cos;
    using std::sin;
    const T c = cos(pose[2]);
    const T s = sin(pose[2]);
    const T x = seen.position.x() - range_bias[0] * seen.direction.x();
    const T y = seen.position.y() - range_bias[0] * seen.direction.y();
    const T from_surfel_x = c * x - s * y + pose[0] - surfel_position.x();
    const T from_surfel_y = s * x + c * y + pose[1] - surfel_position.y();
    const T distance = surfel_normal.x() * from_surfel_x + surfel_normal.y() * from_surfel_y;
    residual[0] = (distance - offset[0]) / seen.sigma_m;
    return true;
  }
};

/// Motion between two key-frames against that of wheels and gyro, whose distances are short by a common scale error.
struct MotionResidual {
  PoseVector motion;
  /// Makes the differences independent with sigma 1.
  Eigen::Matrix3d whitening;

  template <typename T>
  bool operator()(const T* from, const T* to, const T* wheel_scale, T* residual) const {
    using std::cos;
    using std::sin;
    const T c = cos(from[2]);
    const T s = sin(from[2]);
    const T dx = to[0] - from[0];
    const T dy = to[1] - from[1];
    Eigen::Matrix<T, 3, 1> difference;
    difference[0] = c * dx + s * dy - (1.0 + wheel_scale[0]) * motion[0];
    difference[1] = -s * dx + c * dy - (1.0 + wheel_scale[0]) * motion[1];
    const T turn = to[2] - from[2] - motion[2];
    difference[2] = turn;
    Eigen::Map<Eigen::Matrix<T, 3, 1>> result(residual);
    result = whitening.cast<T>() * difference;
    return true;
  }
};

/// What is known of one number beforehand: 0, and its sigma.
struct ZeroPrior {
  double sigma;

  template <typename T>
  bool operator()(const T* value, T* residual) const {
    residual[0] = value[0] / sigma;
    return true;
  }
};

}  // namespace mtr_localization
