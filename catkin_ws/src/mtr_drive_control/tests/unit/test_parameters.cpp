/// @file
/// Ranges of drive control's parameters.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "mtr_drive_control/parameters.hpp"

namespace mtr_drive_control {
namespace {

std::string refusal_of(const Parameters& parameters) {
  try {
    check(parameters);
  } catch (const mtr_core::ConfigurationError& error) {
    return error.what();
  }
  return "";
}

TEST(Parameters, DefaultsAreAccepted) { EXPECT_EQ(refusal_of(Parameters{}), ""); }

TEST(Parameters, EachValueBeyondItsRangeIsRefusedWithNameValueAndRange) {
  for (const Row& row : kRows) {
    Parameters parameters;
    parameters.*(row.member) = row.high + 1.0;
    const std::string text = refusal_of(parameters);
    EXPECT_NE(text.find(std::string("Parameter ") + row.name + " is "), std::string::npos) << text;
    EXPECT_NE(text.find("allowed is"), std::string::npos) << text;
  }
}

TEST(Parameters, NotANumberIsRefused) {
  Parameters parameters;
  parameters.max_linear_mps = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal_of(parameters), "");
}

TEST(Parameters, EmergencyDecelerationTooWeakForHalfASecondIsRefused) {
  Parameters parameters;
  parameters.emergency_linear_deceleration_mps2 = 2.0;
  EXPECT_EQ(refusal_of(parameters),
            "Parameter emergency_linear_deceleration_mps2 is 2 m/s2; allowed is 2.77778 to 10 m/s2.");
}

TEST(Parameters, TiltThatStopsHasToBeBeyondTheOneThatSlows) {
  Parameters parameters;
  parameters.tilt_stop_rad = parameters.tilt_slow_rad;
  EXPECT_NE(refusal_of(parameters).find("Parameter tilt_stop_rad is "), std::string::npos);
}

}  // namespace
}  // namespace mtr_drive_control
