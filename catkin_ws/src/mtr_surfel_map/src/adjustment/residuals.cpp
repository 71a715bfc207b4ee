/// @file
/// Residuals of the adjustment and their derivatives.
// SPDX-License-Identifier: Apache-2.0
#include "adjustment/residuals.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "mtr_surfel_map/se2.hpp"

namespace mtr_surfel_map {
namespace {

// Thresholds of the robust kernels in sigmas: Cauchy for views, Huber for motions.
constexpr double kSurfaceKernel = 2.0;
constexpr double kMotionKernel = 3.0;
// Lower bound of the motion sigmas, also at standstill: swinging of the mast and encoder resolution.
constexpr double kMinMotionSigmaM = 0.0005;
constexpr double kMinMotionSigmaRad = 0.0002;

Eigen::Matrix3d motion_covariance_of(const KeyFrame& frame, double factor) {
  const Eigen::Vector3d least(kMinMotionSigmaM, kMinMotionSigmaM, kMinMotionSigmaRad);
  return factor * factor * (frame.motion_covariance + Eigen::Matrix3d(least.cwiseAbs2().asDiagonal()));
}

}  // namespace

Residual<1, 3 + kLidars> surface_residual(const Adjustment& state, const Observation& seen) {
  const Surfel& surfel = state.surfels[seen.surfel];
  const PoseVector& pose = state.key_frames[seen.key_frame].pose;
  const Eigen::Matrix2d turn = rotation(pose[2]);
  const Eigen::Vector2d lever = turn * (seen.position - seen.directions * state.range_bias.value_m);
  const Eigen::Vector2d& normal = surfel.normal;
  Residual<1, 3 + kLidars> residual;
  const double distance_m = normal.dot(lever + pose.head<2>() - surfel.position);
  residual.value[0] = (distance_m - surfel.lean * seen.rise_m) / seen.sigma_m;
  residual.jacobian << normal.x(), normal.y(), normal.y() * lever.x() - normal.x() * lever.y(),
      -normal.transpose() * turn * seen.directions;
  residual.jacobian /= seen.sigma_m;
  const Eigen::Index place = Layout::pose(seen.key_frame);
  const Eigen::Index bias = layout_of(state).range_bias();
  residual.places = {place, place + 1, place + 2, bias, bias + 1};
  const double part = residual.value[0] / kSurfaceKernel;
  residual.weight = 1.0 / (1.0 + part * part);
  return residual;
}

Residual<3, 8> motion_residual(const Adjustment& state, std::size_t key_frame) {
  const KeyFrame& frame = state.key_frames[key_frame];
  const PoseVector& from = state.key_frames[key_frame - 1].pose;
  const PoseVector between = relative(from, frame.pose);
  const Eigen::Matrix2d back = rotation(from[2]).transpose();
  const Eigen::Vector2d shown = frame.motion.head<2>();
  Residual<3, 8> residual;
  residual.value << between.head<2>() - (1.0 + state.wheel_scale) * shown,
      wrapped(between[2] - (1.0 + state.gyro_scale) * frame.motion[2]);
  residual.jacobian.setZero();
  residual.jacobian.block<2, 2>(0, 0) = -back;
  residual.jacobian.block<2, 1>(0, 2) << between[1], -between[0];
  residual.jacobian(2, 2) = -1.0;
  residual.jacobian.block<2, 2>(0, 3) = back;
  residual.jacobian(2, 5) = 1.0;
  residual.jacobian.block<2, 1>(0, 6) = -shown;
  residual.jacobian(2, 7) = -frame.motion[2];
  const Eigen::LLT<Eigen::Matrix3d> root(motion_covariance_of(frame, state.motion_factor));
  root.matrixL().solveInPlace(residual.value);
  root.matrixL().solveInPlace(residual.jacobian);
  const Layout layout = layout_of(state);
  const Eigen::Index place = Layout::pose(static_cast<Eigen::Index>(key_frame));
  residual.places = {place - 3,          place - 2, place - 1, place, place + 1, place + 2, layout.wheel_scale(),
                     layout.gyro_scale()};
  residual.weight = std::min(1.0, kMotionKernel / std::max(residual.value.norm(), kMotionKernel));
  return residual;
}

}  // namespace mtr_surfel_map
