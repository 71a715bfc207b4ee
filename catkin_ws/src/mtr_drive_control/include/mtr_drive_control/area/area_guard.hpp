/// @file
/// Reduces a desired velocity such that the robot stays in the test area.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "mtr_core/problem.hpp"
#include "mtr_drive_control/area/area_parameters.hpp"
#include "mtr_drive_control/area/polygon.hpp"
#include "mtr_drive_control/collision/collision_stop.hpp"

namespace mtr_drive_control {

/// Test area set by the Operator or the launch file.
struct TestArea {
  /// True on a real robot: without a polygon the planner's motion is forbidden.
  bool required = false;
  /// Origin of the map to which the polygon refers.
  std::uint64_t origin_id = 0;
  /// Empty: no area is set.
  std::optional<Polygon> polygon;
};

/// A valid pose of localization.
struct AreaPose {
  std::int64_t stamp_ns;
  Pose map_from_base;
  /// 1 sigma in the worst direction.
  double position_sigma_m;
  double heading_sigma_rad;
  std::uint64_t origin_id;
};

/// Inputs on the area at a tick.
struct AreaInputs {
  /// Null before the first message.
  std::shared_ptr<const TestArea> area;
  /// Empty while the position is unknown.
  std::optional<AreaPose> pose;
};

/// Result of the area for a desired motion.
struct AreaAssessment {
  Velocity velocity;
  Zone zone = Zone::kClear;
  /// One sentence if the area forbids motion, else empty.
  mtr_core::Problem message;
};

/// Poses from now to standstill of a stop from a velocity.
using StopPath = std::function<std::vector<PathPoint>(const Velocity&)>;

/// Third check of a motion, after locks and collision stop.
///
/// A velocity is permitted if the footprint stays inside the border by the gap and 2 sigma of the pose until the stop
/// from it has ended. A robot that is already outside may move slowly, but not farther out. With an area and without a
/// pose in it a person may crawl, and the planner's motion is forbidden.
class AreaGuard {
 public:
  AreaGuard(const AreaParameters& parameters, const Footprint& footprint);

  /// Accepts the inputs of a tick; must be called once per tick, first.
  /// @param wheels velocity since the pose's stamp
  void take(std::int64_t tick_ns, const AreaInputs& inputs, const Velocity& wheels);

  /// Returns the largest permitted part of the desired motion.
  AreaAssessment assess(const DesiredMotion& desired, const StopPath& stop_path) const;

  /// Returns true if a stop from this velocity ends inside.
  bool permits(const DesiredMotion& desired, const StopPath& stop_path) const;

 private:
  /// Pose of the robot, and its required distance from the border.
  struct Place {
    Pose map_from_base;
    double margin_m;
    double clearance_m;
  };

  std::optional<Place> place_at(std::int64_t tick_ns, const AreaInputs& inputs, const Velocity& wheels) const;
  bool stays_inside(const std::vector<PathPoint>& path) const;
  double corner_speed_mps(const Velocity& velocity) const;
  Velocity at_most(const Velocity& velocity, double corner_mps) const;
  AreaAssessment assess_inside(const Velocity& desired, const StopPath& stop_path) const;
  mtr_core::Problem border_problem() const;

  AreaParameters parameters_;
  Footprint footprint_;
  std::shared_ptr<const TestArea> area_;
  std::optional<Place> place_;
  /// Reason why the position in the area is unknown, or an area is missing.
  mtr_core::Problem obstruction_;
};

}  // namespace mtr_drive_control
