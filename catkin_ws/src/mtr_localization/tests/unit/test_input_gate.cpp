/// @file
/// A wheel sample waits for IMU data of its time, but not for microseconds.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>

#include "motion/input_gate.hpp"

namespace mtr_localization {
namespace {

constexpr std::int64_t kPeriodNs = 20'000'000;
constexpr double kGapLimitS = 0.3;

class InputGateTest : public ::testing::Test {
 protected:
  /// Feeds IMU and wheels of a moving robot; the wheel stamps are later by later_ns.
  void drive(std::int64_t later_ns, bool imu_is_first) {
    for (int number = 1; number < 50; ++number) {
      const std::int64_t imu_ns = number * kPeriodNs;
      const WheelSample wheels{imu_ns + later_ns, 0.01 * number, 0.0, 0.0, 0.5, 0.0};
      for (const bool is_imu : {imu_is_first, !imu_is_first}) {
        if (is_imu) {
          gate.add_imu({imu_ns, 0.001 * number});
        } else {
          gate.add_wheels(wheels);
        }
      }
      while (const auto sample = gate.next()) {
        EXPECT_FALSE(sample->problem) << sample->problem.text;
        EXPECT_LE(sample->wheels.stamp_ns, wheels.stamp_ns);
        latest_ns = sample->wheels.stamp_ns;
        gate.release(*sample);
        given += sample->wheels.x_m == wheels.x_m ? 1 : 0;
      }
    }
  }

  InputGate gate{kGapLimitS};
  /// Number of samples released at once.
  int given = 0;
  std::int64_t latest_ns = 0;
};

TEST_F(InputGateTest, StampsOfOneInstantDoNotWait) {
  drive(0, true);
  EXPECT_EQ(given, 49);
}

TEST_F(InputGateTest, NeitherDoThoseThatAreMicrosecondsApart) {
  drive(20'000, true);
  EXPECT_EQ(given, 49);
  EXPECT_EQ(latest_ns, 49 * kPeriodNs);
}

TEST_F(InputGateTest, WhicheverComesFirst) {
  drive(20'000, false);
  EXPECT_EQ(given, 49);
}

TEST_F(InputGateTest, ThoseThatAreLaterWaitForTheNextOfTheImu) {
  drive(1'000'000, true);
  EXPECT_EQ(given, 0);
  EXPECT_EQ(latest_ns, 48 * kPeriodNs + 1'000'000);
}

}  // namespace
}  // namespace mtr_localization
