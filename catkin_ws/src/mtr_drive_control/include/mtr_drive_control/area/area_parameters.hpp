/// @file
/// Parameters of the test area's border; SI units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"

namespace mtr_drive_control {

/// Margin at the border, and permitted speeds if the robot cannot be kept inside.
struct AreaParameters {
  /// Distance between the footprint and the border, in addition to 2 sigma of the position.
  double area_gap_m = 0.05;
  /// Speed of any corner of a robot that returns from outside the area.
  double area_return_mps = 0.15;
  /// Speed of any corner under manual control while the position in the area is unknown.
  double area_crawl_mps = 0.1;
  /// Age at which a pose is unknown; localization publishes one every 0.02 s.
  double area_pose_timeout_s = 0.2;
};

using AreaRow = mtr_core::ParameterRow<AreaParameters>;

inline constexpr std::array<AreaRow, 4> kAreaRows{{
    {"area_gap_m", &AreaParameters::area_gap_m, 0.02, 1.0, "m"},
    {"area_return_mps", &AreaParameters::area_return_mps, 0.02, 0.3, "m/s"},
    {"area_crawl_mps", &AreaParameters::area_crawl_mps, 0.02, 0.2, "m/s"},
    {"area_pose_timeout_s", &AreaParameters::area_pose_timeout_s, 0.05, 0.5, "s"},
}};

/// Throws ConfigurationError unless each value is in its range.
void check(const AreaParameters& parameters);

}  // namespace mtr_drive_control
