/// @file
/// The adjustment's least squares in Ceres.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/adjustment_problem.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>

#include "mtr_localization/adjustment_residuals.hpp"
#include "mtr_localization/marginal_covariance.hpp"
#include "mtr_localization/se2.hpp"

namespace mtr_localization {
namespace {

// Differences in sigmas from which on a measurement loses influence.
constexpr double kSurfaceKernel = 2.0;
constexpr double kMotionKernel = 3.0;
// Of a motion without motion: swinging of the mast, steps of the encoders.
constexpr double kLeastMotionSigmaM = 0.0005;
constexpr double kLeastMotionSigmaRad = 0.0002;
constexpr int kMostIterations = 10;
// Relative change of the cost at which further steps move poses by less than a hundredth of a millimetre.
constexpr double kTolerance = 1e-6;
constexpr double kOutlierSigmas = 4.0;
// Median over sigma of the size of a normal distribution's values.
constexpr double kMedianOfNormal = 0.6745;

Eigen::Matrix3d whitening_of(const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d least(kLeastMotionSigmaM, kLeastMotionSigmaM, kLeastMotionSigmaRad);
  const Eigen::Matrix3d sum = covariance + Eigen::Matrix3d(least.cwiseAbs2().asDiagonal());
  return Eigen::Matrix3d(sum.llt().matrixL()).inverse();
}

/// The unknowns as numbers that Ceres can move, and the problem over them.
struct Problem {
  std::vector<PoseVector> poses;
  std::vector<double> offsets;
  double range_bias_m;
  double wheel_scale;
  ceres::CauchyLoss surface_loss{kSurfaceKernel};
  ceres::HuberLoss motion_loss{kMotionKernel};
  std::unique_ptr<ceres::Problem> ceres;
};

/// Poses whose headings run on without jumps of a full turn, so that their differences are turns.
std::vector<PoseVector> unrolled_poses(const std::vector<KeyFrame>& key_frames) {
  std::vector<PoseVector> poses;
  for (const KeyFrame& frame : key_frames) {
    poses.push_back(frame.pose);
    if (poses.size() > 1) {
      const double expected = poses[poses.size() - 2][2] + frame.motion[2];
      poses.back()[2] = expected + wrapped(frame.pose[2] - expected);
    }
  }
  return poses;
}

void add_prior(Problem& problem, double& value, double sigma) {
  problem.ceres->AddResidualBlock(new ceres::AutoDiffCostFunction<ZeroPrior, 1, 1>(new ZeroPrior{sigma}), nullptr,
                                  &value);
}

void add_residuals(Problem& problem, const Adjustment& state, const std::vector<Observation>& observations) {
  for (const Observation& seen : observations) {
    const Surfel& surfel = state.surfels[seen.surfel];
    problem.ceres->AddResidualBlock(new ceres::AutoDiffCostFunction<SurfaceResidual, 1, 3, 1, 1>(
                                        new SurfaceResidual{seen, surfel.position, surfel.normal}),
                                    &problem.surface_loss, problem.poses[seen.key_frame].data(),
                                    &problem.offsets[seen.surfel], &problem.range_bias_m);
  }
  for (std::size_t i = 1; i < problem.poses.size(); ++i) {
    const KeyFrame& frame = state.key_frames[i];
    problem.ceres->AddResidualBlock(new ceres::AutoDiffCostFunction<MotionResidual, 3, 3, 3, 1>(
                                        new MotionResidual{frame.motion, whitening_of(frame.motion_covariance)}),
                                    &problem.motion_loss, problem.poses[i - 1].data(), problem.poses[i].data(),
                                    &problem.wheel_scale);
  }
}

/// The addresses of the unknowns must not change: built in place.
void build(Problem& problem, const Adjustment& state, const std::vector<Observation>& observations,
           const AdjustmentParameters& parameters) {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem.ceres = std::make_unique<ceres::Problem>(options);
  problem.poses = unrolled_poses(state.key_frames);
  problem.offsets.assign(state.surfels.size(), 0.0);
  problem.range_bias_m = state.range_bias_m;
  problem.wheel_scale = state.wheel_scale;
  for (PoseVector& pose : problem.poses) {
    problem.ceres->AddParameterBlock(pose.data(), 3);
  }
  add_residuals(problem, state, observations);
  add_prior(problem, problem.range_bias_m, parameters.range_bias_sigma_m);
  add_prior(problem, problem.wheel_scale, parameters.wheel_scale_sigma);
  problem.ceres->SetParameterBlockConstant(problem.poses.front().data());
}

/// Poses after the first, range bias and wheel scale: the unknowns that depend on each other.
std::vector<double*> joint_unknowns(Problem& problem) {
  std::vector<double*> unknowns;
  for (std::size_t i = 1; i < problem.poses.size(); ++i) {
    unknowns.push_back(problem.poses[i].data());
  }
  unknowns.push_back(&problem.range_bias_m);
  unknowns.push_back(&problem.wheel_scale);
  return unknowns;
}

/// Offsets of the surfels that were seen.
std::vector<double*> separate_unknowns(Problem& problem) {
  std::vector<double*> unknowns;
  for (double& offset : problem.offsets) {
    if (problem.ceres->HasParameterBlock(&offset)) {
      unknowns.push_back(&offset);
    }
  }
  return unknowns;
}

ceres::Solver::Options solver_options(Problem& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  // The result must not depend on the machine.
  options.num_threads = 1;
  options.max_num_iterations = kMostIterations;
  options.function_tolerance = kTolerance;
  options.logging_type = ceres::SILENT;
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (double* unknown : separate_unknowns(problem)) {
    options.linear_solver_ordering->AddElementToGroup(unknown, 0);
  }
  for (double* unknown : joint_unknowns(problem)) {
    options.linear_solver_ordering->AddElementToGroup(unknown, 1);
  }
  options.linear_solver_ordering->AddElementToGroup(problem.poses.front().data(), 1);
  return options;
}

Eigen::SparseMatrix<double> jacobian_of(Problem& problem, const std::vector<double*>& unknowns) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = unknowns;
  ceres::CRSMatrix rows;
  problem.ceres->Evaluate(options, nullptr, nullptr, nullptr, &rows);
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(rows.num_rows, rows.num_cols, static_cast<Eigen::Index>(rows.values.size()),
                                    rows.rows.data(), rows.cols.data(), rows.values.data());
}

double root_mean_square(double sum, std::size_t count) {
  return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

double solve(Adjustment& state, const std::vector<Observation>& observations, const AdjustmentParameters& parameters) {
  Problem problem;
  build(problem, state, observations, parameters);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(problem), problem.ceres.get(), &summary);
  double largest_m = 0.0;
  for (std::size_t i = 0; i < state.key_frames.size(); ++i) {
    PoseVector& pose = state.key_frames[i].pose;
    largest_m = std::max(largest_m, (problem.poses[i] - pose).head<2>().norm());
    pose << problem.poses[i].head<2>(), wrapped(problem.poses[i][2]);
  }
  for (std::size_t i = 0; i < state.surfels.size(); ++i) {
    state.surfels[i].position += problem.offsets[i] * state.surfels[i].normal;
  }
  state.range_bias_m = problem.range_bias_m;
  state.wheel_scale = problem.wheel_scale;
  return largest_m;
}

Agreement agreement_of(const Adjustment& state, const std::vector<Observation>& observations) {
  std::vector<double> sizes;
  const double no_offset = 0.0;
  for (const Observation& seen : observations) {
    const Surfel& surfel = state.surfels[seen.surfel];
    double residual = 0.0;
    SurfaceResidual{seen, surfel.position, surfel.normal}(state.key_frames[seen.key_frame].pose.data(), &no_offset,
                                                          &state.range_bias_m, &residual);
    sizes.push_back(std::abs(residual));
  }
  Agreement agreement;
  if (!sizes.empty()) {
    const auto outliers = std::count_if(sizes.begin(), sizes.end(), [](double size) { return size > kOutlierSigmas; });
    agreement.outlier_share = static_cast<double>(outliers) / static_cast<double>(sizes.size());
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    agreement.surface_ratio = *middle / kMedianOfNormal;
  }
  const std::vector<PoseVector> poses = unrolled_poses(state.key_frames);
  double sum = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const KeyFrame& frame = state.key_frames[i];
    Eigen::Vector3d residual;
    MotionResidual{frame.motion, whitening_of(frame.motion_covariance)}(poses[i - 1].data(), poses[i].data(),
                                                                        &state.wheel_scale, residual.data());
    sum += residual.squaredNorm() / 3.0;
  }
  agreement.motion_ratio = root_mean_square(sum, poses.size() - 1);
  return agreement;
}

