/// @file
/// Expectation of error sentences.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace mtr_localization::replay {

/// Expects that the action throws a sentence with this part.
template <typename Action>
void expect_sentence(Action action, const std::string& part) {
  try {
    action();
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

}  // namespace mtr_localization::replay
