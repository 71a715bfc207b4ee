/// @file
/// What stops the whole firmware: silence, stops, late orders, a broken sensor.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "board_fixture.hpp"

namespace {

TEST_F(BoardTest, StopsReleasesAndSaysSoWhenTheHostIsSilent) {
  height_m_ = 0.5F;
  send(frames::press(1, 3, 1.0F, 10000));
  pass(350);
  EXPECT_NE(hardware().duty, 0);
  EXPECT_EQ(hardware().servo_us[0], 2000);
  pass(1100, true);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(hardware().servo_us[0], 1000);
  EXPECT_EQ(hardware().servo_us[1], 1000);
  EXPECT_EQ(fault(), static_cast<int>(mtr::Fault::kLinkLost));
  // Its sensor did not show any motion before the silence; to hold still ends the jam.
  height_m_ = NAN;
  pass(300);
  EXPECT_EQ(fault(), static_cast<int>(mtr::Fault::kNone));
}

TEST_F(BoardTest, ReportsALiftThatHasGivenUpUntilItIsOrderedToHoldStill) {
  height_m_ = 0.5F;
  pass(600);
  EXPECT_EQ(fault(), static_cast<int>(mtr::Fault::kLiftJammed));
  pass(2000);
  EXPECT_EQ(fault(), static_cast<int>(mtr::Fault::kLiftGivenUp));
  height_m_ = 0.4F;
  pass(3000);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(fault(), static_cast<int>(mtr::Fault::kLiftGivenUp));
  height_m_ = NAN;
  pass(200);
  EXPECT_EQ(fault(), static_cast<int>(mtr::Fault::kNone));
  height_m_ = 0.4F;
  pass(200);
  EXPECT_GT(hardware().duty, 0);
}

// A3
TEST_F(BoardTest, HoldsTheLiftReleasesTheServosAndTakesNoPressWhileItIsStopped) {
  height_m_ = 0.5F;
  send(frames::press(1, 3, 1.0F, 10000));
  pass(350);
  EXPECT_EQ(hardware().servo_us[0], 2000);
  for (int i = 0; i < 10; ++i) {
    send(frames::command(++seq_, height_m_, mtr::kLedMoving, 1));
    send(frames::press(2, 1, 1.0F, 100));
    pass(99, true);
  }
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(hardware().servo_us[0], 1000);
  EXPECT_EQ(last_refusal(), static_cast<int>(mtr::Refusal::kStopped));
  send(frames::press(2, 1, 1.0F, 100));
  pass(350);
  EXPECT_EQ(hardware().servo_us[0], 1000) << "what was refused is not taken later";
  EXPECT_NE(hardware().duty, 0) << "the order of before holds again";
}

// B8
TEST_F(BoardTest, LetsNoLateOrderMoveTheLiftOrStandForALivingHost) {
  height_m_ = 0.0F;
  pass(350);
  for (int i = 0; i < 15; ++i) {
    send(frames::command(++seq_, 0.5F, mtr::kLedMoving, 0, hardware().now_us - 1000U));
    send(frames::press(7, 1, 1.0F, 100, hardware().now_us - 1000U));
    pass(100, true);
  }
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(fault(), static_cast<int>(mtr::Fault::kLinkLost));
}

TEST_F(BoardTest, StopsAtOnceWhenTheHostSaysGoodbye) {
  height_m_ = 0.5F;
  pass(350);
  send(frames::frame(mtr::kTopicStop, {}));
  pass(1, true);
  EXPECT_EQ(hardware().duty, 0);
}

TEST_F(BoardTest, StaysStoppedAfterTheClockHasWrapped) {
  height_m_ = 0.5F;
  pass(350);
  pass(1100, true);
  hardware().now_us += 0xFFFFFFFFU - 2000000U;
  pass(100, true);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(fault(), static_cast<int>(mtr::Fault::kLinkLost));
}

TEST_F(BoardTest, StopsAndSaysSoWhenTheSensorBreaks) {
  height_m_ = 0.5F;
  pass(350);
  EXPECT_NE(hardware().duty, 0);
  hardware().position = 0;
  pass(100);
  EXPECT_EQ(hardware().duty, 0);
  const Bytes state = sent()[mtr::kTopicState];
  EXPECT_EQ(state.at(kFaultAt), static_cast<int>(mtr::Fault::kSensorBroken));
  float height_m;
  std::memcpy(&height_m, &state[kHeightAt], sizeof height_m);
  EXPECT_TRUE(std::isnan(height_m));
  hardware().position = 51;
  pass(800);
  EXPECT_NE(hardware().duty, 0);
}

}  // namespace
