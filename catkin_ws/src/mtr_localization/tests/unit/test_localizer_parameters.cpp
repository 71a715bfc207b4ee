/// @file
/// Ranges of localization's parameters.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "mtr_localization/parameters.hpp"

namespace mtr_localization {
namespace {

TEST(LocalizerParameters, DefaultsAreAccepted) { EXPECT_NO_THROW(check(Parameters{})); }

TEST(LocalizerParameters, EachValueBeyondItsRangeIsRefusedByName) {
  for (const Row& row : kRows) {
    Parameters parameters;
    parameters.*(row.member) = row.high + 1.0;
    try {
      check(parameters);
      ADD_FAILURE() << row.name << " was accepted";
    } catch (const mtr_core::ConfigurationError& error) {
      EXPECT_NE(std::string(error.what()).find(row.name), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace mtr_localization
