/// @file
/// One check for each part of the robot.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/robot.hpp"
#include "core/row.hpp"

namespace mtr_rviz {

/// A node that has said nothing for so long counts as silent; each speaks at least ten times a second.
inline constexpr double kSilentAfterS = 1.0;
/// Of an own arrival; false before the first.
bool is_fresh(double at_s, double now_s);
/// How long nobody spoke, or that nobody ever did.
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
