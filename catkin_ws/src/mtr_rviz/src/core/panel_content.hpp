/// @file
/// What the panel shows.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/robot.hpp"
#include "core/row.hpp"

namespace mtr_rviz {

/// A sign, a colour and a text each.
struct PanelContent {
  /// The state in words.
  Row state;
  /// Sentences on why it does what it does, or nothing; each once.
  std::vector<std::string> reasons;
  /// What has to be right.
  std::vector<Row> checks;
  /// Of the injected faults.
  std::vector<std::string> faults;
  /// The robot was started so that faults can be injected.
  bool can_inject = false;
};

/// @param now_s on the clock of the arrivals
PanelContent content_of(const Robot& robot, double now_s);

}  // namespace mtr_rviz
