/// @file
/// Geometry of the robot from its URDF, equivalent to Python's mtr_description.robot_geometry. No ROS.
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

/// Largest tilt of a LiDAR mount; with more, it would see ground and sky: 2 degrees are 0.35 m at 10 m.
inline constexpr double kMaxTiltRad = 0.03490658503988659;

/// Throws ConfigurationError with subject, value and allowed range unless low <= value <= high.
void check_value(const std::string& subject, double value, double low, double high, const std::string& unit);

/// Throws ConfigurationError unless the frame is upright and level.
void check_level(const Mount& mount);

/// Bounding rectangle of the robot from above in base_link, including its key.
struct Footprint {
  double front_m;
  /// Positive.
  double rear_m;
  /// Largest distance from the middle line on either side.
  double half_width_m;
};

/// The remote key on its lift.
struct KeyMount {
  /// Lever in base_link.
  double x_m;
  double y_m;
  /// Height above ground, with the lift at its lower stop.
  double min_height_m;
  double lift_travel_m;

  double max_height_m() const;
};

/// The four wheels.
struct Wheels {
  /// Distance between the axles.
  double base_m;
  /// Distance between the middles of the left and the right wheels.
  double track_m;
  double radius_m;
  /// Height of the axles in base_link.
  double axle_z_m;
};

/// Centre of mass in base_link.
struct CentreOfMass {
  double x_m;
  double y_m;
  /// Height above ground.
  double height_m;
};

/// Geometry queries for nodes.
///
/// Each query throws mtr_core::ConfigurationError if the URDF does not contain the answer. The sentence has the value,
/// its place and the allowed range. Parts without a query may be missing.
class RobotGeometry {
 public:
  /// @param urdf_text value of the parameter robot_description
  explicit RobotGeometry(const std::string& urdf_text);

  /// Returns the mount of a frame that is connected to base_link by fixed joints only.
  Mount mount(const std::string& frame) const;

  /// Returns the bounds of all collision shapes; wheel rotation and lift do not change them.
  Footprint footprint() const;

  /// Returns the remote key, which is on a vertical lift.
  KeyMount key() const;

  /// Returns the four wheels, which rotate on base_link by continuous joints.
  Wheels wheels() const;

  /// Returns the height of base_link above level ground.
  double base_height_m() const;

  /// Returns the centre of mass with the lift at a height above its lower stop.
  CentreOfMass centre_of_mass(double lift_m) const;

 private:
  std::shared_ptr<const urdf::ModelInterface> model_;
};

}  // namespace mtr_description
