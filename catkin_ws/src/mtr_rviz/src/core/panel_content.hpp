/// @file
/// Contents of the panel.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/robot.hpp"
#include "core/row.hpp"

namespace mtr_rviz {

/// Rows with a sign, a colour and a text each.
struct PanelContent {
  /// State of the robot.
  Row state;
  /// Sentences with the reasons of the state, each once; may be empty.
  std::vector<std::string> reasons;
  /// Checks of the robot's parts.
  std::vector<Row> checks;
  /// Sentences about active faults.
  std::vector<std::string> faults;
  /// True if the robot was started with fault injection.
  bool can_inject = false;
};

/// Returns the contents. @param now_s on the clock of the arrivals
PanelContent content_of(const Robot& robot, double now_s);

}  // namespace mtr_rviz
