/// @file
/// Covariance of least squares in which most unknowns meet only a few others.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace mtr_localization {

/// Uncertainty of unknowns that depend on each other, and of those that do so only through the former.
struct Marginals {
  Eigen::MatrixXd joint;
  Eigen::VectorXd separate_variances;
};

/// Marginal covariances of the unknowns of a Jacobian whose residuals have sigma 1: of its first `joint` columns, and
/// of each other column. No residual may hold two of the latter.
Marginals marginals_of(const Eigen::SparseMatrix<double>& jacobian, Eigen::Index joint);

}  // namespace mtr_localization
