/// @file
/// Lookup and integration of the gyro rate.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "motion/yaw_rate_history.hpp"

namespace mtr_localization {
namespace {

constexpr std::int64_t kMs = 1'000'000;

class YawRateHistoryTest : public ::testing::Test {
 protected:
  void SetUp() override {
    history.add({100 * kMs, 0.5});
    history.add({200 * kMs, 1.0});
    history.add({300 * kMs, 3.0});
  }

  YawRateHistory history;
};

TEST_F(YawRateHistoryTest, SampleHoldsForTheTimeBeforeItsStamp) {
  EXPECT_DOUBLE_EQ(history.rate_at(100 * kMs), 0.5);
  EXPECT_DOUBLE_EQ(history.rate_at(101 * kMs), 1.0);
  EXPECT_DOUBLE_EQ(history.rate_at(200 * kMs), 1.0);
  EXPECT_DOUBLE_EQ(history.rate_at(300 * kMs), 3.0);
}

TEST_F(YawRateHistoryTest, IntegralIsTheAreaBelowTheRate) {
  EXPECT_NEAR(history.integral(100 * kMs, 300 * kMs), 0.4, 1e-12);
  EXPECT_NEAR(history.integral(150 * kMs, 250 * kMs), 0.05 + 0.15, 1e-12);
  EXPECT_EQ(history.integral(250 * kMs, 250 * kMs), 0.0);
}

TEST_F(YawRateHistoryTest, OnlyTimesBetweenSamplesAreCovered) {
  EXPECT_FALSE(history.covers(99 * kMs));
  EXPECT_TRUE(history.covers(100 * kMs));
  EXPECT_TRUE(history.covers(300 * kMs));
  EXPECT_FALSE(history.covers(301 * kMs));
}

TEST_F(YawRateHistoryTest, SampleThatIsNotANumberIsHeardButNotKept) {
  history.add({400 * kMs, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(history.newest_received_ns(), 400 * kMs);
  EXPECT_FALSE(history.newest_is_good());
  EXPECT_FALSE(history.covers(400 * kMs));
}

TEST_F(YawRateHistoryTest, StampBeforeTheLastOneBeginsAnew) {
  EXPECT_FALSE(history.add({50 * kMs, 2.0}));
  EXPECT_EQ(history.newest_received_ns(), 50 * kMs);
  EXPECT_FALSE(history.covers(200 * kMs));
}

TEST_F(YawRateHistoryTest, RepeatedStampIsIgnored) {
  EXPECT_TRUE(history.add({300 * kMs, 9.0}));
  EXPECT_DOUBLE_EQ(history.rate_at(300 * kMs), 3.0);
}

TEST_F(YawRateHistoryTest, SoIsOneOfTheSameInstantOnTheSteadyClock) {
  EXPECT_TRUE(history.add({300 * kMs - 250, 9.0}));
  EXPECT_TRUE(history.add({300 * kMs + 250, 9.0}));
  EXPECT_EQ(history.newest_received_ns(), 300 * kMs);
  EXPECT_DOUBLE_EQ(history.rate_at(300 * kMs), 3.0);
}

TEST_F(YawRateHistoryTest, LongestGapIsFoundBetweenTheTimesAsked) {
  history.add({900 * kMs, 1.0});
  EXPECT_EQ(history.max_gap_ns(100 * kMs, 300 * kMs), 100 * kMs);
  EXPECT_EQ(history.max_gap_ns(100 * kMs, 400 * kMs), 600 * kMs);
}

TEST_F(YawRateHistoryTest, ForgettingKeepsWhatCoversTheTime) {
  history.forget_before(250 * kMs);
  EXPECT_TRUE(history.covers(250 * kMs));
  EXPECT_FALSE(history.covers(150 * kMs));
}

}  // namespace
}  // namespace mtr_localization
