/// @file
/// Which orders the whole firmware obeys, and which it refuses.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "board_fixture.hpp"

namespace {

TEST_F(BoardTest, DrivesTowardsAHeight) {
  height_m_ = 0.5F;
  pass(350);
  EXPECT_GT(hardware().duty, 0);
}

TEST_F(BoardTest, RefusesHeightsThatCannotBeWithoutMovement) {
  for (float height_m : {-0.01F, 1.21F, 1e30F, INFINITY, -INFINITY}) {
    height_m_ = height_m;
    pass(500);
    EXPECT_EQ(hardware().duty, 0) << height_m;
    EXPECT_EQ(last_refusal(), static_cast<int>(mtr::Refusal::kHeight)) << height_m;
  }
}

TEST_F(BoardTest, HoldsStillForNanWithoutRefusingIt) {
  height_m_ = NAN;
  pass(500);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(last_refusal(), static_cast<int>(mtr::Refusal::kNone));
}

TEST_F(BoardTest, KeepsItsLedsWhenThePatternIsUnknown) {
  pass(300);
  send(frames::command(99, 0.0F, mtr::kLedPatternCount));
  pass(300, true);
  auto found = sent();
  EXPECT_EQ(found[mtr::kTopicState].at(kLedAt), mtr::kLedMoving);
  EXPECT_EQ(found[mtr::kTopicHealth].at(kLastRefusalAt), static_cast<int>(mtr::Refusal::kLedPattern));
}

// B8
TEST_F(BoardTest, RefusesAPressThatComesLaterThanItMayBegin) {
  pass(300);
  for (std::uint32_t latest_us : {hardware().now_us - 1000U, hardware().now_us + mtr::kMaxLeadUs + 1000000U}) {
    send(frames::press(latest_us, 1, 1.0F, 100, latest_us));
    pass(250);
    EXPECT_EQ(hardware().servo_us[0], 1000);
    EXPECT_EQ(last_refusal(), static_cast<int>(mtr::Refusal::kLate));
  }
}

// B8
TEST_F(BoardTest, ObeysOrdersAcrossTheWrapOfItsClock) {
  pass(119900);
  send(frames::press(1, 1, 1.0F, 200));
  pass(250);
  EXPECT_LT(hardware().now_us, 1000000U);
  EXPECT_EQ(hardware().servo_us[0], 2000);
}

TEST_F(BoardTest, CountsARefusedCalibration) {
  for (float stroke_m : {0.0F, -1.0F, 2.1F, NAN}) {
    send(frames::calibrate(++seq_ + 100, stroke_m));
    pass(250);
    EXPECT_EQ(hardware().duty, 0);
  }
  EXPECT_EQ(sent()[mtr::kTopicHealth].at(kRefusedAt), 4);
}

// B8, A3
TEST_F(BoardTest, CalibratesNeitherByALateOrderNorWhileItIsStopped) {
  pass(300);
  send(frames::calibrate(1, 1.2F, hardware().now_us - 1000U));
  pass(250);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(last_refusal(), static_cast<int>(mtr::Refusal::kLate));
  send(frames::command(++seq_, 0.0F, mtr::kLedMoving, 1));
  send(frames::calibrate(2, 1.2F));
  pass(250, true);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(last_refusal(), static_cast<int>(mtr::Refusal::kStopped));
}

TEST_F(BoardTest, HoldAbandonsACalibration) {
  send(frames::calibrate(1, 1.2F));
  pass(150);
  EXPECT_LT(hardware().duty, 0);
  height_m_ = NAN;
  pass(150);
  EXPECT_EQ(hardware().duty, 0);
}

}  // namespace
