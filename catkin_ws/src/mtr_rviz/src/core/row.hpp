/// @file
/// One line of the panel.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace mtr_rviz {

/// kNote: information without effect on the test.
enum class Level { kGood, kNote, kUnknown, kBad };

/// Result of one check.
struct Row {
  std::string name;
  Level level = Level::kUnknown;
  std::string text;
};

/// Returns a sign that is distinguishable without colours; UTF-8.
std::string sign_of(Level level);

}  // namespace mtr_rviz
