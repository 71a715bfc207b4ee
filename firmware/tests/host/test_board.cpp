/// @file
/// The whole firmware on the stub of the hardware.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "../../hal_host/hal_host.hpp"
#include "../../logic/board.hpp"
#include "../../logic/link/endpoints.hpp"
#include "definitions.hpp"
#include "frames.hpp"

namespace {

using frames::Bytes;

// Offsets within FirmwareState and FirmwareHealth
constexpr int kHeightAt = 4, kLedAt = 25, kFaultAt = 26;
constexpr int kRefusedAt = 11, kLastRefusalAt = 21;

class BoardTest : public testing::Test {
 protected:
  void SetUp() override {
    hal_host::renew();
    board_.start();
  }

  void send(const Bytes& bytes) {
    hardware().to_firmware.insert(hardware().to_firmware.end(), bytes.begin(), bytes.end());
  }

  /// Lets time pass; with commands each 100 ms unless silent.
  void pass(int ms, bool is_silent = false) {
    for (int i = 0; i < ms; ++i) {
      if (!is_silent && i % 100 == 0) {
        send(frames::command(++seq_, height_m_));
      }
      hardware().pass_ms();
      board_.step();
    }
  }

  static hal_host::Hardware& hardware() { return hal_host::hardware(); }

  /// Newest payload of each topic that has been sent; clears what was sent.
  std::map<int, Bytes> sent() {
    std::map<int, Bytes> found;
    const Bytes& bytes = hardware().from_firmware;
    for (std::size_t at = 0; at + 8 <= bytes.size();) {
      EXPECT_EQ(bytes[at], 0xFF);
      EXPECT_EQ(bytes[at + 1], 0xFE);
      const std::size_t length = bytes[at + 2];
      const auto payload = bytes.begin() + static_cast<std::ptrdiff_t>(at) + 7;
      found[bytes[at + 5] | bytes[at + 6] << 8] = Bytes(payload, payload + static_cast<std::ptrdiff_t>(length));
      at += length + 8;
    }
    hardware().from_firmware.clear();
    return found;
  }

  int fault() { return sent()[mtr::kTopicState].at(kFaultAt); }
  int last_refusal() { return sent()[mtr::kTopicHealth].at(kLastRefusalAt); }

  float height_m_ = 0.0F;
  std::uint32_t seq_ = 0;
  mtr::PressMemory memory_ = {};
  mtr::Board board_{&memory_};
};

TEST_F(BoardTest, AnnouncesItsTopicsAndReports) {
  pass(300);
  const auto found = sent();
  EXPECT_TRUE(found.count(mtr::kTopicNegotiate));
  EXPECT_TRUE(found.count(mtr::kTopicSubscriber));
  EXPECT_TRUE(found.count(mtr::kTopicTime));
  EXPECT_EQ(found.at(mtr::kTopicState).size(), static_cast<std::size_t>(MTR_FIRMWARESTATE_BYTES));
  EXPECT_EQ(found.at(mtr::kTopicHealth).size(), static_cast<std::size_t>(MTR_FIRMWAREHEALTH_BYTES));
  EXPECT_EQ(found.at(mtr::kTopicEcho), Bytes{static_cast<std::uint8_t>(seq_)});
}

TEST_F(BoardTest, IsSilentAfterAStopUntilItIsAsked) {
  pass(300);
  send(frames::frame(mtr::kTopicStop, {}));
  pass(10, true);
  sent();
  pass(2000, true);
  EXPECT_TRUE(sent().empty());
  send(frames::frame(mtr::kTopicNegotiate, {}));
  pass(300);
  EXPECT_TRUE(sent().count(mtr::kTopicState));
}

TEST_F(BoardTest, TellsAllTopicsBeforeItReportsWhenItIsAsked) {
  for (int start_ms = 0; start_ms < 40; ++start_ms) {
    pass(301);
    sent();
    send(frames::frame(mtr::kTopicNegotiate, {}));
    // A pass for TIME and one for each topic but the last.
    pass(mtr::kEndpointCount, true);
    const auto found = sent();
    EXPECT_TRUE(found.count(mtr::kTopicSubscriber));
    EXPECT_FALSE(found.count(mtr::kTopicState)) << start_ms;
  }
}

TEST_F(BoardTest, AnnouncesAgainWhileNobodyAnswers) {
  pass(500);
  sent();
  pass(2000);
  EXPECT_TRUE(sent().count(mtr::kTopicSubscriber));
}

TEST_F(BoardTest, DoesNotAnnounceAgainWhileTheHostAnswersAndCommands) {
  pass(100);
  for (int i = 0; i < 10; ++i) {
    send(frames::frame(mtr::kTopicTime, Bytes(8, 0)));
    pass(300);
    if (i == 2) {
      sent();
    }
  }
  EXPECT_FALSE(sent().count(mtr::kTopicSubscriber));
}

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
  pass(300);
  EXPECT_EQ(fault(), static_cast<int>(mtr::Fault::kNone));
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

// B8
TEST_F(BoardTest, ObeysOrdersAcrossTheWrapOfItsClock) {
  pass(119900);
  send(frames::press(1, 1, 1.0F, 200));
  pass(250);
  EXPECT_LT(hardware().now_us, 1000000U);
  EXPECT_EQ(hardware().servo_us[0], 2000);
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

TEST_F(BoardTest, DropsAndCountsReportsWhenTheLineIsFull) {
  pass(300);
  sent();
  hardware().room = 3;
  pass(300);
  EXPECT_TRUE(sent().empty());
  hardware().room = 255;
  pass(300);
  const Bytes health = sent()[mtr::kTopicHealth];
  EXPECT_GE(health.at(19) | health.at(20) << 8, 10);
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
