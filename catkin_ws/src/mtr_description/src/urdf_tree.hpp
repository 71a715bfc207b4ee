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

/// To a nanometre, so that the sum of a chain's numbers is the number that a person would write.
double rounded(double value_m);

/// The type as a URDF writes it.
std::string type_of(const urdf::Joint& joint);

/// Throws ConfigurationError unless the text is a URDF with the root base_link.
std::shared_ptr<const urdf::ModelInterface> parsed(const std::string& urdf_text);

/// Joints from the root to the link; throws ConfigurationError when there is no such link.
Joints chain_to(const urdf::ModelInterface& model, const std::string& link);

/// a_from_b * b_from_c.
urdf::Pose operator*(const urdf::Pose& a, const urdf::Pose& b);

/// root_from_link with all joints at zero.
urdf::Pose place_of(const urdf::ModelInterface& model, const std::string& link);

/// Coordinates in the root of a point in the frame at that place.
urdf::Vector3 at(const urdf::Pose& place, const urdf::Vector3& point);

/// Continuous joints on the root; throws ConfigurationError unless there are four.
Joints wheel_joints(const urdf::ModelInterface& model);

/// The one joint that moves the key; throws ConfigurationError unless it is prismatic, vertical and starts at zero.
urdf::JointConstSharedPtr lift_joint(const urdf::ModelInterface& model);

}  // namespace mtr_description
