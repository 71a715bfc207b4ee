/// @file
/// Ranges of the localization parameters.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "parameters.hpp"

namespace mtr_localization {
namespace {

TEST(LocalizerParameters, DefaultsAreAccepted) { EXPECT_NO_THROW(check(Parameters{})); }

TEST(LocalizerParameters, EachValueBeyondItsRangeIsRefusedByName) {
  Parameters parameters;
  for_each_group(parameters, [&parameters](const auto& rows, auto& group) {
    for (const auto& row : rows) {
      const double good = std::exchange(group.*(row.member), row.high + 1.0);
      try {
        check(parameters);
        ADD_FAILURE() << row.name << " was accepted";
      } catch (const mtr_core::ConfigurationError& error) {
        EXPECT_NE(std::string(error.what()).find(row.name), std::string::npos);
      }
      group.*(row.member) = good;
    }
  });
}

}  // namespace
}  // namespace mtr_localization
