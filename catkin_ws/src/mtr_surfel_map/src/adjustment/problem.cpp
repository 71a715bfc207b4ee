/// @file
/// Gauss-Newton steps of the adjustment.
// SPDX-License-Identifier: Apache-2.0
#include "adjustment/problem.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_surfel_map/se2.hpp"

namespace mtr_surfel_map {
namespace {

constexpr int kMaxSteps = 4;
// Iteration ends when no pose moves by more than this: the next association changes more than another step.
constexpr double kSettledM = 0.0001;
constexpr double kOutlierSigmas = 4.0;
// Wheels and gyro exclude a motion with a larger residual, even when they slip. In sigmas of the key frames.
constexpr double kExcludedSigmas = 10.0;
// Median absolute value of a standard normal distribution.
constexpr double kMedianOfNormal = 0.6745;

Residual<1, 1> prior(double value, double sigma, Eigen::Index place) {
  Residual<1, 1> residual;
  residual.value[0] = value / sigma;
  residual.jacobian[0] = 1.0 / sigma;
  residual.places = {place};
  return residual;
}

NormalEquations equations_of(const Adjustment& state, const std::vector<Observation>& observations,
                             const AdjustmentParameters& parameters) {
  const Layout layout = layout_of(state);
  NormalEquations equations(layout.size(), static_cast<Eigen::Index>(state.surfels.size()));
  for (const Observation& seen : observations) {
    equations.add(surface_residual(state, seen), seen.surfel, Eigen::RowVector2d(-1.0, -seen.rise_m) / seen.sigma_m);
  }
  for (std::size_t i = 0; i < state.surfels.size(); ++i) {
    equations.add_prior(static_cast<Eigen::Index>(i), state.surfels[i].lean, kLeanSigma);
  }
  for (std::size_t i = 1; i < state.key_frames.size(); ++i) {
    equations.add(motion_residual(state, i));
  }
  for (int lidar = 0; lidar < kLidars; ++lidar) {
    equations.add(prior(state.range_bias.value_m[lidar], parameters.range_bias_sigma_m, layout.range_bias() + lidar));
  }
  equations.add(prior(state.wheel_scale, parameters.wheel_scale_sigma, layout.wheel_scale()));
  equations.add(prior(state.gyro_scale, parameters.gyro_scale_sigma, layout.gyro_scale()));
  for (const Eigen::Index place : {0, 1, 2}) {
    equations.fix(Layout::pose(0) + place);
  }
  return equations;
}

/// Applies a step and returns the largest position change of a pose.
double take(const Step& step, Adjustment& state) {
  const Layout layout = layout_of(state);
  double max_m = 0.0;
  for (std::size_t i = 1; i < state.key_frames.size(); ++i) {
    PoseVector& pose = state.key_frames[i].pose;
    const Eigen::Vector3d change = step.joint.segment<3>(Layout::pose(static_cast<Eigen::Index>(i)));
    pose += change;
    pose[2] = wrapped(pose[2]);
    max_m = std::max(max_m, change.head<2>().norm());
  }
  for (std::size_t i = 0; i < state.surfels.size(); ++i) {
    const Eigen::Vector2d change = step.separate.col(static_cast<Eigen::Index>(i));
    state.surfels[i].position += change[0] * state.surfels[i].normal;
    state.surfels[i].lean += change[1];
  }
  state.range_bias.value_m += step.joint.segment<kLidars>(layout.range_bias());
  state.wheel_scale += step.joint[layout.wheel_scale()];
  state.gyro_scale += step.joint[layout.gyro_scale()];
  return max_m;
}

/// Returns the jump between a key frame and its predecessor, or zero if wheels and gyro do not exclude the motion.
Jump jump_to(const Adjustment& state, std::size_t key_frame, double size_in_sigmas) {
  if (size_in_sigmas < kExcludedSigmas) {
    return {};
  }
  const KeyFrame& frame = state.key_frames[key_frame];
  const PoseVector between = relative(state.key_frames[key_frame - 1].pose, frame.pose);
  return {(between.head<2>() - (1.0 + state.wheel_scale) * frame.motion.head<2>()).norm(),
          std::abs(wrapped(between[2] - (1.0 + state.gyro_scale) * frame.motion[2]))};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double solve(Adjustment& state, const std::vector<Observation>& observations, const AdjustmentParameters& parameters) {
  double max_m = 0.0;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double moved_m = take(equations_of(state, observations, parameters).solve(), state);
    max_m = std::max(max_m, moved_m);
    if (moved_m < kSettledM) {
      break;
    }
  }
  return max_m;
}

Fit fit_of(const Adjustment& state, const std::vector<Observation>& observations) {
  Fit fit;
  std::vector<double> sizes;
  sizes.reserve(observations.size());
  for (const Observation& seen : observations) {
    sizes.push_back(std::abs(surface_residual(state, seen).value[0]));
  }
  if (!sizes.empty()) {
    const auto outliers = std::count_if(sizes.begin(), sizes.end(), [](double size) { return size > kOutlierSigmas; });
    fit.outlier_share = static_cast<double>(outliers) / static_cast<double>(sizes.size());
    fit.surface_ratio = median(sizes) / kMedianOfNormal;
  }
  double sum = 0.0;
  for (std::size_t i = 1; i < state.key_frames.size(); ++i) {
    const double square = motion_residual(state, i).value.squaredNorm();
    const Jump jump = jump_to(state, i, state.motion_factor * std::sqrt(square));
    fit.jump.distance_m = std::max(fit.jump.distance_m, jump.distance_m);
    fit.jump.angle_rad = std::max(fit.jump.angle_rad, jump.angle_rad);
    sum += square / 3.0;
  }
  if (state.key_frames.size() > 1) {
    fit.motion_ratio = state.motion_factor * std::sqrt(sum / static_cast<double>(state.key_frames.size() - 1));
  }
  return fit;
}

Uncertainty uncertainty_of(const Adjustment& state, const std::vector<Observation>& observations,
                           const AdjustmentParameters& parameters) {
  const Layout layout = layout_of(state);
  const NormalEquations equations = equations_of(state, observations, parameters);
  const Eigen::MatrixXd joint = equations.joint_covariance();
  const Eigen::Matrix2Xd surfels = equations.separate_variances(joint).cwiseSqrt();
  Uncertainty uncertainty;
  for (std::size_t i = 0; i < state.key_frames.size(); ++i) {
    const Eigen::Index place = Layout::pose(static_cast<Eigen::Index>(i));
    uncertainty.poses.emplace_back(joint.block<3, 3>(place, place));
  }
  for (Eigen::Index i = 0; i < surfels.cols(); ++i) {
    uncertainty.surfels_m.push_back(surfels(0, i));
    uncertainty.leans.push_back(surfels(1, i));
  }
  uncertainty.range_bias = joint.block<kLidars, kLidars>(layout.range_bias(), layout.range_bias());
  return uncertainty;
}

}  // namespace mtr_surfel_map
