/// @file
/// The map of synthetic ways round the Car.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mtr_localization/map_adjustment.hpp"
#include "synthetic_loop.hpp"

namespace mtr_localization {
namespace {

using synthetic::drive;
using synthetic::errors_of;
using synthetic::Loop;
using synthetic::LoopOptions;

AdjustedMap map_of(const Loop& loop) { return adjust(loop.key_frames, AdjustmentParameters{}); }

TEST(MapAdjustment, PosesInALotAreTrueToMillimetres) {
  const Loop loop = drive({});
  const AdjustedMap map = map_of(loop);
  ASSERT_TRUE(map.valid) << map.message;
  EXPECT_GT(errors_of(loop.key_frames, loop.truth).largest_m, 0.03);
  EXPECT_LT(errors_of(map.key_frames, loop.truth).largest_m, 0.005);
}

TEST(MapAdjustment, FirstKeyFrameStaysWhereItWas) {
  const Loop loop = drive({});
  EXPECT_EQ(map_of(loop).key_frames.front().pose, loop.key_frames.front().pose);
}

TEST(MapAdjustment, HalfAWayRoundIsNoMap) {
  LoopOptions options;
  options.turns = 0.5;
  const AdjustedMap map = map_of(drive(options));
  EXPECT_FALSE(map.valid);
  EXPECT_NE(map.message.find("not closed"), std::string::npos) << map.message;
}

}  // namespace
}  // namespace mtr_localization
