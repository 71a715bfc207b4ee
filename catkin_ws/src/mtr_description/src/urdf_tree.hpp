/// @file
/// Links and joints of a URDF, as places in its root link.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <urdf_model/model.h>

#include <memory>
#include <string>
#include <vector>

namespace mtr_description {

using Joints = std::vector<urdf::JointConstSharedPtr>;

/// Rounds to a nanometre, to remove rounding errors of sums along a chain.
double rounded(double value_m);

/// Returns the type as written in a URDF.
std::string type_of(const urdf::Joint& joint);

/// Returns the model; throws ConfigurationError unless the text is a URDF with the root base_link.
std::shared_ptr<const urdf::ModelInterface> parsed(const std::string& urdf_text);

/// Returns the joints from the root to the link; throws ConfigurationError for an unknown link.
Joints chain_to(const urdf::ModelInterface& model, const std::string& link);

/// a_from_b * b_from_c.
urdf::Pose operator*(const urdf::Pose& a, const urdf::Pose& b);

/// Returns root_from_link with all joints at zero.
urdf::Pose place_of(const urdf::ModelInterface& model, const std::string& link);

/// Returns a point of the frame at that place in root coordinates.
urdf::Vector3 at(const urdf::Pose& place, const urdf::Vector3& point);

/// Returns the continuous joints on the root; throws ConfigurationError unless there are four.
Joints wheel_joints(const urdf::ModelInterface& model);

/// Returns the only joint that moves the key; throws ConfigurationError unless it is prismatic, vertical and starts at
/// 0.
urdf::JointConstSharedPtr lift_joint(const urdf::ModelInterface& model);

}  // namespace mtr_description
