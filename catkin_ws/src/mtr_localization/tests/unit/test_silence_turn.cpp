/// @file
/// A check for silence counts unless the node itself was late; if it is always late, every second check counts.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>

#include "motion/silence_turn.hpp"

namespace mtr_localization {
namespace {

constexpr std::int64_t kPeriodNs = 20'000'000;

TEST(SilenceTurn, CountsTheFirstLookAndThoseInTime) {
  SilenceTurn turn(kPeriodNs);
  for (std::int64_t now_ns = 0; now_ns < 10 * kPeriodNs; now_ns += kPeriodNs) {
    EXPECT_TRUE(turn.counts(now_ns));
  }
}

TEST(SilenceTurn, LookOfANodeThatWasWokenLateSaysNothing) {
  SilenceTurn turn(kPeriodNs);
  EXPECT_TRUE(turn.counts(0));
  EXPECT_FALSE(turn.counts(20 * kPeriodNs));
  EXPECT_TRUE(turn.counts(21 * kPeriodNs));
}

TEST(SilenceTurn, NodeThatIsAlwaysLateNoticesSilenceAtEverySecondLook) {
  SilenceTurn turn(kPeriodNs);
  EXPECT_TRUE(turn.counts(0));
  for (int look = 1; look < 9; ++look) {
    EXPECT_EQ(turn.counts(look * 3 * kPeriodNs), look % 2 == 0);
  }
}

}  // namespace
}  // namespace mtr_localization
