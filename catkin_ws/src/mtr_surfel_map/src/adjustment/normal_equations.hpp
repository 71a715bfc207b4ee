/// @file
/// Least squares in which many unknowns meet only a few others.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace mtr_surfel_map {

/// M differences in sigmas, with their derivatives by N of the joint unknowns.
template <int M, int N>
struct Residual {
  Eigen::Matrix<double, M, 1> value;
  Eigen::Matrix<double, M, N> jacobian;
  std::array<Eigen::Index, N> places;
  /// Influence, below 1 for what is no longer believed.
  double weight = 1.0;
};

/// Changes of the unknowns; a column for each separate pair.
struct Step {
  Eigen::VectorXd joint;
  Eigen::Matrix2Xd separate;
};

/// Normal equations of residuals that each hold at most one of the separate pairs of unknowns. These are eliminated by
/// the Schur complement, so that the effort grows with the joint ones only.
class NormalEquations {
 public:
  NormalEquations(Eigen::Index joint, Eigen::Index separate);

  /// Adds a residual of joint unknowns.
  template <int M, int N>
  void add(const Residual<M, N>& residual) {
    const Eigen::Matrix<double, N, M> weighted = residual.weight * residual.jacobian.transpose();
    const Eigen::Matrix<double, N, N> information = weighted * residual.jacobian;
    const Eigen::Matrix<double, N, 1> gradient = weighted * residual.value;
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) {
        joint_(residual.places[i], residual.places[j]) += information(i, j);
      }
      joint_gradient_[residual.places[i]] += gradient[i];
    }
  }

  /// Adds a residual that also holds a separate pair, by which its derivatives are `by_separate`.
  template <int N>
  void add(const Residual<1, N>& residual, Eigen::Index separate, const Eigen::RowVector2d& by_separate) {
    add(residual);
    const Eigen::RowVector2d weighted = residual.weight * by_separate;
    for (int i = 0; i < N; ++i) {
      across_.block<1, 2>(residual.places[i], 2 * separate) += residual.jacobian[i] * weighted;
    }
    own_[static_cast<std::size_t>(separate)] += by_separate.transpose() * weighted;
    own_gradient_.col(separate) += residual.value[0] * weighted.transpose();
  }

  /// Adds what is known beforehand of the second one of a separate pair, as a value in sigmas.
  void add_prior(Eigen::Index separate, double value, double sigma);

  /// Fixes a joint unknown.
  void fix(Eigen::Index place);

  /// Change that makes the sum of squares least.
  Step solve() const;

  /// Covariance of the joint unknowns.
  Eigen::MatrixXd joint_covariance() const;
  /// Variances of the separate unknowns; 0 for pairs that no residual holds.
  Eigen::Matrix2Xd separate_variances(const Eigen::MatrixXd& joint_covariance) const;

 private:
  Eigen::Matrix2d own_covariance(Eigen::Index separate) const;
  Eigen::MatrixXd gain() const;
  Eigen::MatrixXd reduced_information() const;

  Eigen::MatrixXd joint_;
  Eigen::MatrixXd across_;
  std::vector<Eigen::Matrix2d> own_;
  Eigen::VectorXd joint_gradient_;
  Eigen::Matrix2Xd own_gradient_;
};

}  // namespace mtr_surfel_map
