/// @file
/// Stop input, buzzer and beacon of the whole firmware.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

#include "../../logic/stop_input.hpp"
#include "board_fixture.hpp"

namespace {

// Offsets within FirmwareInputs
constexpr int kStopAt = 4, kStopsAt = 5, kSignalAt = 7, kBeaconAt = 8;
constexpr int kUnused = 0, kClosed = 1, kOpen = 2;

class SignalsTest : public BoardTest {
 protected:
  Bytes inputs() { return sent()[mtr::kTopicInputs]; }
  int stop_state() { return inputs().at(kStopAt); }

  /// Lets time pass with a signal order each 100 ms as the host sends it.
  void pass_with(int ms, std::uint8_t signal, std::uint8_t beacon = 0, std::uint8_t stop_input = 1) {
    for (int i = 0; i < ms; i += 100) {
      send(frames::signals(signal, beacon, stop_input));
      pass(100);
    }
  }

  /// A chain is connected and closed, and the lift is under way.
  void start_lift() {
    hardware().is_stop_open = false;
    pass_with(200, 0);
    height_m_ = 0.5F;
    pass_with(200, 0);
    ASSERT_NE(hardware().duty, 0);
  }
};

TEST(StopInput, OpensAtOnceAndClosesAfterItsTimeOnly) {
  mtr::StopMemory memory = {};
  mtr::StopInput input(&memory);
  input.use();
  EXPECT_TRUE(input.is_open()) << "before the first reading";
  for (int ms = 1; ms < mtr::kStopCloseMs; ++ms) {
    input.step(false);
    EXPECT_TRUE(input.is_open()) << ms;
  }
  EXPECT_FALSE(input.step(false));
  EXPECT_FALSE(input.is_open());
  EXPECT_TRUE(input.step(true));
  EXPECT_TRUE(input.is_open());
  EXPECT_FALSE(input.step(true)) << "it opened once";
  EXPECT_EQ(input.openings(), 1);
}

TEST(StopInput, BouncingContactRemainsAStop) {
  for (int closed_ms : {1, 2, 50, mtr::kStopCloseMs - 1}) {
    mtr::StopMemory memory = {};
    mtr::StopInput input(&memory);
    input.use();
    for (int ms = 0; ms < 5000; ++ms) {
      input.step(ms % (closed_ms + 1) == 0);
      EXPECT_TRUE(input.is_open()) << closed_ms;
    }
    EXPECT_EQ(input.openings(), 0);
  }
}

TEST(StopInput, ThatIsNotInUseStopsNothing) {
  mtr::StopMemory memory = {};
  mtr::StopInput input(&memory);
  for (int ms = 0; ms < 500; ++ms) {
    EXPECT_FALSE(input.step(ms % 200 < 150));
    EXPECT_FALSE(input.is_open());
  }
  EXPECT_EQ(input.openings(), 0);
}

TEST_F(SignalsTest, BoardWithoutAStopChainWorks) {
  height_m_ = 0.5F;
  pass_with(350, 0, 0, 0);
  EXPECT_NE(hardware().duty, 0);
  EXPECT_EQ(stop_state(), kUnused);
  send(frames::press(1, 1, 1.0F, 500));
  pass(300);
  EXPECT_EQ(hardware().servo_us[0], 2000);
}

TEST_F(SignalsTest, BoardWhoseHostSendsNoSignalsWorks) {
  height_m_ = 0.5F;
  pass(350);
  EXPECT_NE(hardware().duty, 0);
  EXPECT_EQ(stop_state(), kUnused);
}

TEST_F(SignalsTest, StopInputThatNobodyConnectedStopsWhenItIsDeclared) {
  height_m_ = 0.5F;
  pass_with(350, 0);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(stop_state(), kOpen);
}

TEST_F(SignalsTest, OpenContactStopsLiftServosAndPressesWhateverTheHostOrders) {
  start_lift();
  send(frames::press(1, 3, 1.0F, 10000));
  pass_with(200, 0);
  ASSERT_EQ(hardware().servo_us[0], 2000);
  hardware().is_stop_open = true;
  pass(1, true);
  EXPECT_EQ(inputs().at(kStopAt), kOpen) << "reported at once";
  pass_with(600, 0);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(hardware().servo_us[0], 1000);
  send(frames::press(2, 1, 1.0F, 100));
  send(frames::calibrate(1, 1.2F));
  pass_with(200, 0);
  EXPECT_EQ(hardware().servo_us[0], 1000);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(last_refusal(), static_cast<int>(mtr::Refusal::kStopped));
  hardware().is_stop_open = false;
  pass_with(300, 0);
  EXPECT_NE(hardware().duty, 0) << "the order of the host holds again";
}

TEST_F(SignalsTest, ContactThatOpensForAMillisecondIsReportedAndCounted) {
  start_lift();
  send(frames::press(1, 1, 1.0F, 10000));
  pass(300);
  ASSERT_EQ(hardware().servo_us[0], 2000);
  sent();
  hardware().is_stop_open = true;
  pass(1, true);
  hardware().is_stop_open = false;
  pass(40, true);
  const Bytes report = inputs();
  EXPECT_EQ(report.at(kStopAt), kOpen);
  EXPECT_EQ(report.at(kStopsAt), 1);
  EXPECT_EQ(hardware().servo_us[0], 1000);
  pass_with(200, 0);
  EXPECT_EQ(stop_state(), kClosed);
}

TEST_F(SignalsTest, UseOfTheStopInputIsNotTakenBackWhileThePowerIsOn) {
  start_lift();
  pass_with(200, 0, 0, 0);
  hardware().is_stop_open = true;
  pass_with(300, 0, 0, 0);
  EXPECT_EQ(hardware().duty, 0);
  EXPECT_EQ(stop_state(), kOpen);
}

TEST_F(SignalsTest, BoardThatWasResetKnowsOfItsStopInputBeforeTheHostRepeatsIt) {
  start_lift();
  hardware().is_stop_open = true;
  pass(500);
  mtr::Board after_reset(&memory_, &stop_memory_);
  after_reset.start();
  for (int i = 0; i < 500; ++i) {
    if (i % 100 == 0) {
      send(frames::command(++seq_, height_m_));
    }
    hardware().pass_ms();
    after_reset.step();
    EXPECT_EQ(hardware().duty, 0) << i;
  }
}

TEST_F(SignalsTest, LateOrderOfSignalsIsRefused) {
  pass(300);
  send(frames::signals(1, 1, 1, hardware().now_us - 1000U));
  pass(250);
  const auto found = sent();
  EXPECT_EQ(found.at(mtr::kTopicInputs).at(kStopAt), kUnused);
  EXPECT_EQ(found.at(mtr::kTopicInputs).at(kSignalAt), mtr::kNoSignal);
  EXPECT_EQ(found.at(mtr::kTopicHealth).at(kLastRefusalAt), static_cast<int>(mtr::Refusal::kLate));
  EXPECT_FALSE(hardware().beacon);
}

TEST_F(SignalsTest, UnknownSignalIsRefusedAndTheOneInForceRemains) {
  pass_with(200, mtr::kSetsOff);
  send(frames::signals(mtr::kSignalCount, 1));
  pass(300);
  EXPECT_EQ(last_refusal(), static_cast<int>(mtr::Refusal::kSignal));
  pass(100);
  EXPECT_EQ(inputs().at(kSignalAt), mtr::kSetsOff);
}

TEST_F(SignalsTest, SignalBeforeMotionBlinksAndBeepsAndIsReported) {
  std::set<int> leds;
  int beeps = 0;
  bool was_on = false;
  for (int i = 0; i < 2000; ++i) {
    if (i % 100 == 0) {
      send(frames::signals(mtr::kSetsOff));
    }
    pass(1, i % 100 != 0);
    leds.insert(hardware().leds);
    beeps += hardware().buzzer && !was_on ? 1 : 0;
    was_on = hardware().buzzer;
  }
  EXPECT_GE(beeps, 7);
  EXPECT_TRUE(leds.count(1) == 1 && leds.count(2) == 1) << "green and yellow in turn";
  EXPECT_EQ(inputs().at(kSignalAt), mtr::kSetsOff);
}

TEST_F(SignalsTest, BuzzerIsSilentWithoutASignalAndItsPatternsDiffer) {
  std::vector<int> sounding(mtr::kSignalCount, 0);
  std::set<std::vector<bool>> patterns;
  for (std::uint8_t signal = 0; signal < mtr::kSignalCount; ++signal) {
    std::vector<bool> pattern;
    for (std::uint8_t slot = 0; slot < 16; ++slot) {
      pattern.push_back(mtr::buzzer_of(signal, slot));
      sounding[signal] += pattern.back() ? 1 : 0;
    }
    patterns.insert(pattern);
  }
  EXPECT_EQ(sounding[mtr::kNoSignal], 0);
  EXPECT_EQ(patterns.size(), static_cast<std::size_t>(mtr::kSignalCount));
}

TEST_F(SignalsTest, SignalEndsWithItsOrdersAndTheBeaconRemains) {
  pass_with(300, mtr::kReverses, 1);
  EXPECT_TRUE(hardware().beacon);
  pass(1300);
  bool sounded = false;
  for (int i = 0; i < 1000; ++i) {
    pass(1, i % 100 != 0);
    sounded = sounded || hardware().buzzer;
  }
  const Bytes report = inputs();
  EXPECT_FALSE(sounded);
  EXPECT_EQ(report.at(kSignalAt), mtr::kNoSignal);
  EXPECT_EQ(report.at(kBeaconAt), 1);
  pass(1300, true);
  EXPECT_TRUE(hardware().beacon) << "a lost host leaves the robot where it is";
}

}  // namespace
