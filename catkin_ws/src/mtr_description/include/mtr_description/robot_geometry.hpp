/// @file
/// The robot's geometry, read from its URDF, as Python's mtr_description.robot_geometry. No ROS.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <urdf_model/model.h>

#include <memory>
#include <string>

namespace mtr_description {

/// base_from_frame of a frame that does not move on the robot; roll, pitch and yaw about fixed axes x, y, z.
struct Mount {
  std::string frame;
  double x_m;
  double y_m;
  double z_m;
  double roll_rad;
  double pitch_rad;
  double yaw_rad;
};

/// A LiDAR whose mount is turned further sees ground and sky instead of what is around it: 2 degrees are 0.35 m at 10
/// m.
inline constexpr double kMaxTiltRad = 0.03490658503988659;

/// Throws ConfigurationError that says subject, value and what is allowed, unless low <= value <= high.
void check_value(const std::string& subject, double value, double low, double high, const std::string& unit);

/// Throws ConfigurationError unless the frame is upright and level.
void check_level(const Mount& mount);

/// Rectangle about base_link that holds the robot as it is seen from above, its key included.
struct Footprint {
  double front_m;
  /// Positive.
  double rear_m;
  /// From the middle line to what is farthest from it, on either side.
  double half_width_m;
};

/// The remote key on its lift.
struct KeyMount {
  /// Lever in base_link.
  double x_m;
  double y_m;
  /// Above ground, with the lift at its lower stop.
  double min_height_m;
  double lift_travel_m;

  double max_height_m() const;
};

/// The four wheels.
struct Wheels {
  /// Between the axles.
  double base_m;
  /// Between the middles of the left and the right wheels.
  double track_m;
  double radius_m;
  /// Of the axles in base_link.
  double axle_z_m;
};

/// In base_link.
struct CentreOfMass {
  double x_m;
  double y_m;
  /// Above ground.
  double height_m;
};

/// What a node needs to know of the robot's shape.
///
/// Each question throws mtr_core::ConfigurationError with one sentence when the URDF does not answer it: which value,
/// where, and what is allowed. What a node does not ask for may be missing.
class RobotGeometry {
 public:
  /// @param urdf_text value of the parameter robot_description
  explicit RobotGeometry(const std::string& urdf_text);

  /// Mount of a frame that hangs on base_link by fixed joints only.
  Mount mount(const std::string& frame) const;

  /// Bounds of everything that collides; neither a wheel's turn nor the lift changes them.
  Footprint footprint() const;

  /// The remote key, which hangs on a vertical lift.
  KeyMount key() const;

  /// The four wheels, which turn on base_link by continuous joints.
  Wheels wheels() const;

  /// Height of base_link above level ground.
  double base_height_m() const;

  /// With the lift raised so far from its lower stop.
  CentreOfMass centre_of_mass(double lift_m) const;

 private:
  std::shared_ptr<const urdf::ModelInterface> model_;
};

}  // namespace mtr_description
