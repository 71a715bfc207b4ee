/// @file
/// Simple polygon, and the clearance of the robot's outline from its border.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mtr_drive_control/geometry.hpp"

namespace mtr_drive_control {

/// Polygon with at least 3 corners in either direction of rotation; edges do not cross each other.
class Polygon {
 public:
  explicit Polygon(std::vector<Point> corners);

  const std::vector<Point>& corners() const { return corners_; }
  bool contains(const Point& point) const;
  double distance_to_border_m(const Point& point) const;

  /// Distance of the footprint at this pose from the border while all of it is inside. Negative outside: minus the
  /// distance to the farthest point outside, or minus the depth of a corner of the polygon in the footprint.
  double clearance_m(const Footprint& footprint, const Pose& pose) const;

 private:
  double protrusion_m(const Footprint& footprint, const Pose& pose) const;

  std::vector<Point> corners_;
};

}  // namespace mtr_drive_control
