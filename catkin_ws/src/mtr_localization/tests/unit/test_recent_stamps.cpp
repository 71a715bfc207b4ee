/// @file
/// Times with an already published transform.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "recent_stamps.hpp"

namespace mtr_localization {
namespace {

TEST(RecentStamps, TakesEachTimeOnce) {
  RecentStamps stamps;
  EXPECT_TRUE(stamps.note(0));
  EXPECT_FALSE(stamps.note(0));
  EXPECT_TRUE(stamps.note(20));
  EXPECT_FALSE(stamps.note(20));
}

TEST(RecentStamps, KnowsATimeAgainAfterAnEarlierOneCame) {
  // A pose, the end of a sweep before it, and a sweep of the other LiDAR that ended with the pose.
  RecentStamps stamps;
  EXPECT_TRUE(stamps.note(20));
  EXPECT_TRUE(stamps.note(10));
  EXPECT_FALSE(stamps.note(20));
}

TEST(RecentStamps, KnowsTheLastSecond) {
  RecentStamps stamps;
  for (std::int64_t stamp = 0; stamp < 1000; ++stamp) {
    EXPECT_TRUE(stamps.note(stamp));
  }
  EXPECT_FALSE(stamps.note(900));
  EXPECT_FALSE(stamps.note(999));
  // After the clock was set back, these times occur again.
  EXPECT_TRUE(stamps.note(100));
}

}  // namespace
}  // namespace mtr_localization
