/// @file
/// Comparison of the adjustment with an independent Ceres implementation: same solution and same covariance.
// SPDX-License-Identifier: Apache-2.0
#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "adjustment/observations.hpp"
#include "adjustment/problem.hpp"
#include "extraction/surfel_builder.hpp"
#include "synthetic_loop.hpp"

namespace mtr_surfel_map {
namespace {

// The oracle uses the automatic derivatives, kernels, elimination and covariance of Ceres. It shares only the
// observations with the code under test. The figures below are repeated from residuals.cpp.
constexpr double kSurfaceKernel = 2.0;
constexpr double kMotionKernel = 3.0;
const Eigen::Vector3d kMinMotionSigma(0.0005, 0.0005, 0.0002);

// Tolerances: positions and their sigmas to a micrometre, scales and angles equally closely, covariances by ratio.
constexpr double kSameM = 1e-6;
constexpr double kSameShare = 1e-6;
constexpr double kSameCovariance = 1e-4;
// Each call of the solver under test linearises four times; its kernels converge gradually.
constexpr int kCalls = 60;

/// Distance of a view from its surface, in sigmas.
struct SurfaceCost {
  Observation seen;
  Surfel surfel;

  template <typename T>
  bool operator()(const T* pose, const T* bias, const T* change, T* residual) const {
    T lever[2];
    for (int axis = 0; axis < 2; ++axis) {
      lever[axis] = T(seen.position[axis]);
      for (int lidar = 0; lidar < kLidars; ++lidar) {
        lever[axis] -= T(seen.directions(axis, lidar)) * bias[lidar];
      }
    }
    using std::cos;
    using std::sin;
    const T x = cos(pose[2]) * lever[0] - sin(pose[2]) * lever[1] + pose[0] - T(surfel.position.x());
    const T y = sin(pose[2]) * lever[0] + cos(pose[2]) * lever[1] + pose[1] - T(surfel.position.y());
    const T distance = T(surfel.normal.x()) * x + T(surfel.normal.y()) * y - change[0];
    residual[0] = (distance - (T(surfel.lean) + change[1]) * T(seen.rise_m)) / T(seen.sigma_m);
    return true;
  }
};

/// Deviation of the motion between two poses from wheels and gyro, in sigmas.
struct MotionCost {
  KeyFrame frame;
  Eigen::Matrix3d whitening;

  template <typename T>
  bool operator()(const T* from, const T* to, const T* scales, T* residual) const {
    using std::atan2;
    using std::cos;
    using std::sin;
    const T dx = to[0] - from[0];
    const T dy = to[1] - from[1];
    const T turn = to[2] - from[2] - (T(1.0) + scales[1]) * T(frame.motion[2]);
    Eigen::Matrix<T, 3, 1> difference;
    difference << cos(from[2]) * dx + sin(from[2]) * dy - (T(1.0) + scales[0]) * T(frame.motion[0]),
        cos(from[2]) * dy - sin(from[2]) * dx - (T(1.0) + scales[0]) * T(frame.motion[1]), atan2(sin(turn), cos(turn));
    Eigen::Map<Eigen::Matrix<T, 3, 1>>(residual, 3) = whitening.cast<T>() * difference;
    return true;
  }
};

/// Prior of one number of a block.
template <int N>
struct PriorCost {
  int place;
  double mean;
  double sigma;

  template <typename T>
  bool operator()(const T* values, T* residual) const {
    residual[0] = (values[place] - T(mean)) / T(sigma);
    return true;
  }
};

template <int N>
ceres::CostFunction* prior(int place, double mean, double sigma) {
  return new ceres::AutoDiffCostFunction<PriorCost<N>, 1, N>(new PriorCost<N>{place, mean, sigma});
}

/// The same adjustment problem in Ceres.
class Oracle {
 public:
  Oracle(const Adjustment& start, const std::vector<Observation>& observations, const AdjustmentParameters& parameters)
      : surfels_(start.surfels.size()) {
    for (const KeyFrame& frame : start.key_frames) {
      poses_.push_back({frame.pose[0], frame.pose[1], frame.pose[2]});
    }
    std::copy_n(start.range_bias.value_m.data(), kLidars, bias_.begin());
    scales_ = {start.wheel_scale, start.gyro_scale};
    add_surfaces(start, observations);
    add_motions(start);
    for (int lidar = 0; lidar < kLidars; ++lidar) {
      problem_.AddResidualBlock(prior<kLidars>(lidar, 0.0, parameters.range_bias_sigma_m), nullptr, bias_.data());
    }
    problem_.AddResidualBlock(prior<2>(0, 0.0, parameters.wheel_scale_sigma), nullptr, scales_.data());
    problem_.AddResidualBlock(prior<2>(1, 0.0, parameters.gyro_scale_sigma), nullptr, scales_.data());
    problem_.SetParameterBlockConstant(poses_.front().data());
  }

