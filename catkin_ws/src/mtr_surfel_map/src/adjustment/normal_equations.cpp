/// @file
/// Schur complement onto the joint unknowns.
// SPDX-License-Identifier: Apache-2.0
#include "adjustment/normal_equations.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace mtr_surfel_map {
namespace {

// Information that fixes an unknown to less than a nanometre and keeps the equations well conditioned.
constexpr double kFixed = 1e14;

}  // namespace

NormalEquations::NormalEquations(Eigen::Index joint, Eigen::Index separate)
    : joint_(Eigen::MatrixXd::Zero(joint, joint)),
      across_(Eigen::MatrixXd::Zero(joint, 2 * separate)),
      own_(static_cast<std::size_t>(separate), Eigen::Matrix2d::Zero()),
      joint_gradient_(Eigen::VectorXd::Zero(joint)),
      own_gradient_(Eigen::Matrix2Xd::Zero(2, separate)) {}

void NormalEquations::add_prior(Eigen::Index separate, double value, double sigma) {
  own_[static_cast<std::size_t>(separate)](1, 1) += 1.0 / (sigma * sigma);
  own_gradient_(1, separate) += value / (sigma * sigma);
}

void NormalEquations::fix(Eigen::Index place) { joint_(place, place) += kFixed; }

/// Returns the covariance of a separate pair for known joint unknowns, or 0 without any information.
Eigen::Matrix2d NormalEquations::own_covariance(Eigen::Index separate) const {
  const Eigen::Matrix2d& information = own_[static_cast<std::size_t>(separate)];
  return information.determinant() > 0.0 ? Eigen::Matrix2d(information.inverse()) : Eigen::Matrix2d::Zero();
}

/// Returns the gain that maps gradients of the separate unknowns to the joint ones in the Schur complement.
Eigen::MatrixXd NormalEquations::gain() const {
  Eigen::MatrixXd gain(across_.rows(), across_.cols());
  for (Eigen::Index i = 0; i < own_gradient_.cols(); ++i) {
    gain.middleCols<2>(2 * i).noalias() = across_.middleCols<2>(2 * i) * own_covariance(i);
  }
  return gain;
}

Eigen::MatrixXd NormalEquations::reduced_information() const {
  Eigen::MatrixXd reduced = joint_;
  // Eigen 3.4 divides by the number of columns in rankUpdate().
  if (across_.cols() > 0) {
    Eigen::MatrixXd scaled(across_.rows(), across_.cols());
    for (Eigen::Index i = 0; i < own_gradient_.cols(); ++i) {
      const Eigen::Matrix2d root = own_covariance(i).llt().matrixL();
      scaled.middleCols<2>(2 * i).noalias() = across_.middleCols<2>(2 * i) * root;
    }
    reduced.selfadjointView<Eigen::Lower>().rankUpdate(scaled, -1.0);
  }
  return reduced;
}

Step NormalEquations::solve() const {
  const Eigen::Map<const Eigen::VectorXd> own_gradient(own_gradient_.data(), own_gradient_.size());
  Step step;
  step.joint = -reduced_information().llt().solve(joint_gradient_ - gain() * own_gradient);
  step.separate.resize(2, own_gradient_.cols());
  for (Eigen::Index i = 0; i < own_gradient_.cols(); ++i) {
    step.separate.col(i) =
        -own_covariance(i) * (own_gradient_.col(i) + across_.middleCols<2>(2 * i).transpose() * step.joint);
  }
  return step;
}

Eigen::MatrixXd NormalEquations::joint_covariance() const {
  return reduced_information().llt().solve(Eigen::MatrixXd::Identity(joint_.rows(), joint_.cols()));
}

Eigen::Matrix2Xd NormalEquations::separate_variances(const Eigen::MatrixXd& joint_covariance) const {
  const Eigen::MatrixXd gains = gain();
  const Eigen::RowVectorXd by_joint = (joint_covariance * gains).cwiseProduct(gains).colwise().sum();
  Eigen::Matrix2Xd variances = Eigen::Map<const Eigen::Matrix2Xd>(by_joint.data(), 2, own_gradient_.cols());
  for (Eigen::Index i = 0; i < own_gradient_.cols(); ++i) {
    variances.col(i) += own_covariance(i).diagonal();
  }
  return variances;
}

}  // namespace mtr_surfel_map
