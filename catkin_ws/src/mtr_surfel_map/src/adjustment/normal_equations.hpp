/// @file
/// Sparse least squares: many separate unknowns, each coupled to the few joint unknowns only.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace mtr_surfel_map {

/// M residuals in sigmas, with their derivatives with respect to N joint unknowns.
template <int M, int N>
struct Residual {
  Eigen::Matrix<double, M, 1> value;
  Eigen::Matrix<double, M, N> jacobian;
  std::array<Eigen::Index, N> places;
  /// Robust weight, below 1 for outliers.
  double weight = 1.0;
};

/// Update of the unknowns, with one column per separate pair.
struct Step {
  Eigen::VectorXd joint;
  Eigen::Matrix2Xd separate;
};

/// Normal equations of residuals that each depend on at most one separate pair of unknowns. The Schur complement
/// eliminates the pairs, so that the effort grows with the number of joint unknowns only.
class NormalEquations {
 public:
  NormalEquations(Eigen::Index joint, Eigen::Index separate);

  /// Adds a residual that depends on joint unknowns only.
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

  /// Adds a residual that also depends on a separate pair; `by_separate` holds the derivatives with respect to the
  /// pair.
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

  /// Adds a prior with mean 0 for the second unknown of a separate pair; `value` is its current value.
  void add_prior(Eigen::Index separate, double value, double sigma);

  /// Fixes a joint unknown at its current value.
  void fix(Eigen::Index place);

  /// Returns the update that minimises the sum of squares.
  Step solve() const;

  /// Returns the covariance of the joint unknowns.
  Eigen::MatrixXd joint_covariance() const;
  /// Returns the variances of the separate unknowns, or 0 for pairs without a residual.
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
