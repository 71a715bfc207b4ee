/// @file
/// Contents of the panel.
// SPDX-License-Identifier: Apache-2.0
#include "core/panel_content.hpp"

#include <algorithm>
#include <cmath>

#include "core/rows.hpp"

namespace mtr_rviz {
namespace {

Row state_row(const Heard<ModeSaid>& heard, double now_s) {
  if (!is_fresh(heard.at_s, now_s)) {
    return {"State machine", Level::kUnknown, silence(heard.at_s, now_s)};
  }
  if (heard.said.is_held) {
    return {"", Level::kNote, "Held until the Operator has it go on"};
  }
  switch (heard.said.mode) {
    case Mode::kStarting:
      return {"", Level::kNote, "Starting"};
    case Mode::kReadyToMapCar:
      return {"", Level::kGood, "Ready to map the Car"};
    case Mode::kMappingCar:
      return {"", Level::kGood, "Maps the Car"};
    case Mode::kFollowingWaypoint:
      return {"", Level::kGood, "Follows waypoints"};
    case Mode::kCheckingCar:
      return {"", Level::kGood, "Checks the Car's frame"};
    case Mode::kFault:
      return {"", Level::kBad, "Fault"};
    default:
      return {"", Level::kUnknown, "A state that this panel does not know"};
  }
}

/// Collects sentences without duplicates, because nodes forward sentences of others.
class Reasons {
 public:
  void add(const std::string& sentence) {
    if (!sentence.empty() && std::find(sentences_.begin(), sentences_.end(), sentence) == sentences_.end()) {
      sentences_.push_back(sentence);
    }
  }
  std::vector<std::string> take() { return std::move(sentences_); }

 private:
  std::vector<std::string> sentences_;
};

std::vector<std::string> reasons_of(const Robot& robot, double now_s) {
  Reasons reasons;
  if (is_fresh(robot.mode.at_s, now_s)) {
    reasons.add(robot.mode.said.message);
  }
  for (const auto& [owner, heard] : robot.locks) {
    if (!is_fresh(heard.at_s, now_s)) {
      reasons.add("The motion lock of " + owner + ": " + silence(heard.at_s, now_s));
    } else if (heard.said.is_engaged) {
      reasons.add(heard.said.reason.empty() ? "The motion lock of " + owner + " is engaged." : heard.said.reason);
    }
  }
  if (is_fresh(robot.drive.at_s, now_s)) {
    reasons.add(robot.drive.said.message);
  }
  const MotionSaid& motion = robot.motion.said;
  if (is_fresh(robot.motion.at_s, now_s) &&
      (motion.result == MotionSaid::Result::kRefused || motion.result == MotionSaid::Result::kBlocked)) {
    reasons.add(motion.message);
  }
  return reasons.take();
}

}  // namespace

PanelContent content_of(const Robot& robot, double now_s) {
  PanelContent content;
  content.state = state_row(robot.mode, now_s);
  content.reasons = reasons_of(robot, now_s);
  content.checks = {
      pose_row(robot.pose, now_s),     car_row(robot.car, now_s),     self_check_row(robot.self_check, now_s),
      motion_row(robot.motion, now_s), drive_row(robot.drive, now_s), parts_row(robot.parts, now_s),
      battery_row(robot.parts, now_s), preflight_row(robot.preflight)};
  content.can_inject = robot.faults.has_value();
  content.faults = robot.faults.value_or(std::vector<std::string>{});
  return content;
}

}  // namespace mtr_rviz
