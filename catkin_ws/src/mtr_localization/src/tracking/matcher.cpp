/// @file
/// Point-to-surface least squares with a prior.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/matcher.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "map_names.hpp"

namespace mtr_localization {
namespace {

constexpr int kMaxIterations = 6;
// Iteration ends at a smaller step.
constexpr double kSmallStepM = 1e-4;
constexpr double kSmallTurnRad = 2e-5;
// Residual in sigmas with half the weight (Cauchy kernel; 2.385 for 95 % efficiency, Holland and Welsch 1977).
constexpr double kCauchy = 2.385;
// Lower bound of the association gate, to which 3 sigma of the prior are added.
constexpr double kMinGateM = 0.08;
// Returns within this height difference count as level with the LiDAR.
constexpr double kLevelM = 0.02;
// Surfaces also match this far beyond their ends.
constexpr double kEndM = 0.05;

// Contradiction between scan and prior: chi squared with 3 degrees of freedom, once in a million.
constexpr double kContradiction = 30.7;
constexpr double kMinInformation = 1e-6;

double square(double value) { return value * value; }

/// Returns 1 sigma of the surface position at the height of a hit. The error persists while the robot is stationary or
/// the map lasts, and is common to all beams on one surface. The lean was measured between the heights of earlier hits;
/// beyond them, the prior of the lean applies.
double lasting_sigma_m(const Surfel& surfel, double rise_m) {
  const double seen_rise_m = std::clamp(rise_m, surfel.lowest_rise_m, surfel.highest_rise_m);
  const double known_m = std::hypot(surfel.sigma_m, surfel.lean_sigma * seen_rise_m);
  return std::hypot(known_m, mtr_surfel_map::kLeanSigma * (rise_m - seen_rise_m));
}

/// True if the beam misses the end of the surfel by more than the lateral pose error. The point then belongs to
/// something else, as the front of a tyre is near the line of its side.
bool passes_beside(const SurfelMatch& match, const Eigen::Vector2d& point, const Eigen::Vector2d& direction,
                   double across_sigma_m) {
  const Surfel& surfel = *match.surfel;
  const Eigen::Vector2d along(-surfel.normal.y(), surfel.normal.x());
  const double facing = surfel.normal.dot(direction);
  const Eigen::Vector2d met = point - direction * (match.distance_along_normal_m / facing);
  const double half_m = 0.5 * surfel.length_m + kEndM + across_sigma_m / std::abs(facing);
  return std::abs(along.dot(met - surfel.position)) > half_m;
}

}  // namespace

Eigen::Vector3d ScanMatch::shift() const {
  const Eigen::Matrix3d regularized =
      correction.information + Eigen::Vector3d(1.0, 1.0, 1.0).asDiagonal().toDenseMatrix();
  return regularized.inverse() * correction.information_vector;
}

bool ScanMatch::contradicts(const Eigen::Matrix3d& prior_covariance) const {
  const Eigen::Matrix3d& information = correction.information;
  const Eigen::Matrix3d spread =
      information + information * prior_covariance * information + kMinInformation * Eigen::Matrix3d::Identity();
  return correction.information_vector.dot(spread.inverse() * correction.information_vector) > kContradiction;
}

struct ScanMatcher::Sums {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int points = 0;
  int matched = 0;
};

template <typename Visit>
void ScanMatcher::for_each_match(const PoseVector& pose, const ScanPoints& scan, const ReferenceMap& map,
                                 const PosePrior& prior, Visit visit) const {
  const Eigen::Matrix2d turn = rotation(pose.z());
  const Eigen::Matrix2d position_covariance = prior.full_covariance.topLeftCorner<2, 2>();
  const double position_sigma =
      std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(position_covariance, Eigen::EigenvaluesOnly)
                    .eigenvalues()
                    .maxCoeff());
  const double heading_sigma = std::sqrt(prior.full_covariance(2, 2));
  const auto stride =
      static_cast<std::size_t>(std::ceil(static_cast<double>(scan.points.size()) / parameters_.max_points));
  for (std::size_t i = 0; i < scan.points.size(); i += std::max<std::size_t>(stride, 1)) {
    const ScanPoint& point = scan.points[i];
    const Eigen::Vector2d direction = turn * point.direction;
    const Eigen::Vector2d lever = turn * map.range_bias.corrected(point);
    const double gate =
        std::min(parameters_.max_match_m, kMinGateM + 3.0 * (position_sigma + heading_sigma * point.range_m));
    const Eigen::Vector2d position = pose.head<2>() + lever;
    const auto match = map.surfaces.match(position, gate, direction);
    if (!match || passes_beside(*match, position, direction, position_sigma + heading_sigma * point.range_m)) {
      visit(nullptr, point, Eigen::Vector3d::Zero(), 0.0, 0.0, 0.0, 0.0);
      continue;
    }
    const Eigen::Vector2d& normal = match->surfel->normal;
    const Eigen::Vector3d slope(normal.x(), normal.y(), lever.x() * normal.y() - lever.y() * normal.x());
    const double along = normal.dot(direction);
    const double lasting = lasting_sigma_m(*match->surfel, point.rise_m);
    const double variance = square(parameters_.range_sigma_m * along) +
                            square(parameters_.beam_angle_sigma_rad * point.range_m) * (1.0 - square(along)) +
                            square(lasting);
    const double distance = match->distance_along_normal_m - match->surfel->lean * point.rise_m;
    visit(match->surfel, point, slope, distance, variance, lasting, along);
  }
}

