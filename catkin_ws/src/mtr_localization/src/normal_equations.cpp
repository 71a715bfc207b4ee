/// @file
/// Schur complement on the joint unknowns.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/normal_equations.hpp"

#include <Eigen/Cholesky>

namespace mtr_localization {
namespace {

// Information that holds a place to less than a nanometre, and leaves the equations well conditioned.
constexpr double kHeld = 1e14;

}  // namespace

NormalEquations::NormalEquations(Eigen::Index joint, Eigen::Index separate)
    : joint_(Eigen::MatrixXd::Zero(joint, joint)),
      across_(Eigen::MatrixXd::Zero(joint, separate)),
      own_(Eigen::VectorXd::Zero(separate)),
      joint_gradient_(Eigen::VectorXd::Zero(joint)),
      own_gradient_(Eigen::VectorXd::Zero(separate)) {}

void NormalEquations::hold(Eigen::Index place) { joint_(place, place) += kHeld; }

/// Of the separate unknowns as if the joint ones were known; 0 without any information.
Eigen::VectorXd NormalEquations::own_variances() const {
  return own_.unaryExpr([](double information) { return information > 0.0 ? 1.0 / information : 0.0; });
}

Eigen::MatrixXd NormalEquations::reduced_information() const {
  Eigen::MatrixXd reduced = joint_;
  // Eigen 3.4 divides by the number of columns.
  if (across_.cols() > 0) {
    const Eigen::MatrixXd scaled = across_ * own_variances().cwiseSqrt().asDiagonal();
    reduced.selfadjointView<Eigen::Lower>().rankUpdate(scaled, -1.0);
  }
  return reduced;
}

Step NormalEquations::solve() const {
  const Eigen::VectorXd variances = own_variances();
  const Eigen::VectorXd gradient = joint_gradient_ - across_ * variances.cwiseProduct(own_gradient_);
  Step step;
  step.joint = -reduced_information().llt().solve(gradient);
  step.separate = -variances.cwiseProduct(own_gradient_ + across_.transpose() * step.joint);
  return step;
}

Eigen::MatrixXd NormalEquations::joint_covariance() const {
  return reduced_information().llt().solve(Eigen::MatrixXd::Identity(joint_.rows(), joint_.cols()));
}

Eigen::VectorXd NormalEquations::separate_variances(const Eigen::MatrixXd& joint_covariance) const {
  const Eigen::VectorXd variances = own_variances();
  const Eigen::MatrixXd gain = across_ * variances.asDiagonal();
  return variances + (joint_covariance * gain).cwiseProduct(gain).colwise().sum().transpose();
}

}  // namespace mtr_localization