  bool solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 500;
    options.function_tolerance = 1e-18;
    options.parameter_tolerance = 1e-14;
    options.gradient_tolerance = 1e-14;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  bool work_out_covariance() {
    std::vector<std::pair<const double*, const double*>> blocks{{bias_.data(), bias_.data()}};
    for (std::size_t i = 1; i < poses_.size(); ++i) {
      blocks.emplace_back(poses_[i].data(), poses_[i].data());
    }
    for (const auto& surfel : surfels_) {
      if (problem_.HasParameterBlock(surfel.data())) {
        blocks.emplace_back(surfel.data(), surfel.data());
      }
    }
    return covariance_.Compute(blocks, &problem_);
  }

  PoseVector pose(std::size_t i) const { return PoseVector(poses_[i].data()); }
  const std::array<double, kLidars>& bias_m() const { return bias_; }
  const std::array<double, 2>& scales() const { return scales_; }
  bool has_surfel(std::size_t i) const { return problem_.HasParameterBlock(surfels_[i].data()); }
  const std::array<double, 2>& surfel(std::size_t i) const { return surfels_[i]; }

  Eigen::Matrix3d pose_covariance(std::size_t i) const { return covariance_of<3>(poses_[i].data()); }
  Eigen::Matrix2d surfel_covariance(std::size_t i) const { return covariance_of<2>(surfels_[i].data()); }
  Eigen::Matrix2d bias_covariance() const { return covariance_of<kLidars>(bias_.data()); }

 private:
  void add_surfaces(const Adjustment& start, const std::vector<Observation>& observations) {
    for (const Observation& seen : observations) {
      const auto number = static_cast<std::size_t>(seen.surfel);
      auto* cost =
          new ceres::AutoDiffCostFunction<SurfaceCost, 1, 3, kLidars, 2>(new SurfaceCost{seen, start.surfels[number]});
      const bool is_first = !problem_.HasParameterBlock(surfels_[number].data());
      problem_.AddResidualBlock(cost, new ceres::CauchyLoss(kSurfaceKernel),
                                poses_[static_cast<std::size_t>(seen.key_frame)].data(), bias_.data(),
                                surfels_[number].data());
      if (is_first) {
        problem_.AddResidualBlock(prior<2>(1, -start.surfels[number].lean, kLeanSigma), nullptr,
                                  surfels_[number].data());
      }
    }
  }

  void add_motions(const Adjustment& start) {
    for (std::size_t i = 1; i < poses_.size(); ++i) {
      const KeyFrame& frame = start.key_frames[i];
      const Eigen::Matrix3d covariance =
          start.motion_factor * start.motion_factor *
          (frame.motion_covariance + Eigen::Matrix3d(kMinMotionSigma.cwiseAbs2().asDiagonal()));
      const Eigen::LLT<Eigen::Matrix3d> root(covariance);
      const Eigen::Matrix3d whitening = root.matrixL().solve(Eigen::Matrix3d::Identity());
      auto* cost = new ceres::AutoDiffCostFunction<MotionCost, 3, 3, 3, 2>(new MotionCost{frame, whitening});
      problem_.AddResidualBlock(cost, new ceres::HuberLoss(kMotionKernel), poses_[i - 1].data(), poses_[i].data(),
                                scales_.data());
    }
  }

  template <int N>
  Eigen::Matrix<double, N, N> covariance_of(const double* block) const {
    Eigen::Matrix<double, N, N, Eigen::RowMajor> found;
    EXPECT_TRUE(covariance_.GetCovarianceBlock(block, block, found.data()));
    return found;
  }

