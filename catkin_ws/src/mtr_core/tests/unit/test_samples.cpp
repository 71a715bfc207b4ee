/// @file
/// Lock-step slots and samples in C++, with the cases of the Python tests.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mtr_core/samples.hpp"

namespace mtr_core {
namespace {

constexpr std::int64_t kMs = kMillisecondNs;

TEST(Slot, NextTickIsLaterThanATick) {
  EXPECT_EQ(kStateMachine.next_after(1020 * kMs), 1120 * kMs);
  EXPECT_EQ(kStateMachine.next_after(1020 * kMs - 1), 1020 * kMs);
}

TEST(Slot, LastTickBeforeZeroIsNegative) { EXPECT_EQ(kStateMachine.last_at(0), -80 * kMs); }

class SamplesInLockStep : public ::testing::Test {
 protected:
  Waiting waiting() {
    return {[this](double max_wall_s) { return on_wait(max_wall_s); }, [this] { return wall_s; }};
  }

  double wall_s = 0.0;
  std::function<bool(double)> on_wait = [this](double max_wall_s) {
    wall_s += max_wall_s;
    return true;
  };
  Samples<int> samples{kMotionPlanner, kClockStep.period_ns, waiting()};
};

TEST(Samples, NewestIsReadOnTheRobotsOwnClock) {
  Samples<int> samples(kMotionPlanner);
  EXPECT_EQ(samples.at(0), std::nullopt);
  samples.add(2000 * kMs, 1);
  samples.add(2040 * kMs, 2);
  EXPECT_EQ(samples.at(1000 * kMs), 2);
}

TEST_F(SamplesInLockStep, NothingIsDueBeforeTheSimulationStarts) {
  EXPECT_EQ(samples.at(1020 * kMs), std::nullopt);
  EXPECT_EQ(wall_s, 0.0);
}

TEST_F(SamplesInLockStep, EarlyMessageIsLeftForTheNextTick) {
  samples.add(2000 * kMs, 1);
  samples.add(2040 * kMs, 2);
  EXPECT_EQ(samples.at(2040 * kMs), 1);
  EXPECT_EQ(samples.at(2060 * kMs), 2);
}

TEST_F(SamplesInLockStep, DueMessageIsWaitedFor) {
  on_wait = [this](double) {
    samples.add(2040 * kMs, 2);
    return true;
  };
  samples.add(2000 * kMs, 1);
  EXPECT_EQ(samples.at(2060 * kMs), 2);
}

TEST_F(SamplesInLockStep, SilentProducerIsLostAndNotWaitedForAgain) {
  samples.add(2000 * kMs, 1);
  EXPECT_EQ(samples.at(2060 * kMs), 1);
  EXPECT_TRUE(samples.lost());
  EXPECT_DOUBLE_EQ(wall_s, kProducerLostAfterWallS);
  EXPECT_EQ(samples.at(2100 * kMs), 1);
  EXPECT_DOUBLE_EQ(wall_s, kProducerLostAfterWallS);
}

TEST_F(SamplesInLockStep, LostProducerThatSpeaksAgainIsWaitedForAgain) {
  EXPECT_EQ(samples.at(2060 * kMs), std::nullopt);
  samples.add(2080 * kMs, 1);
  EXPECT_FALSE(samples.lost());
}

TEST_F(SamplesInLockStep, ProducerThatIsLateAtEachTickCostsItsPatienceOnce) {
  for (int tick_ms = 2040; tick_ms < 2040 + 40 * 25; tick_ms += 40) {
    samples.at((tick_ms + 20) * kMs);
    samples.add((tick_ms - 400) * kMs, 1);
  }
  EXPECT_NEAR(wall_s, kProducerLostAfterWallS * (1.0 + 24 * kLateProducerShare), 1e-9);
}

TEST_F(SamplesInLockStep, LateProducerThatWasInTimeAgainIsWaitedForWithAllPatience) {
  samples.at(2060 * kMs);
  samples.add(2040 * kMs, 1);
  samples.add(2080 * kMs, 2);
  EXPECT_EQ(samples.at(2100 * kMs), 2);
  wall_s = 0.0;
  samples.at(2140 * kMs);
  EXPECT_DOUBLE_EQ(wall_s, kProducerLostAfterWallS);
}

TEST_F(SamplesInLockStep, ShutdownEndsTheWait) {
  on_wait = [](double) { return false; };
  EXPECT_EQ(samples.at(2060 * kMs), std::nullopt);
  EXPECT_FALSE(samples.lost());
}

TEST_F(SamplesInLockStep, StampThatIsNotNewerReplacesHistory) {
  samples.add(9000 * kMs, 1);
  samples.add(1040 * kMs, 2);
  EXPECT_EQ(samples.at(1060 * kMs), 2);
}

TEST_F(SamplesInLockStep, OnlyTheLastSamplesAreKept) {
  for (int i = 0; i <= static_cast<int>(kKeptSamples); ++i) {
    samples.add((2000 + 40 * i) * kMs, i);
  }
  EXPECT_EQ(samples.at(2020 * kMs), std::nullopt);
  EXPECT_EQ(samples.at(2060 * kMs), 1);
}

}  // namespace
}  // namespace mtr_core
