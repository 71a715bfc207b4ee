/// @file
/// Traversal of a URDF.
// SPDX-License-Identifier: Apache-2.0
#include "urdf_tree.hpp"

#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <map>

#include "mtr_core/names.hpp"
#include "mtr_core/parameter.hpp"
#include "mtr_description/robot_geometry.hpp"

namespace mtr_description {
namespace {

namespace names = mtr_core::names;
using mtr_core::ConfigurationError;

constexpr std::size_t kWheelCount = 4;
// Tolerance of a vertical direction.
constexpr double kDirectionTolerance = 1e-6;

std::string list_of(const Joints& joints) {
  std::string list;
  for (const auto& joint : joints) {
    list += (list.empty() ? "" : ", ") + joint->name + " (" + type_of(*joint) + ")";
  }
  return list.empty() ? "none" : list;
}

}  // namespace

double rounded(double value_m) { return std::round(value_m * 1e9) / 1e9 + 0.0; }

std::string type_of(const urdf::Joint& joint) {
  static const std::map<int, std::string> kTypes{
      {urdf::Joint::FIXED, "fixed"},       {urdf::Joint::CONTINUOUS, "continuous"},
      {urdf::Joint::REVOLUTE, "revolute"}, {urdf::Joint::PRISMATIC, "prismatic"},
      {urdf::Joint::FLOATING, "floating"}, {urdf::Joint::PLANAR, "planar"}};
  const auto found = kTypes.find(joint.type);
  return found == kTypes.end() ? "unknown" : found->second;
}

std::shared_ptr<const urdf::ModelInterface> parsed(const std::string& urdf_text) {
  const std::shared_ptr<const urdf::ModelInterface> model = urdf::parseURDF(urdf_text);
  if (!model) {
    throw ConfigurationError("Parameter robot_description cannot be read; allowed is a URDF.");
  }
  const std::string root = model->getRoot()->name;
  if (root != names::kBase) {
    throw ConfigurationError("The root link of robot_description is " + root + "; allowed is " + names::kBase + ".");
  }
  return model;
}

Joints chain_to(const urdf::ModelInterface& model, const std::string& link) {
  urdf::LinkConstSharedPtr here = model.getLink(link);
  if (!here) {
    throw ConfigurationError("The robot_description has no link " + link + "; allowed are descriptions in which it " +
                             "hangs on " + names::kBase + ".");
  }
  Joints chain;
  while (here->parent_joint) {
    chain.insert(chain.begin(), here->parent_joint);
    here = model.getLink(here->parent_joint->parent_link_name);
  }
  return chain;
}

urdf::Vector3 at(const urdf::Pose& place, const urdf::Vector3& point) {
  return urdf::Vector3(place.position) + place.rotation * point;
}

urdf::Pose operator*(const urdf::Pose& a, const urdf::Pose& b) {
  urdf::Pose product;
  product.position = at(a, b.position);
  product.rotation = a.rotation * b.rotation;
  return product;
}

urdf::Pose place_of(const urdf::ModelInterface& model, const std::string& link) {
  urdf::Pose place;
  for (const auto& joint : chain_to(model, link)) {
    place = place * joint->parent_to_joint_origin_transform;
  }
  place.position = urdf::Vector3(rounded(place.position.x), rounded(place.position.y), rounded(place.position.z));
  return place;
}

Joints wheel_joints(const urdf::ModelInterface& model) {
  Joints wheels;
  for (const auto& entry : model.joints_) {
    if (entry.second->type == urdf::Joint::CONTINUOUS && entry.second->parent_link_name == names::kBase) {
      wheels.push_back(entry.second);
    }
  }
  if (wheels.size() != kWheelCount) {
    throw ConfigurationError("The robot_description has " + std::to_string(wheels.size()) + " continuous joints on " +
                             names::kBase + "; allowed is " + std::to_string(kWheelCount) + ", one for each wheel.");
  }
  return wheels;
}

urdf::JointConstSharedPtr lift_joint(const urdf::ModelInterface& model) {
  Joints moving;
  for (const auto& joint : chain_to(model, names::kKey)) {
    if (joint->type != urdf::Joint::FIXED) {
      moving.push_back(joint);
    }
  }
  if (moving.size() != 1 || moving[0]->type != urdf::Joint::PRISMATIC) {
    throw ConfigurationError(std::string("The moving joints between ") + names::kBase + " and " + names::kKey +
                             " in robot_description are " + list_of(moving) +
                             "; allowed is one prismatic joint, the lift.");
  }
  const auto& lift = moving[0];
  const double up = (place_of(model, lift->child_link_name).rotation * lift->axis).z;
  check_value("The upward part of the axis of joint " + lift->name, up, 1.0 - kDirectionTolerance,
              1.0 + kDirectionTolerance, "");
  check_value("The lower limit of joint " + lift->name, lift->limits ? lift->limits->lower : 0.0, 0.0, 0.0, "m");
  check_value("The upper limit of joint " + lift->name, lift->limits ? lift->limits->upper : 0.0, 0.01, 5.0, "m");
  return lift;
}

}  // namespace mtr_description
