/// @file
/// One line of the panel.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace mtr_rviz {

/// kNote: hinders nothing, and should be known.
enum class Level { kGood, kNote, kUnknown, kBad };

/// What is looked at, and what was found.
struct Row {
  std::string name;
  Level level = Level::kUnknown;
  std::string text;
};

/// Told apart without colours too; UTF-8.
std::string sign_of(Level level);

}  // namespace mtr_rviz