ScanMatcher::Sums ScanMatcher::sum_at(const PoseVector& pose, const ScanPoints& scan, const ReferenceMap& map,
                                      const PosePrior& prior) const {
  Sums sums;
  for_each_match(pose, scan, map, prior,
                 [&](const Surfel* surfel, const ScanPoint&, const Eigen::Vector3d& slope, double distance,
                     double variance, double, double) {
                   ++sums.points;
                   if (surfel) {
                     const double in_sigmas = square(distance) / variance;
                     const double weight =
                         parameters_.independent_share / variance / (1.0 + in_sigmas / square(kCauchy));
                     sums.information += weight * slope * slope.transpose();
                     sums.gradient += weight * distance * slope;
                     sums.squares += in_sigmas;
                     ++sums.matched;
                   }
                 });
  return sums;
}

ScanMatch ScanMatcher::match(const ScanPoints& scan, const ReferenceMap& map, const PosePrior& prior) const {
  ScanMatch match;
  match.pose = prior.pose;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Sums sums = sum_at(match.pose, scan, map, prior);
    match.points = sums.points;
    match.matched = sums.matched;
    match.residual_rms = sums.matched > 0 ? std::sqrt(sums.squares / sums.matched) : 0.0;
    match.correction.information = sums.information;
    match.correction.information_vector = sums.information * offset - sums.gradient;
    const Eigen::Vector3d next = prior.covariance *
                                 (Eigen::Matrix3d::Identity() + sums.information * prior.covariance).inverse() *
                                 match.correction.information_vector;
    const Eigen::Vector3d step = next - offset;
    offset = next;
    match.pose = prior.pose + offset;
    match.pose.z() = wrapped(match.pose.z());
    if (step.head<2>().norm() < kSmallStepM && std::abs(step.z()) < kSmallTurnRad) {
      break;
    }
  }
  add_error_sources(match.pose, scan, map, prior, match.correction);
  return match;
}

ScanFit ScanMatcher::fit(const ScanPoints& scan, const ReferenceMap& map, const PosePrior& prior) const {
  ScanPoints level;
  std::copy_if(scan.points.begin(), scan.points.end(), std::back_inserter(level.points),
               [](const ScanPoint& point) { return std::abs(point.rise_m) <= kLevelM; });
  ScanFit fit;
  const auto is_near = [&](const ScanPoint& point) {
    const Eigen::Matrix2d turn = rotation(prior.pose.z());
    const Eigen::Vector2d direction = turn * point.direction;
    const Eigen::Vector2d position = prior.pose.head<2>() + turn * map.range_bias.corrected(point);
    return map.surfaces.match(position, parameters_.max_match_m, direction).has_value();
  };
  std::size_t next = 0;
  const auto stride = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil(static_cast<double>(level.points.size()) / parameters_.max_points)));
  for_each_match(prior.pose, level, map, prior,
                 [&](const Surfel* surfel, const ScanPoint&, const Eigen::Vector3d&, double, double, double, double) {
                   fit.exact += surfel != nullptr;
                   fit.near += surfel != nullptr || is_near(level.points[next]);
                   next += stride;
                 });
  return fit;
}

void ScanMatcher::add_error_sources(const PoseVector& pose, const ScanPoints& scan, const ReferenceMap& map,
                                    const PosePrior& prior, PoseCorrection& correction) const {
  if (map.sources.of_surfel.empty()) {
    correction.vector_by_source.resize(3, 0);
    return;
  }
  correction.vector_by_source.setZero(3, map.error_sources());
  // Independent errors that reproduce the covariance of the biases, one column each.
  const Eigen::Matrix<double, kLidars, kLidars> bias_errors = map.range_bias.covariance.llt().matrixL();
  const Surfel* first = map.surfaces.surfels().data();
  for_each_match(
      pose, scan, map, prior,
      [&](const Surfel* surfel, const ScanPoint& point, const Eigen::Vector3d& slope, double distance, double variance,
          double lasting, double along) {
        if (surfel) {
          const Eigen::Vector3d information_vector =
              parameters_.independent_share / variance / (1.0 + square(distance) / variance / square(kCauchy)) * slope;
          const auto source = map.sources.of_surfel[static_cast<std::size_t>(surfel - first)];
          correction.vector_by_source.col(source) += lasting * information_vector;
          correction.vector_by_source.rightCols<kLidars>() -= along * information_vector * bias_errors.row(point.lidar);
        }
      });
}

}  // namespace mtr_localization