  // Blocks of unknowns; Ceres stores pointers to them. For each surfel: change of offset and lean from the start.
  std::vector<std::array<double, 3>> poses_;
  std::vector<std::array<double, 2>> surfels_;
  std::array<double, kLidars> bias_{};
  std::array<double, 2> scales_{};
  ceres::Problem problem_;
  ceres::Covariance covariance_{ceres::Covariance::Options{}};
};

class CeresOracleTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    synthetic::LoopOptions options;
    options.scene = GetParam();
    options.opposed_bias_m = 0.01;
    options.gyro_scale = 0.002;
    state_.key_frames = synthetic::drive(options).key_frames;
    // Vary the heights of the hits, so that leans are observable.
    for (std::size_t i = 0; i < state_.key_frames.size(); ++i) {
      for (ScanPoint& point : state_.key_frames[i].scan.points) {
        point.rise_m = 0.02 * std::sin(1.7 * static_cast<double>(i)) * point.range_m;
      }
    }
    state_.motion_factor = 1.3;
    state_.surfels = build_surfels(points_in_map(state_.key_frames, state_.range_bias), {0.8, 0.2, 0.06, {0.0, 0.0}});
    observations_ = observe(state_.key_frames, state_.range_bias, SurfelMap(state_.surfels), 0.15, parameters_);
  }

  /// Repeats the adjustment until it converges.
  void adjust() {
    ASSERT_GT(observations_.size(), 500U);
    ASSERT_GT(solve(state_, observations_, parameters_), 0.001) << "there is nothing to adjust";
    for (int call = 1; call < kCalls; ++call) {
      solve(state_, observations_, parameters_);
    }
  }

  AdjustmentParameters parameters_;
  Adjustment state_;
  std::vector<Observation> observations_;
};

TEST_P(CeresOracleTest, SolutionIsThatOfCeres) {
  Oracle oracle(state_, observations_, parameters_);
  const std::vector<Surfel> before = state_.surfels;
  ASSERT_NO_FATAL_FAILURE(adjust());
  ASSERT_TRUE(oracle.solve());
  for (std::size_t i = 0; i < state_.key_frames.size(); ++i) {
    EXPECT_LT((state_.key_frames[i].pose - oracle.pose(i)).head<2>().norm(), kSameM);
    EXPECT_NEAR(wrapped(state_.key_frames[i].pose[2] - oracle.pose(i)[2]), 0.0, kSameShare);
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Eigen::Vector2d moved = state_.surfels[i].position - before[i].position;
    EXPECT_NEAR(moved.dot(before[i].normal), oracle.surfel(i)[0], kSameM);
  }
  for (int lidar = 0; lidar < kLidars; ++lidar) {
    EXPECT_NEAR(state_.range_bias.value_m[lidar], oracle.bias_m()[static_cast<std::size_t>(lidar)], kSameM);
  }
  EXPECT_NEAR(state_.wheel_scale, oracle.scales()[0], kSameShare);
  EXPECT_NEAR(state_.gyro_scale, oracle.scales()[1], kSameShare);
}

TEST_P(CeresOracleTest, CovarianceIsThatOfCeres) {
  Oracle oracle(state_, observations_, parameters_);
  ASSERT_NO_FATAL_FAILURE(adjust());
  ASSERT_TRUE(oracle.solve() && oracle.work_out_covariance());
  const Uncertainty uncertainty = uncertainty_of(state_, observations_, parameters_);
  for (std::size_t i = 1; i < state_.key_frames.size(); ++i) {
    const Eigen::Matrix3d expected = oracle.pose_covariance(i);
    EXPECT_LT((uncertainty.poses[i] - expected).norm(), kSameCovariance * expected.norm());
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(std::sqrt(uncertainty.poses[i](axis, axis)), std::sqrt(expected(axis, axis)), kSameM);
    }
  }
  int compared = 0;
  for (std::size_t i = 0; i < state_.surfels.size(); ++i) {
    if (oracle.has_surfel(i)) {
      const Eigen::Matrix2d expected = oracle.surfel_covariance(i);
      EXPECT_NEAR(uncertainty.surfels_m[i], std::sqrt(expected(0, 0)), kSameM);
      EXPECT_NEAR(uncertainty.leans[i], std::sqrt(expected(1, 1)), kSameCovariance * kLeanSigma);
      ++compared;
    }
  }
  EXPECT_GT(compared, 30);
  const Eigen::Matrix2d bias = oracle.bias_covariance();
  EXPECT_LT((uncertainty.range_bias - bias).norm(), kSameCovariance * bias.norm());
}

INSTANTIATE_TEST_SUITE_P(Scenes, CeresOracleTest, testing::Values("open", "cones", "lot"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace mtr_surfel_map
