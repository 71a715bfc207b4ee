/// @file
/// Recursive least squares with a prior.
// SPDX-License-Identifier: Apache-2.0
#include "motion/ground_level.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "map_names.hpp"
#include "mtr_core/sensor_figures.hpp"

namespace mtr_localization {
namespace {

// Prior, 1 sigma: bias of the accelerometer, and car parks with a drainage slope of 1 to 2 %.
constexpr double kBiasSigma = mtr_core::sensor_figures::kAssumedAccelerometerBias;
constexpr double kGroundSigma = 0.015;
// Lower bound of the sigma of one tilt relative to the plane: 0.1 deg.
constexpr double kMinSigma = 0.002;
// Slopes of neighbouring places are correlated, so this share of the scatter of a single slope remains. Measured on
// ground with slopes of 1 deg: 5 to 7 of 12 mrad remain along each axis.
constexpr double kLeft = 0.5;
// Exponential forgetting over about 300 samples, or 100 m of path.
constexpr double kKept = 1.0 - 1.0 / 300.0;

Eigen::Matrix<double, 2, 4> slope_by_unknowns(double heading_rad) {
  Eigen::Matrix<double, 2, 4> slopes;
  slopes << Eigen::Matrix2d::Identity(), rotation(-heading_rad);
  return slopes;
}

}  // namespace

void GroundLevel::add(double heading_rad, const Eigen::Vector2d& slope) {
  const Eigen::Matrix<double, 2, 4> by_unknowns = slope_by_unknowns(heading_rad);
  information_ = kKept * information_ + by_unknowns.transpose() * by_unknowns;
  information_vector_ = kKept * information_vector_ + by_unknowns.transpose() * slope;
  squares_ = kKept * squares_ + slope.squaredNorm();
  count_ = kKept * count_ + 2.0;
  // The scatter is larger on uneven ground.
  const double left = squares_ - 2.0 * unknowns_.dot(information_vector_) + unknowns_.dot(information_ * unknowns_);
  const double variance = std::max(kMinSigma * kMinSigma, left / count_);
  sigma_ = std::max(kMinSigma, kLeft * std::sqrt(variance));
  Eigen::Vector4d prior(kBiasSigma, kBiasSigma, kGroundSigma, kGroundSigma);
  prior = variance * prior.cwiseAbs2().cwiseInverse();
  unknowns_ = (information_ + Eigen::Matrix4d(prior.asDiagonal())).ldlt().solve(information_vector_);
}

Eigen::Vector2d GroundLevel::relative(double heading_rad, const Eigen::Vector2d& slope) const {
  return slope - slope_by_unknowns(heading_rad) * unknowns_;
}

}  // namespace mtr_localization
