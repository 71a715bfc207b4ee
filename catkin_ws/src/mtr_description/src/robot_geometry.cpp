/// @file
/// Queries of the robot's URDF.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_description/robot_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "mtr_core/names.hpp"
#include "mtr_core/parameter.hpp"
#include "urdf_tree.hpp"

namespace mtr_description {
namespace {

namespace names = mtr_core::names;
using mtr_core::ConfigurationError;

// Tolerance of URDF numbers that must be equal.
constexpr double kToleranceM = 1e-6;

/// Extent in x and y about a shape's centre.
struct Extent {
  double x_m;
  double y_m;
};

/// Returns half the extent of a box, a cylinder or a sphere along the root's x and y.
Extent half_extent(const std::string& link, const urdf::Geometry& geometry, const urdf::Rotation& rotation) {
  const urdf::Vector3 x = rotation * urdf::Vector3(1.0, 0.0, 0.0);
  const urdf::Vector3 y = rotation * urdf::Vector3(0.0, 1.0, 0.0);
  const urdf::Vector3 z = rotation * urdf::Vector3(0.0, 0.0, 1.0);
  if (geometry.type == urdf::Geometry::BOX) {
    const urdf::Vector3& side = static_cast<const urdf::Box&>(geometry).dim;
    return {0.5 * (std::abs(x.x) * side.x + std::abs(y.x) * side.y + std::abs(z.x) * side.z),
            0.5 * (std::abs(x.y) * side.x + std::abs(y.y) * side.y + std::abs(z.y) * side.z)};
  }
  if (geometry.type == urdf::Geometry::CYLINDER) {
    const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
    const auto along = [&cylinder](double part) {
      return 0.5 * cylinder.length * std::abs(part) + cylinder.radius * std::sqrt(std::max(0.0, 1.0 - part * part));
    };
    return {along(z.x), along(z.y)};
  }
  if (geometry.type == urdf::Geometry::SPHERE) {
    const double radius = static_cast<const urdf::Sphere&>(geometry).radius;
    return {radius, radius};
  }
  throw ConfigurationError("The collision geometry of " + link +
                           " in robot_description is a mesh; allowed are box, cylinder and sphere.");
}

void check_moving_joints(const urdf::ModelInterface& model) {
  std::set<std::string> known{lift_joint(model)->name};
  for (const auto& wheel : wheel_joints(model)) {
    known.insert(wheel->name);
  }
  for (const auto& entry : model.joints_) {
    if (entry.second->type != urdf::Joint::FIXED && known.count(entry.first) == 0) {
      throw ConfigurationError("The joint " + entry.first + " in robot_description is " + type_of(*entry.second) +
                               "; allowed are fixed joints, the wheels' and the lift's.");
    }
  }
}

double wheel_radius(const urdf::Link& link) {
  std::vector<double> radii;
  for (const auto& collision : link.collision_array) {
    if (collision->geometry->type == urdf::Geometry::CYLINDER) {
      radii.push_back(static_cast<const urdf::Cylinder&>(*collision->geometry).radius);
    }
  }
  if (radii.size() != 1) {
    throw ConfigurationError("The collision geometry of " + link.name + " in robot_description has " +
                             std::to_string(radii.size()) + " cylinders; allowed is one, the tyre.");
  }
  return radii[0];
}

bool is_on(const urdf::ModelInterface& model, const std::string& link, const urdf::JointConstSharedPtr& joint) {
  const Joints chain = chain_to(model, link);
  return std::find(chain.begin(), chain.end(), joint) != chain.end();
}

}  // namespace

void check_value(const std::string& subject, double value, double low, double high, const std::string& unit) {
  if (!(value >= low && value <= high)) {
    throw ConfigurationError(subject + " in robot_description is " + mtr_core::with_unit(value, unit) +
                             "; allowed is " + mtr_core::range_text(low, high, unit) + ".");
  }
}

void check_level(const Mount& mount) {
  check_value("The roll of " + mount.frame, mount.roll_rad, -kMaxTiltRad, kMaxTiltRad, "rad");
  check_value("The pitch of " + mount.frame, mount.pitch_rad, -kMaxTiltRad, kMaxTiltRad, "rad");
}

double KeyMount::max_height_m() const { return rounded(min_height_m + lift_travel_m); }

RobotGeometry::RobotGeometry(const std::string& urdf_text) : model_(parsed(urdf_text)) {}

Mount RobotGeometry::mount(const std::string& frame) const {
  for (const auto& joint : chain_to(*model_, frame)) {
    if (joint->type != urdf::Joint::FIXED) {
      throw ConfigurationError("The joint " + joint->name + " between " + names::kBase + " and " + frame +
                               " in robot_description is " + type_of(*joint) + "; allowed is fixed.");
    }
  }
  const urdf::Pose place = place_of(*model_, frame);
  Mount mount{frame, place.position.x, place.position.y, place.position.z, 0.0, 0.0, 0.0};
  place.rotation.getRPY(mount.roll_rad, mount.pitch_rad, mount.yaw_rad);
  return mount;
}

Footprint RobotGeometry::footprint() const {
  check_moving_joints(*model_);
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  Footprint footprint{kNone, kNone, kNone};
  for (const auto& entry : model_->links_) {
    for (const auto& collision : entry.second->collision_array) {
      const urdf::Pose place = place_of(*model_, entry.first) * collision->origin;
      const Extent half = half_extent(entry.first, *collision->geometry, place.rotation);
      footprint.front_m = std::max(footprint.front_m, rounded(place.position.x + half.x_m));
      footprint.rear_m = std::max(footprint.rear_m, rounded(half.x_m - place.position.x));
      footprint.half_width_m = std::max(footprint.half_width_m, rounded(std::abs(place.position.y) + half.y_m));
    }
  }
  if (footprint.front_m == kNone) {
    throw ConfigurationError(
        "The robot_description has no collision geometry; allowed are descriptions that say with which boxes, "
        "cylinders "
        "and spheres the robot collides.");
  }
  return footprint;
}

KeyMount RobotGeometry::key() const {
  const urdf::JointConstSharedPtr lift = lift_joint(*model_);
  const urdf::Vector3 position = place_of(*model_, names::kKey).position;
  return {position.x, position.y, rounded(position.z + base_height_m()), lift->limits->upper};
}

Wheels RobotGeometry::wheels() const {
  const Joints joints = wheel_joints(*model_);
  const urdf::Vector3 first = place_of(*model_, joints[0]->child_link_name).position;
  const double radius = wheel_radius(*model_->getLink(joints[0]->child_link_name));
  urdf::Vector3 low = first;
  urdf::Vector3 high = first;
  for (const auto& joint : joints) {
    const std::string& link = joint->child_link_name;
    const urdf::Vector3 place = place_of(*model_, link).position;
    check_value("The radius of " + link, wheel_radius(*model_->getLink(link)), radius - kToleranceM,
                radius + kToleranceM, "m");
    check_value("The height of " + link, place.z, first.z - kToleranceM, first.z + kToleranceM, "m");
    low = {std::min(low.x, place.x), std::min(low.y, place.y), low.z};
    high = {std::max(high.x, place.x), std::max(high.y, place.y), high.z};
  }
  return {high.x - low.x, high.y - low.y, radius, first.z};
}

double RobotGeometry::base_height_m() const {
  const Wheels all = wheels();
  return rounded(all.radius_m - all.axle_z_m);
}

CentreOfMass RobotGeometry::centre_of_mass(double lift_m) const {
  const urdf::JointConstSharedPtr lift = lift_joint(*model_);
  double mass_kg = 0.0;
  urdf::Vector3 moment;
  for (const auto& entry : model_->links_) {
    const auto& inertial = entry.second->inertial;
    if (inertial) {
      const urdf::Vector3 centre = at(place_of(*model_, entry.first), inertial->origin.position);
      const double raised_m = is_on(*model_, entry.first, lift) ? lift_m : 0.0;
      mass_kg += inertial->mass;
      moment = moment + urdf::Vector3(inertial->mass * centre.x, inertial->mass * centre.y,
                                      inertial->mass * (centre.z + raised_m));
    }
  }
  check_value("The robot's mass", mass_kg, 1.0, 1000.0, "kg");
  return {moment.x / mass_kg, moment.y / mass_kg, moment.z / mass_kg + base_height_m()};
}

}  // namespace mtr_description
