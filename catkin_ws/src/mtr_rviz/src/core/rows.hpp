/// @file
/// One check for each part of the robot.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/robot.hpp"
#include "core/row.hpp"

namespace mtr_rviz {

/// Time without a message after which a node counts as silent; each node publishes at least ten times per second.
inline constexpr double kSilentAfterS = 1.0;
/// Returns true for a recent arrival; false before the first one.
bool is_fresh(double at_s, double now_s);
/// Returns a text about the duration of the silence, or about a node that has never published.
std::string silence(double at_s, double now_s);

Row pose_row(const Heard<PoseSaid>& heard, double now_s);
Row car_row(const Heard<CarSaid>& heard, double now_s);
Row self_check_row(const Heard<SelfCheckSaid>& heard, double now_s);
Row motion_row(const Heard<MotionSaid>& heard, double now_s);
Row drive_row(const Heard<DriveSaid>& heard, double now_s);
Row parts_row(const Heard<PartsSaid>& heard, double now_s);
Row battery_row(const Heard<PartsSaid>& heard, double now_s);
Row preflight_row(const std::optional<Preflight>& preflight);

}  // namespace mtr_rviz
