/// @file
/// Comparison of normal equations and residuals with dense linear algebra and finite differences.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "adjustment/normal_equations.hpp"
#include "adjustment/residuals.hpp"

namespace mtr_surfel_map {
namespace {

constexpr Eigen::Index kJoint = 6;
constexpr Eigen::Index kSeparate = 5;
constexpr Eigen::Index kUnknowns = kJoint + 2 * kSeparate;

/// Random residuals as sparse equations and as one dense system.
struct RandomSystem {
  RandomSystem() {
    std::srand(4);
    for (int i = 0; i < 60; ++i) {
      Residual<1, 4> residual;
      residual.value.setRandom();
      residual.jacobian.setRandom();
      residual.places = {i % 3, 3, 4, 5};
      residual.weight = 0.3 + 0.01 * i;
      const Eigen::Index separate = i % 4;
      const Eigen::RowVector2d by_separate(-2.0, 0.1 * (i % 7));
      equations.add(residual, separate, by_separate);
      Eigen::VectorXd row = Eigen::VectorXd::Zero(kUnknowns);
      for (int j = 0; j < 4; ++j) {
        row[residual.places[static_cast<std::size_t>(j)]] += residual.jacobian[j];
      }
      row.segment<2>(kJoint + 2 * separate) = by_separate.transpose();
      information += residual.weight * row * row.transpose();
      gradient += residual.weight * row * residual.value[0];
    }
    for (Eigen::Index separate = 0; separate < kSeparate; ++separate) {
      equations.add_prior(separate, 0.3, 0.5);
      information(kJoint + 2 * separate + 1, kJoint + 2 * separate + 1) += 4.0;
      gradient[kJoint + 2 * separate + 1] += 0.3 * 4.0;
    }
  }

  NormalEquations equations{kJoint, kSeparate};
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(kUnknowns);
};

/// All unknowns except the last separate pair, which has no residual.
constexpr Eigen::Index kFixed = kUnknowns - 2;

/// Returns the separate pairs as one vector, without the last pair.
Eigen::VectorXd fixed(const Eigen::Matrix2Xd& separate) {
  return Eigen::Map<const Eigen::VectorXd>(separate.data(), kFixed - kJoint);
}

TEST(NormalEquations, StepIsThatOfTheWholeSystem) {
  const RandomSystem system;
  const Step step = system.equations.solve();
  const Eigen::VectorXd whole =
      -system.information.topLeftCorner(kFixed, kFixed).inverse() * system.gradient.head(kFixed);
  EXPECT_TRUE(step.joint.isApprox(whole.head(kJoint), 1e-9));
  EXPECT_TRUE(fixed(step.separate).isApprox(whole.tail(kFixed - kJoint), 1e-9));
  EXPECT_EQ(step.separate.col(kSeparate - 1).norm(), 0.0);
}

TEST(NormalEquations, VariancesAreThoseOfTheWholeSystem) {
  const RandomSystem system;
  const Eigen::MatrixXd whole = system.information.topLeftCorner(kFixed, kFixed).inverse();
  const Eigen::MatrixXd joint = system.equations.joint_covariance();
  EXPECT_TRUE(joint.isApprox(whole.topLeftCorner(kJoint, kJoint), 1e-9));
  const Eigen::Matrix2Xd separate = system.equations.separate_variances(joint);
  EXPECT_TRUE(fixed(separate).isApprox(whole.diagonal().tail(kFixed - kJoint), 1e-9));
}

TEST(NormalEquations, HeldUnknownDoesNotMove) {
  RandomSystem system;
  system.equations.fix(3);
  EXPECT_LT(std::abs(system.equations.solve().joint[3]), 1e-9);
}

Adjustment some_state() {
  Adjustment state;
  state.key_frames.resize(2);
  state.key_frames[0].pose = {1.0, 2.0, 3.1};
  state.key_frames[1].pose = {0.6, 2.3, -3.0};
  state.key_frames[1].motion = {0.5, -0.1, 0.2};
  state.key_frames[1].motion_covariance << 4e-4, 1e-4, 0.0, 1e-4, 5e-4, 1e-5, 0.0, 1e-5, 1e-4;
  state.surfels.push_back({{3.0, 1.0}, Eigen::Vector2d(-0.6, 0.8), 0.3, 0.0, 10});
  state.range_bias.value_m << 0.02, -0.01;
  state.wheel_scale = 0.004;
  state.gyro_scale = -0.003;
  return state;
}

/// Returns the state with one joint unknown changed.
Adjustment changed(Adjustment state, Eigen::Index place, double change) {
  const Layout layout = layout_of(state);
  if (place >= layout.range_bias() && place < layout.range_bias() + kLidars) {
    state.range_bias.value_m[place - layout.range_bias()] += change;
  } else if (place == layout.wheel_scale()) {
    state.wheel_scale += change;
  } else if (place == layout.gyro_scale()) {
    state.gyro_scale += change;
  } else {
    state.key_frames[static_cast<std::size_t>(place / 3)].pose[place % 3] += change;
  }
  return state;
}

constexpr double kStep = 1e-6;

TEST(AdjustmentResiduals, DerivativesOfAViewAreItsDifferences) {
  const Adjustment state = some_state();
  Observation seen{1, 0, {-2.2, 1.9}, {}, 0.005, 4};
  // Two thirds of the beams belong to the front LiDAR.
  seen.directions << -0.53, -0.3, 0.4, 0.1;
  const Residual<1, 3 + kLidars> residual = surface_residual(state, seen);
  for (std::size_t i = 0; i < residual.places.size(); ++i) {
    const Adjustment moved = changed(state, residual.places[i], kStep);
    const double difference = (surface_residual(moved, seen).value[0] - residual.value[0]) / kStep;
    EXPECT_NEAR(residual.jacobian[static_cast<Eigen::Index>(i)], difference, 2e-3) << i;
  }
}

TEST(AdjustmentResiduals, DerivativesOfAMotionAreItsDifferences) {
  const Adjustment state = some_state();
  const Residual<3, 8> residual = motion_residual(state, 1);
  for (std::size_t i = 0; i < 8; ++i) {
    const Adjustment moved = changed(state, residual.places[i], kStep);
    const Eigen::Vector3d difference = (motion_residual(moved, 1).value - residual.value) / kStep;
    EXPECT_TRUE(residual.jacobian.col(static_cast<Eigen::Index>(i)).isApprox(difference, 1e-3) ||
                difference.norm() < 1e-6)
        << i;
  }
}

}  // namespace
}  // namespace mtr_surfel_map
