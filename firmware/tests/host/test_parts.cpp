/// @file
/// Position sensor, memory, presses and LEDs.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "../../hal_host/hal_host.hpp"
#include "../../logic/leds.hpp"
#include "../../logic/lift/position_sensor.hpp"
#include "../../logic/memory.hpp"
#include "../../logic/presses.hpp"

namespace {

void feed(mtr::PositionSensor* sensor, std::uint16_t reading, int steps) {
  for (int i = 0; i < steps * mtr::kSamplesPerStep; ++i) {
    sensor->add(reading);
  }
}

TEST(Calibration, GivesTheHeightWithinATenthOfAMillimetre) {
  const mtr::Calibration calibration;
  EXPECT_EQ(calibration.height_um(mtr::kNominalLow), 0);
  EXPECT_NEAR(calibration.height_um(mtr::kNominalHigh), 1200000, 100);
  EXPECT_NEAR(calibration.height_um((mtr::kNominalLow + mtr::kNominalHigh) / 2), 600000, 100);
  EXPECT_LT(calibration.height_um(mtr::kNominalLow - 20), 0);
}

TEST(Calibration, FitsIntoItsNumbersAtTheLongestStrokeAndTheLeastSpan) {
  mtr::Calibration calibration;
  calibration.low = mtr::kBrokenLow;
  calibration.high = mtr::kBrokenLow + mtr::kSmallestSpan;
  calibration.stroke_mm = mtr::kLongestStrokeMm;
  ASSERT_TRUE(calibration.is_plausible());
  const double expected_um = 2e6 * (mtr::kFullScale - calibration.low) / mtr::kSmallestSpan;
  EXPECT_NEAR(calibration.height_um(mtr::kFullScale), expected_um, 100);
}

TEST(PositionSensor, IsTrustedFromTheFirstStepOn) {
  mtr::PositionSensor sensor;
  feed(&sensor, 500, 1);
  EXPECT_FALSE(sensor.is_broken());
  EXPECT_EQ(sensor.counts(), 500 * mtr::kSamplesPerStep);
}

TEST(PositionSensor, KnowsABrokenWireAtEitherEndAndRecoversLater) {
  for (std::uint16_t reading : {0, 1023}) {
    mtr::PositionSensor sensor;
    feed(&sensor, 500, 5);
    feed(&sensor, reading, 1);
    EXPECT_TRUE(sensor.is_broken());
    feed(&sensor, 500, mtr::kSensorGoodSteps);
    EXPECT_TRUE(sensor.is_broken());
    feed(&sensor, 500, 1);
    EXPECT_FALSE(sensor.is_broken());
  }
}

TEST(PositionSensor, DistrustsAJump) {
  mtr::PositionSensor sensor;
  feed(&sensor, 500, 5);
  feed(&sensor, 545, 1);
  EXPECT_TRUE(sensor.is_broken());
}

void write_all(mtr::Memory* memory) {
  for (int i = 0; i < 100; ++i) {
    memory->poll();
  }
}

mtr::Calibration some_calibration() {
  mtr::Calibration calibration;
  calibration.low = 700;
  calibration.high = 9000;
  calibration.stroke_mm = 800;
  return calibration;
}

TEST(Memory, UsesNominalValuesWhenErasedAndCountsResets) {
  hal_host::renew();
  for (int reset = 1; reset <= 3; ++reset) {
    mtr::Memory memory;
    memory.load();
    EXPECT_EQ(memory.copies(), 0);
    EXPECT_EQ(memory.calibration().low, mtr::kNominalLow);
    EXPECT_EQ(memory.resets(), reset);
    write_all(&memory);
  }
}

TEST(Memory, OutlivesDamageOfEitherCopyAndRepairsIt) {
  for (std::uint8_t damaged : {0, 8}) {
    hal_host::renew();
    mtr::Memory written;
    written.load();
    written.save(some_calibration());
    write_all(&written);
    hal_host::hardware().eeprom.at(damaged) ^= 0x10;
    mtr::Memory read;
    read.load();
    EXPECT_EQ(read.copies(), 1);
    EXPECT_EQ(read.calibration().stroke_mm, 800);
    write_all(&read);
    mtr::Memory repaired;
    repaired.load();
    EXPECT_EQ(repaired.copies(), 2);
  }
}

TEST(Memory, KeepsAGoodCopyWhenPowerFailsAtAnyByte) {
  for (int bytes = 0; bytes < 20; ++bytes) {
    hal_host::renew();
    mtr::Memory memory;
    memory.load();
    memory.save(some_calibration());
    write_all(&memory);
    mtr::Calibration newer = some_calibration();
    newer.low = 800;
    newer.high = 9100;
    memory.save(newer);
    for (int i = 0; i < bytes; ++i) {
      memory.poll();
    }
    mtr::Memory read;
    read.load();
    EXPECT_GE(read.copies(), 1) << bytes;
    const int span = read.calibration().high - read.calibration().low;
    EXPECT_EQ(span, 8300) << bytes;
  }
}

class PressesTest : public testing::Test {
 protected:
  void start() { presses_.start(); }
  mtr::Refusal order(const mtr::Press& press) { return presses_.order(press, mtr::Refusal::kNone); }

