/// @file
/// Schur complement on the joint unknowns.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/marginal_covariance.hpp"

#include <Eigen/Cholesky>

namespace mtr_localization {

Marginals marginals_of(const Eigen::SparseMatrix<double>& jacobian, Eigen::Index joint) {
  using Sparse = Eigen::SparseMatrix<double>;
  const Eigen::Index separate = jacobian.cols() - joint;
  const Sparse of_joint = jacobian.leftCols(joint);
  const Sparse of_separate = jacobian.rightCols(separate);
  // Information of the separate unknowns is diagonal: each residual holds one of them.
  Eigen::VectorXd own(separate);
  for (Eigen::Index i = 0; i < separate; ++i) {
    own[i] = of_separate.col(i).squaredNorm();
  }
  const Sparse across = of_joint.transpose() * of_separate;
  const Sparse through = across * own.cwiseInverse().asDiagonal();
  const Sparse lost = through * Sparse(across.transpose());
  const Eigen::MatrixXd information = Eigen::MatrixXd(Sparse(of_joint.transpose() * of_joint) - lost);

  Marginals marginals;
  marginals.joint = information.llt().solve(Eigen::MatrixXd::Identity(joint, joint));
  marginals.separate_variances.resize(separate);
  for (Eigen::Index i = 0; i < separate; ++i) {
    double variance = 1.0 / own[i];
    for (Sparse::InnerIterator a(through, i); a; ++a) {
      for (Sparse::InnerIterator b(through, i); b; ++b) {
        variance += a.value() * b.value() * marginals.joint(a.row(), b.row());
      }
    }
    marginals.separate_variances[i] = variance;
  }
  return marginals;
}

}  // namespace mtr_localization
