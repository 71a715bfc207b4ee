/// @file
/// How much of a wanted velocity keeps the robot in the test area.
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

/// The area that the Operator or the launch file has set.
struct TestArea {
  /// A real robot: without a polygon the planner moves nothing.
  bool required = false;
  /// Origin of map to which the polygon refers.
  std::uint64_t origin_id = 0;
  /// None: no area is set.
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

/// What is known of the area at a tick.
struct AreaInputs {
  /// Null before the first message.
  std::shared_ptr<const TestArea> area;
  /// Nothing while the position is unknown.
  std::optional<AreaPose> pose;
};

/// What the area makes of a desired motion.
struct AreaAssessment {
  Velocity velocity;
  Zone zone = Zone::kClear;
  /// One sentence when the area forbids motion, else empty.
  mtr_core::Problem message;
};

/// Poses from now to standstill of a stop from a velocity.
using StopPath = std::function<std::vector<PathPoint>(const Velocity&)>;

/// Third opinion on a motion, after locks and collision stop.
///
/// A velocity is permitted when the footprint stays inside the border by the gap and 2 sigma of the pose until the stop
/// from it has ended. A robot that is outside already may move slowly such that it gets no farther out. With an area
/// and without a pose in it a person may crawl, and the planner moves nothing.
class AreaGuard {
 public:
  AreaGuard(const AreaParameters& parameters, const Footprint& footprint);

  /// Takes what is known at a tick; to be called once per tick, first.
  /// @param wheels velocity since the pose's stamp
  void take(std::int64_t tick_ns, const AreaInputs& inputs, const Velocity& wheels);

  /// Largest part of the desired motion that is permitted.
  AreaAssessment assess(const DesiredMotion& desired, const StopPath& stop_path) const;

  /// True when a stop from this velocity ends inside.
  bool permits(const DesiredMotion& desired, const StopPath& stop_path) const;

 private:
  /// Where the robot is, and how far it has to stay from the border.
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
  /// Why the position in the area is unknown, or an area is missing.
  mtr_core::Problem obstruction_;
};

}  // namespace mtr_drive_control