  /// Lets servo periods pass.
  void pass(int periods) {
    for (int i = 0; i < periods; ++i) {
      presses_.step(now_us_);
      now_us_ += mtr::kServoPeriodUs;
    }
  }

  std::uint32_t now_us_ = mtr::kClockStartUs;
  mtr::PressMemory memory_ = {};
  mtr::Presses presses_{&memory_};
};

TEST_F(PressesTest, TravelsByStrengthHoldsAndReleasesByItself) {
  start();
  ASSERT_EQ(order({1, 2, 0.5F, 100, 0}), mtr::Refusal::kNone);
  pass(mtr::kRampPeriods);
  EXPECT_EQ(presses_.width_us(0), 1000);
  EXPECT_EQ(presses_.width_us(1), 1500);
  EXPECT_EQ(presses_.report().state, mtr::PressState::kPressing);
  const std::uint32_t start_us = presses_.report().start_us;
  EXPECT_EQ(start_us, now_us_ - mtr::kServoPeriodUs + 1500);
  pass(7);
  EXPECT_EQ(presses_.width_us(1), 1000);
  EXPECT_EQ(presses_.report().state, mtr::PressState::kDone);
  EXPECT_GE(presses_.report().end_us - start_us, 100000U - 1000U);
  EXPECT_LE(presses_.report().end_us - start_us, 120000U);
}

TEST_F(PressesTest, NeverPressesARepeatedIdTwice) {
  start();
  order({1, 1, 1.0F, 20, 0});
  pass(30);
  for (std::uint32_t id = 2; id < 2 + mtr::kRememberedPresses - 1; ++id) {
    EXPECT_EQ(order({id, 1, 1.0F, 20, 0}), mtr::Refusal::kNone);
    pass(30);
  }
  order({1, 1, 1.0F, 20, 0});
  pass(3);
  EXPECT_EQ(presses_.width_us(0), 1000);
  EXPECT_EQ(presses_.report().state, mtr::PressState::kDone);
}

TEST_F(PressesTest, RefusesWhatCannotBeAndRemembersIt) {
  start();
  EXPECT_EQ(order({0, 1, 1.0F, 100, 0}), mtr::Refusal::kPressId);
  EXPECT_EQ(order({1, 0, 1.0F, 100, 0}), mtr::Refusal::kServos);
  EXPECT_EQ(order({2, 4, 1.0F, 100, 0}), mtr::Refusal::kServos);
  EXPECT_EQ(order({3, 1, NAN, 100, 0}), mtr::Refusal::kStrength);
  EXPECT_EQ(order({4, 1, -0.1F, 100, 0}), mtr::Refusal::kStrength);
  EXPECT_EQ(order({5, 1, 1.1F, 100, 0}), mtr::Refusal::kStrength);
  EXPECT_EQ(order({6, 1, INFINITY, 100, 0}), mtr::Refusal::kStrength);
  EXPECT_EQ(order({7, 1, 1.0F, 19, 0}), mtr::Refusal::kHold);
  EXPECT_EQ(order({8, 1, 1.0F, 10001, 0}), mtr::Refusal::kHold);
  EXPECT_EQ(presses_.report().state, mtr::PressState::kRefused);
  EXPECT_EQ(presses_.report().id, 8U);
  EXPECT_EQ(order({8, 1, 1.0F, 100, 0}), mtr::Refusal::kNone);
  pass(10);
  EXPECT_EQ(presses_.width_us(0), 1000);
}

TEST_F(PressesTest, RefusesAndRemembersWhatHasAnImpedimentButNotARepetition) {
  start();
  EXPECT_EQ(presses_.order({1, 1, 1.0F, 100, 0}, mtr::Refusal::kLate), mtr::Refusal::kLate);
  EXPECT_EQ(presses_.report().state, mtr::PressState::kRefused);
  EXPECT_EQ(order({1, 1, 1.0F, 100, 0}), mtr::Refusal::kNone);
  pass(30);
  EXPECT_EQ(presses_.width_us(0), 1000);
  order({2, 1, 1.0F, 100, 0});
  EXPECT_EQ(presses_.order({2, 1, 1.0F, 100, 0}, mtr::Refusal::kLate), mtr::Refusal::kNone);
  EXPECT_EQ(presses_.report().state, mtr::PressState::kPressing);
}

TEST_F(PressesTest, LeavesAPressUnderWayAloneAndTakesTheOtherLater) {
  start();
  order({1, 1, 1.0F, 100, 0});
  pass(3);
  EXPECT_EQ(order({2, 2, 1.0F, 100, 0}), mtr::Refusal::kBusy);
  EXPECT_EQ(presses_.report().id, 1U);
  pass(20);
  EXPECT_EQ(order({2, 2, 1.0F, 100, 0}), mtr::Refusal::kNone);
  EXPECT_EQ(presses_.report().id, 2U);
}

TEST_F(PressesTest, LetsTheServoComeBackBeforeTheNextPress) {
  start();
  order({1, 1, 1.0F, 20, 0});
  while (presses_.report().state != mtr::PressState::kDone) {
    pass(1);
  }
  order({2, 1, 1.0F, 20, 0});
  pass(mtr::kReturnUs / mtr::kServoPeriodUs - 1);
  EXPECT_EQ(presses_.width_us(0), 1000);
  pass(mtr::kRampPeriods);
  EXPECT_EQ(presses_.width_us(0), 2000);
}

TEST_F(PressesTest, AbortReleasesAndSaysCutShort) {
  start();
  order({1, 1, 1.0F, 1000, 0});
  pass(10);
  EXPECT_EQ(presses_.width_us(0), 2000);
  presses_.abort();
  EXPECT_EQ(presses_.width_us(0), 1000);
  pass(1);
  EXPECT_EQ(presses_.report().state, mtr::PressState::kCutShort);
}

TEST_F(PressesTest, RemembersIdsOverAReset) {
  start();
  order({5, 1, 1.0F, 1000, 0});
  pass(10);
  mtr::Presses after(&memory_);
  after.start();
  EXPECT_EQ(after.report().id, 5U);
  EXPECT_EQ(after.report().state, mtr::PressState::kCutShort);
  after.order({5, 1, 1.0F, 1000, 0}, mtr::Refusal::kNone);
  after.step(now_us_);
  EXPECT_EQ(after.width_us(0), 1000);
}

TEST_F(PressesTest, ForgetsAMemoryThatPowerOffHasScrambled) {
  memory_.ids[3] = 77;
  memory_.next = 200;
  start();
  EXPECT_EQ(presses_.report().id, 0U);
  EXPECT_EQ(order({77, 1, 1.0F, 100, 0}), mtr::Refusal::kNone);
  EXPECT_EQ(presses_.report().state, mtr::PressState::kPressing);
}

TEST(Leds, EachPatternLooksDifferent) {
  std::set<std::vector<int>> looks;
  for (std::uint8_t pattern = 0; pattern < mtr::kLedPatternCount; ++pattern) {
    std::vector<int> look;
    for (std::uint8_t slot = 0; slot < 16; ++slot) {
      look.push_back(mtr::leds_of(pattern, slot));
    }
    looks.insert(look);
  }
  EXPECT_EQ(looks.size(), static_cast<std::size_t>(mtr::kLedPatternCount));
}

}  // namespace
