/// @file
/// Least squares with what is known beforehand.
// SPDX-License-Identifier: Apache-2.0
#include "motion/ground_level.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "map_names.hpp"
#include "mtr_core/sensor_figures.hpp"

namespace mtr_localization {
namespace {

// What is known before anything is measured, 1 sigma: the accelerometer's bias, and car parks that drain at 1 to 2 %.
constexpr double kBiasSigma = mtr_core::sensor_figures::kAssumedAccelerometerBias;
constexpr double kGroundSigma = 0.015;
// One tilt against the plane is no surer than this: 0.1 deg.
constexpr double kMinSigma = 0.002;
// Slopes of neighbouring places are alike, so that their mean is not that of the plane: of the scatter of one slope so
// much is left. Measured on ground with slopes of 1 deg, of 12 mrad along each axis 5 to 7.
constexpr double kLeft = 0.5;
// The last 300 count: 100 m of way.
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
  // Uneven ground scatters more than flat one.
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