Uncertainty uncertainty_of(const Adjustment& state, const std::vector<Observation>& observations,
                           const AdjustmentParameters& parameters) {
  Problem problem;
  build(problem, state, observations, parameters);
  std::vector<double*> unknowns = joint_unknowns(problem);
  const Eigen::Index poses = 3 * (static_cast<Eigen::Index>(problem.poses.size()) - 1);
  const std::vector<double*> separate = separate_unknowns(problem);
  unknowns.insert(unknowns.end(), separate.begin(), separate.end());
  const Marginals marginals = marginals_of(jacobian_of(problem, unknowns), poses + 2);

  Uncertainty uncertainty;
  uncertainty.poses.push_back(Eigen::Matrix3d::Zero());
  for (Eigen::Index i = 0; i < poses; i += 3) {
    uncertainty.poses.emplace_back(marginals.joint.block<3, 3>(i, i));
  }
  uncertainty.range_bias_m = std::sqrt(marginals.joint(poses, poses));
  uncertainty.surfels_m.assign(state.surfels.size(), 0.0);
  for (std::size_t i = 0; i < separate.size(); ++i) {
    uncertainty.surfels_m[static_cast<std::size_t>(separate[i] - problem.offsets.data())] =
        std::sqrt(marginals.separate_variances[static_cast<Eigen::Index>(i)]);
  }
  return uncertainty;
}

}  // namespace mtr_localization
