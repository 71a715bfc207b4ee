/// @file
/// Detection of standstill.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "motion/standstill.hpp"

namespace mtr_localization {
namespace {

class StandstillTest : public ::testing::Test {
 protected:
  void rest_for(int steps, double gyro_rate = 0.0) {
    for (int step = 0; step < steps; ++step) {
      send(0.0, 0.0, gyro_rate);
    }
  }

  void send(double linear, double angular, double gyro_rate) {
    stamp_ns += 20'000'000;
    detector.update({stamp_ns, 0.0, 0.0, 0.0, linear, angular}, gyro_rate);
  }

  StandstillDetector detector{SensorParameters{}};
  std::int64_t stamp_ns = 0;
};

TEST_F(StandstillTest, RestCountsAfterTheSettlingTime) {
  rest_for(25);
  EXPECT_FALSE(detector.standing());
  rest_for(1);
  EXPECT_TRUE(detector.standing());
}

TEST_F(StandstillTest, TurningWheelsAreNoStandstill) {
  rest_for(50);
  send(0.1, 0.0, 0.0);
  EXPECT_FALSE(detector.standing());
  rest_for(50);
  send(0.0, 0.1, 0.0);
  EXPECT_FALSE(detector.standing());
}

TEST_F(StandstillTest, TurningGyroIsNoStandstill) {
  rest_for(100, 0.05);
  EXPECT_FALSE(detector.standing());
}

TEST_F(StandstillTest, ResetStartsTheSettlingTimeAgain) {
  rest_for(50);
  detector.reset();
  EXPECT_FALSE(detector.resting());
  rest_for(10);
  EXPECT_FALSE(detector.standing());
}

}  // namespace
}  // namespace mtr_localization
